//! Which address is what.

use std::{
    path::PathBuf,
    sync::{
        Arc, OnceLock,
        atomic::{AtomicBool, Ordering},
        mpsc,
    },
};

use http_body_util::BodyExt;
use hyper::{
    Method, Request, StatusCode,
    body::{Body, Bytes, Incoming},
};
use report::page::scripts;
use tokio::sync::oneshot;

use live::{
    Change, Fault,
    page::{self, Answers},
};

use crate::{
    guard::Guard,
    queue::Queue,
    reply::{Reply, json, reply, says},
    visit::{TRANSFER, Visit},
};

/// Bytes of a move at most: a scene with measured pitch errors of every tooth is a hundredth of it.
const MOST: usize = 1 << 20;

/// What is served.
pub(crate) struct Routes {
    guard: Guard,
    /// Text of the first scene and the name of its file.
    start: (String, PathBuf),
    queue: Arc<Queue>,
    work: mpsc::Sender<Job>,
}

/// A move on its way to a thread that solves it.
pub(crate) struct Job {
    pub change: Change,
    /// Set when whoever asked has gone.
    pub gone: Arc<AtomicBool>,
    /// Takes the answer; none where a later move has come.
    pub answer: oneshot::Sender<Option<Vec<u8>>>,
}

/// Says that whoever asked has gone, when it is dropped.
struct Leaves<'a>(&'a Queue, Arc<AtomicBool>);

impl Drop for Leaves<'_> {
    fn drop(&mut self) {
        self.1.store(true, Ordering::SeqCst);
        self.0.look_again();
    }
}

impl Routes {
    /// Nothing is asked yet; moves go to `work`.
    pub fn new(guard: Guard, start: (String, PathBuf), queue: Arc<Queue>, work: mpsc::Sender<Job>) -> Self {
        Self { guard, start, queue, work }
    }

    /// The answer to a request. The token is looked for before anything of a body is read.
    pub async fn reply(&self, request: Request<Incoming>, visit: &Visit) -> Reply {
        let (head, body) = request.into_parts();
        let path = match self.guard.admit(&head.uri, &head.headers) {
            Ok(path) => path,
            Err(refusal) => return says(StatusCode::FORBIDDEN, &refusal.to_string()),
        };
        if !visit.is_known() {
            return says(StatusCode::SERVICE_UNAVAILABLE, "too many requests at once; ask again");
        }
        let answer = match (&head.method, path) {
            (&Method::POST, "solve") => self.solve(body, visit).await,
            (&Method::GET, "solve") => says(StatusCode::METHOD_NOT_ALLOWED, "moves are posted"),
            (&Method::GET, name) => self.file(name),
            _ => nothing(),
        };
        visit.within(TRANSFER);
        answer
    }

    fn file(&self, name: &str) -> Reply {
        static CHARTS: OnceLock<Bytes> = OnceLock::new();
        static VIEW: OnceLock<Bytes> = OnceLock::new();
        let both = |a: &str, b: &str| Bytes::from(format!("{a}\n{b}"));
        let script = |text: Bytes| reply(StatusCode::OK, "text/javascript; charset=utf-8", text);
        match name {
            "" => match page::html((self.start.0.as_str(), self.start.1.as_path()), Answers::Server(self.queue.open()))
            {
                Ok(html) => reply(StatusCode::OK, "text/html; charset=utf-8", html),
                Err(error) => says(StatusCode::INTERNAL_SERVER_ERROR, &error.to_string()),
            },
            "style.css" => reply(StatusCode::OK, "text/css; charset=utf-8", page::style()),
            "charts.js" => script(CHARTS.get_or_init(|| both(scripts::UPLOT, scripts::CHARTS)).clone()),
            "view.js" => script(VIEW.get_or_init(|| both(scripts::THREE, scripts::VIEW)).clone()),
            "page.js" => script(Bytes::from_static(page::SCRIPT.as_bytes())),
            _ => nothing(),
        }
    }

    async fn solve(&self, body: Incoming, visit: &Visit) -> Reply {
        let wrong = |status, message: String, hint: &str| {
            json(status, serde_json::json!({ "fault": Fault::new(message, hint) }).to_string())
        };
        visit.within(TRANSFER);
        let bytes = match read(body).await {
            Ok(Some(bytes)) => bytes,
            Ok(None) => {
                let message = format!("the move has more than {MOST} bytes");
                return wrong(StatusCode::PAYLOAD_TOO_LARGE, message, "keep long lists in files of their own");
            }
            Err(error) => {
                let message = format!("the move did not come through: {error}");
                return wrong(StatusCode::BAD_REQUEST, message, "move again");
            }
        };
        let change: Change = match serde_json::from_slice(&bytes) {
            Ok(change) => change,
            Err(error) => {
                let message = format!("the move is not readable: {error}");
                return wrong(StatusCode::BAD_REQUEST, message, "load the page again");
            }
        };
        if !self.queue.knows(change.page) {
            let message = format!("page {} was not opened by this server", change.page);
            return wrong(StatusCode::BAD_REQUEST, message, "load the page again");
        }
        let gone = Arc::<AtomicBool>::default();
        let _leaves = Leaves(&self.queue, Arc::clone(&gone));
        let (answer, heard) = oneshot::channel();
        visit.as_long_as_it_takes();
        if self.work.send(Job { change, gone, answer }).is_err() {
            return says(StatusCode::SERVICE_UNAVAILABLE, "the server ends");
        }
        match heard.await {
            Ok(Some(body)) => json(StatusCode::OK, body),
            Ok(None) => says(StatusCode::CONFLICT, "a later move has come"),
            Err(_) => {
                let message = "the solve ended without an answer".to_owned();
                wrong(StatusCode::INTERNAL_SERVER_ERROR, message, "what the terminal says of it belongs into a report")
            }
        }
    }
}

fn nothing() -> Reply {
    says(StatusCode::NOT_FOUND, "there is nothing of that name")
}

/// A body; `None` where it is longer than a move may be, or says so, of which no more is read.
async fn read(mut body: Incoming) -> Result<Option<Vec<u8>>, hyper::Error> {
    let mut all = Vec::new();
    if body.size_hint().lower() > MOST as u64 {
        return Ok(None);
    }
    while let Some(frame) = body.frame().await {
        if let Ok(data) = frame?.into_data() {
            if all.len() + data.len() > MOST {
                return Ok(None);
            }
            all.extend_from_slice(&data);
        }
    }
    Ok(Some(all))
}
