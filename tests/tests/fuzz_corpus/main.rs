//! What fuzzing has found stays found: every file of its corpora and every past finding goes through the same readers.
//!
//! `fuzz/corpus/TARGET` has inputs that together cover a reader, `tests/data/fuzz_findings/TARGET` those that once broke
//! it. `large` builds what is too large to keep.

mod large;
mod nested;

use std::{
    fs,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use verification::readers::{READERS, Reader, limited::Limited};

#[global_allocator]
static MEMORY: Limited = Limited::new();

/// What any input may take; libFuzzer has the same bound.
const LONGEST: Duration = Duration::from_secs(10);

/// Reads once and holds the time against its bound; too much memory ends the program.
fn within_bounds(name: &str, reader: Reader, bytes: &[u8]) {
    let start = Instant::now();
    reader(bytes);
    let taken = start.elapsed();
    assert!(taken < LONGEST, "{name}: {taken:?} for {} bytes", bytes.len());
}

/// Files of a folder, by name; none where there is no folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut all: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    all.sort();
    all
}

#[test]
fn corpora_and_past_findings_are_read_without_a_panic() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (target, reader) in READERS {
        let corpus = files(&here.join("../fuzz/corpus").join(target));
        assert!(!corpus.is_empty(), "no corpus of {target}");
        for file in corpus.into_iter().chain(files(&here.join("data/fuzz_findings").join(target))) {
            within_bounds(&file.display().to_string(), reader, &fs::read(&file).unwrap());
        }
    }
}
