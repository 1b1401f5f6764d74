//! How does a browser answer by itself?
//!
//! [`answer`] is what the page of [`live`] gets for a move, without a server. Built for `wasm32-unknown-unknown` it is the only
//! export of a program of one thread and without files; `packaging/browser.sh` makes one page of it.

use std::{path::Path, sync::LazyLock};

use analysis::{Interest, NoCache};
use live::{Change, Fault, Machine, Session};
use web_time::Instant;

/// Memory of a page at the most, bytes: addresses have 32 bits.
const MOST_BYTES: f64 = 3e9;

/// Time since it was first asked for, ms.
fn clock_ms() -> f64 {
    static FIRST: LazyLock<Instant> = LazyLock::new(Instant::now);
    1e3 * FIRST.elapsed().as_secs_f64()
}

/// The answer to a move, both JSON as in [`live::Session::answer`]. Gears that are reduced are kept for the moves that follow.
/// What is no move is answered by a fault.
#[cfg_attr(target_family = "wasm", wasm_bindgen::prelude::wasm_bindgen)]
pub fn answer(asked: &str) -> String {
    static SESSION: LazyLock<Session<'static>> = LazyLock::new(|| {
        Session::new("", Path::new("scene.toml"), Machine { free_bytes: || MOST_BYTES, clock_ms }, &NoCache)
    });
    let fault =
        |message: String| serde_json::json!({ "fault": Fault::new(message, "load the page again") }).to_string();
    let change: Change = match serde_json::from_str(asked) {
        Ok(change) => change,
        Err(error) => return fault(format!("the move is not readable: {error}")),
    };
    // Nobody else waits: a move is solved to its end.
    let always = || true;
    let interest = Interest { gears: &always, positions: &always };
    let answered = SESSION.answer(change.number, SESSION.take(&change), interest);
    let answered = answered.and_then(|json| String::from_utf8(json).ok());
    answered.unwrap_or_else(|| fault("the move has no answer".into()))
}
