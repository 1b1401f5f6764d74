//! What bounds are calibrated on: numbers of random pairs on settings from coarse to fine.
//!
//! `rest`: meshes refined alike in all directions, more slices, and the curves over a mesh cycle on the coarsest rung; with
//! `curves` these alone, with `spur` those of the spur pairs. `motion`: every model, with few and many steps. `gearbox`: bounds that are asked for
//! several shares, beside fine settings.

mod gearbox;
mod motion;
mod rest;

use std::{
    fs::OpenOptions,
    io::Write,
    time::{Duration, Instant},
};

use serde_json::{Value, json};
use verification::pairs_done::pairs_done;

use super::Failure;

/// The lines of a pair by its number; `None` for one that is left out.
type Measure = Box<dyn Fn(u64) -> Option<Vec<Value>>>;
/// Longer than anybody waits.
const FOREVER: Duration = Duration::from_secs(u32::MAX as u64);

/// Measures all pairs of the words that are not in the file yet.
pub(super) fn run(words: &[String]) -> Result<(), Failure> {
    until(words, Instant::now() + FOREVER)
}

/// As [`run`]; after some time no further pair is begun.
pub(super) fn until(words: &[String], until: Instant) -> Result<(), Failure> {
    let [kind, file, seed, first, count, more @ ..] = words else {
        return Err("rest|motion|gearbox FILE SEED FIRST COUNT are wanted".into());
    };
    let (seed, first, count): (u64, u64, u64) = (seed.parse()?, first.parse()?, count.parse()?);
    let more = more.first().map(String::as_str);
    let measure: Measure = match kind.as_str() {
        "rest" => rest::measure(seed, more)?,
        "motion" => motion::measure(seed, more)?,
        "gearbox" => gearbox::measure(seed, more)?,
        _ => return Err("`rest`, `motion` or `gearbox` is wanted first".into()),
    };
    let done = pairs_done(file, seed)?;
    let mut out = OpenOptions::new().create(true).append(true).open(file)?;
    // One after the other: a pair in work may be large, and a run of hours is cut off without warning.
    for index in (first..first + count).filter(|i| !done.contains(i)) {
        if Instant::now() >= until {
            break;
        }
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
