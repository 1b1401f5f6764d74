//! Which address is what.

use std::{
    io::Read,
    sync::{Arc, Mutex, PoisonError},
};

use report::page::scripts;
use tiny_http::{Method, Request};

use crate::{
    desk::{Change, Desk},
    fault::Fault,
    guard::Guard,
    moves::Moves,
    page,
    reply::{Reply, json, reply, says},
};

/// Bytes of a move at most: a scene with measured pitch errors of every tooth is a hundredth of it.
const MOST: u64 = 1 << 20;
/// Pages that are known at most; of more, which only a program can open, the first are forgotten.
const MOST_PAGES: usize = 256;

/// What is served.
pub(crate) struct Routes<'a> {
    guard: &'a Guard,
    desk: &'a Desk<'a>,
    pages: Mutex<Pages>,
}

#[derive(Default)]
struct Pages {
    /// Number of the first that is known.
    first: u64,
    known: Vec<Arc<Moves>>,
}

impl<'a> Routes<'a> {
    /// Nothing is asked yet.
    pub fn new(guard: &'a Guard, desk: &'a Desk<'a>) -> Self {
        Self { guard, desk, pages: Mutex::default() }
    }

    /// What is being solved ends at its next position.
    pub fn end(&self) {
        self.pages().known.iter().for_each(|moves| moves.end());
    }

    fn pages(&self) -> std::sync::MutexGuard<'_, Pages> {
        self.pages.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Number of a page that is opened now.
    fn open(&self) -> u64 {
        let mut pages = self.pages();
        if pages.known.len() == MOST_PAGES {
            pages.known.remove(0).end();
            pages.first += 1;
        }
        pages.known.push(Arc::default());
        pages.first + pages.known.len() as u64 - 1
    }

    fn moves(&self, page: u64) -> Option<Arc<Moves>> {
        let pages = self.pages();
        pages.known.get(usize::try_from(page.checked_sub(pages.first)?).ok()?).cloned()
    }

    fn reply(&self, request: &mut Request) -> Reply {
        let path = match self.guard.admit(request) {
            Ok(path) => path.to_owned(),
            Err(refusal) => return says(403, &refusal.to_string()),
        };
        let script = |text: &str| reply(200, "text/javascript; charset=utf-8", text);
        match (request.method(), path.as_str()) {
            (Method::Get, "") => match page::html(self.desk.start(), self.open()) {
                Ok(html) => reply(200, "text/html; charset=utf-8", html),
                Err(error) => says(500, &error.to_string()),
            },
            (Method::Get, "style.css") => reply(200, "text/css; charset=utf-8", page::style()),
            (Method::Get, "charts.js") => script(&format!("{}\n{}", scripts::UPLOT, scripts::CHARTS)),
            (Method::Get, "view.js") => script(&format!("{}\n{}", scripts::THREE, scripts::VIEW)),
            (Method::Get, "page.js") => script(page::SCRIPT),
            (Method::Post, "solve") => self.solve(request),
            (Method::Get, "solve") => says(405, "moves are posted"),
            _ => says(404, "there is nothing of that name"),
        }
    }

    fn solve(&self, request: &mut Request) -> Reply {
        let wrong = |status, message: String, hint: &str| {
            json(status, serde_json::json!({ "fault": Fault::new(message, hint) }).to_string())
        };
        let mut body = Vec::new();
        if let Err(error) = request.as_reader().take(MOST + 1).read_to_end(&mut body) {
            return wrong(400, format!("the move did not come through: {error}"), "move again");
        }
        if body.len() as u64 > MOST {
            return wrong(413, format!("the move has more than {MOST} bytes"), "keep long lists in files of their own");
        }
        let change: Change = match serde_json::from_slice(&body) {
            Ok(change) => change,
            Err(error) => return wrong(400, format!("the move is not readable: {error}"), "load the page again"),
        };
        let Some(moves) = self.moves(change.page) else {
            return wrong(400, format!("page {} was not opened by this server", change.page), "load the page again");
        };
        let Some(turn) = moves.turn(change.number) else { return overtaken() };
        match self.desk.answer(&change, &|| turn.is_wanted()) {
            Some(body) => json(200, body),
            None => overtaken(),
        }
    }
}

/// A later move has come: nobody looks for this answer.
fn overtaken() -> Reply {
    says(409, "a later move has come")
}

/// Answers a request; whoever asked may have gone.
pub(crate) fn answer(routes: &Routes<'_>, mut request: Request) {
    let reply = routes.reply(&mut request);
    let _ = request.respond(reply);
}
