//! What became of each mutant.

use std::{
    collections::BTreeMap,
    error::Error,
    fs::{self, OpenOptions},
    io::Write,
    path::Path,
    sync::Mutex,
    time::Duration,
};

use serde::{Deserialize, Serialize};

use crate::{
    CRATES,
    build::{Binary, Drawn},
    cover::found,
    tests::{Ended, Test, run as run_test},
};

/// A mutant is noticed by a test, or by none that reaches it.
#[derive(Clone, Serialize, Deserialize)]
struct Outcome {
    mutant: usize,
    /// The test that notices it.
    killed_by: Option<String>,
    ended: Option<Ended>,
    /// Tests that reach it, and those of them that were run.
    reached_by: usize,
    tried: usize,
}

fn outcomes(work: &Path) -> BTreeMap<usize, Outcome> {
    let text = fs::read_to_string(work.join("outcomes.jsonl")).unwrap_or_default();
    text.lines().filter_map(|l| serde_json::from_str::<Outcome>(l).ok()).map(|o| (o.mutant, o)).collect()
}

/// Which mutants are tried: those without an outcome, and others on request.
pub struct Wanted {
    pub survivors: bool,
    pub only: Vec<usize>,
}

/// `mutants run`.
pub fn run(work: &Path, jobs: usize, budget: f64, first: Option<&str>, wanted: &Wanted) -> Result<(), Box<dyn Error>> {
    let drawn = Drawn::read(work)?;
    let binaries: Vec<Binary> = serde_json::from_slice(&fs::read(work.join("binaries.json"))?)?;
    let mut tests = found(work);
    tests.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let done = outcomes(work);
    if let Some(first) = first {
        tests.sort_by_key(|test| !test.name.contains(first));
    }
    let wanted = |n: usize| match done.get(&n) {
        _ if !wanted.only.is_empty() => wanted.only.contains(&n),
        Some(outcome) => wanted.survivors && outcome.killed_by.is_none() && outcome.reached_by > 0,
        None => !wanted.survivors,
    };
    // In an order that mixes the crates, so that a run that is cut short has seen all of them.
    let mut numbers: Vec<usize> = drawn.viable().map(|(n, _)| n).filter(|n| wanted(*n)).collect();
    numbers.sort_by_key(|n| n.wrapping_mul(2_654_435_761) % 1_000_003);
    let todo = Mutex::new(numbers.iter());
    let file = Mutex::new(OpenOptions::new().create(true).append(true).open(work.join("outcomes.jsonl"))?);
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            scope.spawn(|| {
                loop {
                    let Some(&number) = todo.lock().ok().and_then(|mut t| t.next()) else { break };
                    let outcome = tried(number, &tests, &binaries, budget);
                    if let (Ok(mut file), Ok(line)) = (file.lock(), serde_json::to_string(&outcome)) {
                        _ = writeln!(file, "{line}");
                    }
                }
            });
        }
    });
    list(work)
}

/// The quickest tests that reach it first.
fn tried(number: usize, tests: &[Test], binaries: &[Binary], budget: f64) -> Outcome {
    let reaching: Vec<&Test> = tests.iter().filter(|t| t.reaches.binary_search(&(number as u32)).is_ok()).collect();
    let mut outcome = Outcome { mutant: number, killed_by: None, ended: None, reached_by: reaching.len(), tried: 0 };
    let mut seconds = 0.0;
    for test in reaching {
        if seconds + test.seconds > budget && outcome.tried > 0 {
            break;
        }
        seconds += test.seconds;
        outcome.tried += 1;
        let limit = Duration::from_secs_f64(10.0 + 8.0 * test.seconds);
        let binary = &binaries[test.binary];
        match run_test(binary, &test.name, &number.to_string(), None, limit) {
            Ok(Ended::Passed) | Err(_) => {}
            Ok(ended) => {
                outcome.killed_by = Some(format!("{} {}", binary.name, test.name));
                outcome.ended = Some(ended);
                break;
            }
        }
    }
    outcome
}

/// `mutants list`.
pub fn list(work: &Path) -> Result<(), Box<dyn Error>> {
    let drawn = Drawn::read(work)?;
    let outcomes = outcomes(work);
    println!("seed {}, {} of {} changes, {} viable", drawn.seed, drawn.mutants.len(), drawn.of, drawn.viable().count());
    println!("{:10} {:>7} {:>7} {:>9} {:>9}", "crate", "tried", "killed", "not seen", "share");
    for name in CRATES.iter().copied().chain([""]) {
        let folder = if name.is_empty() { "crates/".to_string() } else { format!("crates/{name}/") };
        let of: Vec<&Outcome> =
            drawn.viable().filter(|(_, s)| s.file.starts_with(&folder)).filter_map(|(n, _)| outcomes.get(&n)).collect();
        let killed = of.iter().filter(|o| o.killed_by.is_some()).count();
        let unseen = of.iter().filter(|o| o.reached_by == 0).count();
        let share = 100.0 * killed as f64 / of.len().max(1) as f64;
        println!("{:10} {:7} {killed:7} {unseen:9} {share:8.1}%", if name.is_empty() { "all" } else { name }, of.len());
    }
    for (number, site) in drawn.viable() {
        if let Some(o) = outcomes.get(&number)
            && o.killed_by.is_none()
        {
            println!("{number:5} {}:{} {} ({} of {} tests)", site.file, site.line, site.what, o.tried, o.reached_by);
        }
    }
    Ok(())
}
