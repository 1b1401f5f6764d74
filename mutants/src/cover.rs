//! Which test reaches which mutant, and how long it takes.

use std::{
    collections::BTreeSet,
    error::Error,
    fs::{self, OpenOptions},
    io::Write,
    path::Path,
    sync::Mutex,
    time::{Duration, Instant},
};

use serde::{Deserialize, Serialize};

use crate::{
    build::Binary,
    tests::{Ended, Test, names, run},
};

/// Tests at a time.
const JOBS: usize = 2;

/// A line of `tests.jsonl`: a test that was looked at, and what is known of it where it is of use.
#[derive(Serialize, Deserialize)]
struct Looked {
    binary: usize,
    name: String,
    test: Option<Test>,
}

fn looked(work: &Path) -> Vec<Looked> {
    let text = fs::read_to_string(work.join("tests.jsonl")).unwrap_or_default();
    text.lines().filter_map(|l| serde_json::from_str(l).ok()).collect()
}

/// Tests that pass on the program as it is and reach something.
pub fn found(work: &Path) -> Vec<Test> {
    looked(work).into_iter().filter_map(|l| l.test).collect()
}

/// `mutants cover`: goes on where it was stopped.
pub fn cover(work: &Path, longest: Duration, leave_out: &[String]) -> Result<(), Box<dyn Error>> {
    let binaries: Vec<Binary> = serde_json::from_slice(&fs::read(work.join("binaries.json"))?)?;
    let known: BTreeSet<(usize, String)> = looked(work).into_iter().map(|l| (l.binary, l.name)).collect();
    let mut all = Vec::new();
    for (i, binary) in binaries.iter().enumerate().filter(|(_, b)| !leave_out.contains(&b.name)) {
        all.extend(names(binary)?.into_iter().map(|name| (i, name)).filter(|test| !known.contains(test)));
    }
    let todo = Mutex::new(all.iter());
    let file = Mutex::new(OpenOptions::new().create(true).append(true).open(work.join("tests.jsonl"))?);
    std::thread::scope(|scope| {
        for job in 0..JOBS {
            let (todo, file, binaries) = (&todo, &file, &binaries);
            scope.spawn(move || {
                let seen = work.join(format!("seen.{job}"));
                loop {
                    let Some((i, name)) = todo.lock().ok().and_then(|mut t| t.next()) else { break };
                    let test = watched(&binaries[*i], *i, name, &seen, longest);
                    let looked = Looked { binary: *i, name: name.clone(), test };
                    if let (Ok(mut file), Ok(line)) = (file.lock(), serde_json::to_string(&looked)) {
                        _ = writeln!(file, "{line}");
                    }
                }
            });
        }
    });
    println!("{} of {} tests reach mutants and pass", found(work).len(), looked(work).len());
    Ok(())
}

/// A test that passes on the program as it is, and reaches something.
fn watched(binary: &Binary, i: usize, name: &str, seen: &Path, longest: Duration) -> Option<Test> {
    _ = fs::remove_file(seen);
    let path = fs::canonicalize(seen.parent()?).ok()?.join(seen.file_name()?);
    let start = Instant::now();
    let ended = run(binary, name, "watch", path.to_str(), longest).ok()?;
    let seconds = start.elapsed().as_secs_f64();
    if ended != Ended::Passed {
        println!("{} {name}: {ended:?} on the program as it is; left out", binary.name);
        return None;
    }
    let text = fs::read_to_string(path).unwrap_or_default();
    let reaches: BTreeSet<u32> = text.lines().filter_map(|l| l.parse().ok()).collect();
    (!reaches.is_empty()).then(|| Test {
        binary: i,
        name: name.into(),
        seconds,
        reaches: reaches.into_iter().collect(),
    })
}
