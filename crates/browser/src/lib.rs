//! How does a browser answer by itself?
//!
//! [`answer`] is what the page of [`live`] gets for a move, without a server. Built for `wasm32-unknown-unknown` it is a
//! program of one thread, without files and clock, that a page calls by three exports:
//!
//! | export | what it does |
//! |---|---|
//! | `room(bytes)` | makes room for a move (JSON, UTF-8) of so many bytes; its address |
//! | `answer()` | answers the move there; bytes of the answer (JSON, UTF-8) |
//! | `answered()` | address of the answer, until the next move |
//!
//! It imports `page.clock_ms`: time since some moment, ms. `packaging/browser.sh` makes one page of it.

use std::{path::Path, sync::LazyLock};

use analysis::{Interest, NoCache};
use live::{Change, Fault, Machine, Session};

#[cfg(target_family = "wasm")]
mod exports;

/// Memory of a page at the most, bytes: addresses have 32 bits.
const MOST_BYTES: f64 = 3e9;

/// Milliseconds since some moment.
#[cfg(target_family = "wasm")]
fn clock_ms() -> f64 {
    exports::clock_ms()
}

/// Milliseconds since this process asked for the first time.
#[cfg(not(target_family = "wasm"))]
fn clock_ms() -> f64 {
    static FIRST: LazyLock<std::time::Instant> = LazyLock::new(std::time::Instant::now);
    1e3 * FIRST.elapsed().as_secs_f64()
}

/// The answer to a move, both JSON as in [`live::Session::answer`]. Gears that are reduced are kept for the moves that follow.
/// What is no move is answered by a fault.
pub fn answer(r#move: &[u8]) -> Vec<u8> {
    static SESSION: LazyLock<Session<'static>> = LazyLock::new(|| {
        Session::new("", Path::new("scene.toml"), Machine { free_bytes: || MOST_BYTES, clock_ms }, &NoCache)
    });
    let fault = |message: String| {
        let fault = Fault::new(message, "load the page again");
        serde_json::json!({ "fault": fault }).to_string().into_bytes()
    };
    let change: Change = match serde_json::from_slice(r#move) {
        Ok(change) => change,
        Err(error) => return fault(format!("the move is not readable: {error}")),
    };
    // Nobody else waits: a move is solved to its end.
    let always = || true;
    let interest = Interest { gears: &always, positions: &always };
    let answered = SESSION.answer(change.number, SESSION.take(&change), interest);
    answered.unwrap_or_else(|| fault("the move has no answer".into()))
}
