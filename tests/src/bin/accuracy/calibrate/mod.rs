//! Makes the tables of bounds from what was measured, and says how they do on pairs that took no part in them, in turn.

mod gearbox;
mod motion;
mod rest;

use std::fs;

use verification::pairs_done::lines;

use super::Failure;

/// `words`: `rest`, `motion` or `gearbox`, the table, the files of measurements.
pub(super) fn run(words: &[String]) -> Result<(), Failure> {
    let [kind, out, files @ ..] = words else { return Err("rest|motion|gearbox OUT.json FILE... are wanted".into()) };
    let table = match kind.as_str() {
        "rest" => serde_json::to_string_pretty(&rest::table(&lines(files)?)?),
        "motion" => serde_json::to_string_pretty(&motion::table(lines(files)?)),
        "gearbox" => serde_json::to_string_pretty(&gearbox::table(&lines(files)?)?),
        _ => return Err("`rest`, `motion` or `gearbox` is wanted first".into()),
    };
    fs::write(out, table? + "\n")?;
    Ok(())
}
