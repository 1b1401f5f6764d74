//! All of it by one command, which goes on where it stopped: measured pairs, tables, checks, the page.

use std::{
    fs,
    path::Path,
    time::{Duration, Instant},
};

use super::{Failure, calibrate, check, measure, page};

/// A part of the measurements: its name is that of its file.
struct Part {
    name: &'static str,
    /// Words of `measure` before and after file, seed, first and count.
    kind: &'static str,
    more: Option<&'static str>,
    seed: u64,
    pairs: u64,
}

/// What is measured, in this order: some of everything before all of anything.
const PARTS: [Part; 9] = [
    Part { name: "spur", kind: "rest", more: Some("spur"), seed: 4, pairs: 320 },
    Part { name: "rest", kind: "rest", more: None, seed: 101, pairs: 300 },
    Part { name: "rest_held_out", kind: "rest", more: None, seed: 102, pairs: 200 },
    Part { name: "rings", kind: "rest", more: Some("6"), seed: 1001, pairs: 100 },
    Part { name: "rings_held_out", kind: "rest", more: Some("6"), seed: 1002, pairs: 100 },
    Part { name: "motion", kind: "motion", more: None, seed: 103, pairs: 200 },
    Part { name: "gearboxes", kind: "gearbox", more: None, seed: 111, pairs: 400 },
    Part { name: "gearboxes_held_out", kind: "gearbox", more: None, seed: 112, pairs: 400 },
    Part { name: "curves", kind: "rest", more: Some("curves"), seed: 105, pairs: 1000 },
];
/// Pairs of a part that are measured before the next one has its turn.
const TURN: u64 = 10;
/// Pairs at rest that a table is made of, at least.
const LEAST_PAIRS: usize = 30;

/// `words`: the folder, and after how many minutes no further pair is begun.
pub(super) fn run(words: &[String]) -> Result<(), Failure> {
    let [folder, minutes] = words else { return Err("renew FOLDER MINUTES are wanted".into()) };
    let until = Instant::now() + Duration::from_secs_f64(60.0 * minutes.parse::<f64>()?);
    fs::create_dir_all(folder)?;
    let file = |name: &str| format!("{folder}/{name}.jsonl");
    let most = PARTS.iter().map(|part| part.pairs).max().unwrap_or(0);
    for first in (0..most).step_by(TURN as usize) {
        for part in PARTS.iter().filter(|part| first < part.pairs) {
            let count = TURN.min(part.pairs - first);
            let place = [part.seed, first, count].map(|number| number.to_string());
            let mut words = vec![part.kind.to_owned(), file(part.name)];
            words.extend(place.into_iter().chain(part.more.map(str::to_owned)));
            measure::until(&words, until)?;
        }
    }
    let there = |names: &[&str]| -> Vec<String> {
        names.iter().map(|name| file(name)).filter(|file| Path::new(file).exists()).collect()
    };
    let gearboxes = there(&["gearboxes"]);
    if !gearboxes.is_empty() {
        calibrate::run(&[vec!["gearbox".into(), format!("{folder}/gearbox.json")], gearboxes].concat())?;
    }
    let (rest, motion) = (there(&["rest", "curves", "spur", "rings"]), there(&["motion"]));
    let measured = verification::measured_pair::MeasuredPair::all(&verification::pairs_done::lines(&rest)?);
    let whole = measured.iter().filter(|pair| pair.has_meshes()).count();
    if whole >= LEAST_PAIRS {
        calibrate::run(&[vec!["rest".into(), format!("{folder}/rest.json")], rest].concat())?;
    } else {
        println!("{whole} pairs at rest are measured, {LEAST_PAIRS} are wanted for a table");
    }
    if !motion.is_empty() {
        calibrate::run(&[vec!["motion".into(), format!("{folder}/motion.json")], motion.clone()].concat())?;
        page::run(&[vec![format!("{folder}/which_model.md")], motion].concat())?;
    }
    check::run(&[vec!["laws".into()], there(&["rest_held_out", "rings_held_out", "gearboxes_held_out"])].concat())
}
