//! Makes the tables of bounds from what was measured, and says how they do on pairs that took no part in them.
//!
//! `cargo run --release -p verification --bin calibrate_accuracy -- rest|motion OUT.json FILE...`, the files of
//! `measure_accuracy`. The check is of other pairs: `check_accuracy`.
#![allow(clippy::print_stdout, reason = "the figures are what it is for")]

mod motion;
mod rest;

use std::{error::Error, fs};

use verification::pairs_done::lines;

type Failure = Box<dyn Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [kind, out, files @ ..] = &words[..] else { return Err("rest|motion OUT.json FILE... are wanted".into()) };
    let table = match kind.as_str() {
        "rest" => serde_json::to_string_pretty(&rest::table(&lines(files)?)?),
        "motion" => serde_json::to_string_pretty(&motion::table(lines(files)?)),
        _ => return Err("`rest` or `motion` is wanted first".into()),
    };
    fs::write(out, table? + "\n")?;
    Ok(())
}
