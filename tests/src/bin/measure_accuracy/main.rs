//! What bounds are calibrated on: numbers of random pairs on settings from coarse to fine. One line of JSON a pair (in
//! motion a pair and speed), appended as it comes; pairs that are there are left out.
//!
//! `cargo run --release -p verification --bin measure_accuracy -- rest FILE SEED FIRST COUNT [FINEST | spur]`: meshes refined
//! alike in all directions, more slices and more positions; with `spur` the spur pairs among them, numbers of positions on
//! the coarsest rung alone. `motion FILE SEED FIRST COUNT [MESH_RUNG]`: every model, with few and many steps.
#![allow(clippy::print_stderr, reason = "the progress of hours")]

mod motion;
mod rest;

use std::{error::Error, fs::OpenOptions, io::Write, time::Instant};

use serde_json::{Value, json};
use verification::pairs_done::pairs_done;

type Failure = Box<dyn Error + Send + Sync>;
/// The lines of a pair by its number; `None` for one that is left out.
type Measure = Box<dyn Fn(u64) -> Option<Vec<Value>>>;

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [kind, file, seed, first, count, more @ ..] = &words[..] else {
        return Err("rest|motion FILE SEED FIRST COUNT are wanted".into());
    };
    let (seed, first, count): (u64, u64, u64) = (seed.parse()?, first.parse()?, count.parse()?);
    let more = more.first().map(String::as_str);
    let measure: Measure = match kind.as_str() {
        "rest" => rest::measure(seed, more)?,
        "motion" => motion::measure(seed, more)?,
        _ => return Err("`rest` or `motion` is wanted first".into()),
    };
    let done = pairs_done(file, seed)?;
    let mut out = OpenOptions::new().create(true).append(true).open(file)?;
    // One after the other: a pair in work may be large, and a run of hours is cut off without warning.
    for index in (first..first + count).filter(|i| !done.contains(i)) {
        let start = Instant::now();
        let Some(lines) = measure(index) else { continue };
        let failed = if lines.iter().any(|line| line.get("error").is_some()) { ", failed" } else { "" };
        for mut line in lines {
            (line["seed"], line["index"]) = (json!(seed), json!(index));
            writeln!(out, "{line}")?;
        }
        eprintln!("pair {index}: {:.0} s{failed}", start.elapsed().as_secs_f64());
    }
    Ok(())
}
