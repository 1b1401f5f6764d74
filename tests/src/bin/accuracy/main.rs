//! Bounds of accuracy: what they are calibrated on, the tables that come of it, how they do on pairs that no table has seen, and
//! the page that says which model suffices.
//!
//! ```text
//! accuracy renew FOLDER MINUTES                       all of it, going on where the last run stopped
//! accuracy measure rest FILE SEED FIRST COUNT [FINEST | curves | spur]
//! accuracy measure motion FILE SEED FIRST COUNT [MESH_RUNG]
//! accuracy measure gearbox FILE SEED FIRST COUNT
//! accuracy calibrate rest|motion|gearbox OUT.json FILE...
//! accuracy check laws FILE...                         committed laws on measured pairs and gearboxes, by quantity and stratum
//! accuracy check rest TOLERANCE_PERCENT COUNT FILE... `model = "auto"` on measured pairs, with its cost
//! accuracy check motion TOLERANCE_PERCENT SEED FIRST COUNT [MESH_RUNG]
//! accuracy check gearbox TOLERANCE_PERCENT SEED FIRST COUNT
//! accuracy page OUT.md FILE...                        which model of a motion suffices
//! accuracy chart OUT.md SCENES                        speed against accuracy of everything
//! ```
//! `cargo run --release -p verification --bin accuracy -- ...`. A file has a line of JSON a pair (in motion a pair and speed),
//! appended as it comes; pairs that are there are left out, so that a measurement may be cut off, or shared out: files of
//! several machines are named one after the other. Seeds say which pairs are for tables and which for checks
//! (`tests/src/held_out.rs`).
#![allow(
    clippy::print_stderr,
    clippy::print_stdout,
    reason = "the progress of hours, and the figures are what it is for"
)]

mod calibrate;
mod chart;
mod check;
mod measure;
mod page;
mod renew;

use std::error::Error;

type Failure = Box<dyn Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [command, words @ ..] = &words[..] else {
        return Err("renew, measure, calibrate, check, page or chart is wanted".into());
    };
    match command.as_str() {
        "renew" => renew::run(words),
        "measure" => measure::run(words),
        "calibrate" => calibrate::run(words),
        "check" => check::run(words),
        "page" => page::run(words),
        "chart" => chart::run(words),
        other => Err(format!("`{other}`: renew, measure, calibrate, check, page or chart is wanted").into()),
    }
}
