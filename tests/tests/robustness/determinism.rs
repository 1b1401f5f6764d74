//! Bytes are equal whatever the threads, whatever the cache, in one piece or two; numbers are those that were recorded.

use std::{
    collections::BTreeMap,
    path::Path,
    sync::{Arc, Mutex, OnceLock},
};

use testing::small_scenes::{self, SmallDocument};
use verification::{
    killed::{Files, files_of},
    program::ale_gear,
    recorded::{Record, Recorded, of_folder},
};

use crate::program;

/// Solves a document that lies in a folder.
fn run(document: &SmallDocument, folder: &Path, out: &str, words: &[&str]) -> Files {
    let run = ale_gear(program(), folder, &document.words_into(out, words)).output().unwrap();
    assert!(run.status.success(), "{words:?}: {}", String::from_utf8_lossy(&run.stderr));
    files_of(&folder.join(out)).unwrap()
}

/// Names of the files that differ.
fn other(a: &Files, b: &Files) -> Vec<String> {
    let names = a.keys().chain(b.keys());
    let mut names: Vec<String> = names.filter(|n| a.get(*n) != b.get(*n)).map(|n| n.display().to_string()).collect();
    names.dedup();
    names
}

/// What a document gives on one thread without a cache: every law below holds other runs against it.
struct Base {
    files: Files,
    recorded: Recorded,
}

/// The base of a document, solved by the first law that asks for it.
fn base(document: &SmallDocument) -> Arc<Base> {
    static SOLVED: Mutex<BTreeMap<&str, Arc<OnceLock<Arc<Base>>>>> = Mutex::new(BTreeMap::new());
    let own = Arc::clone(SOLVED.lock().unwrap().entry(document.name).or_default());
    let solved = || {
        let folder = tempfile::tempdir().unwrap();
        document.lay_out(folder.path()).unwrap();
        let files = run(document, folder.path(), "base", &["--no-cache", "--threads", "1"]);
        Arc::new(Base { files, recorded: of_folder(&folder.path().join("base")).unwrap() })
    };
    Arc::clone(own.get_or_init(solved))
}

#[test]
fn bytes_depend_on_neither_threads_nor_cache() {
    for document in small_scenes::all() {
        let name = document.name;
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path();
        document.lay_out(at).unwrap();
        let base = base(&document);
        let ways = [
            ("7 threads", &["--no-cache", "--threads", "7"][..]),
            ("a cold cache", &["--cache", "kept", "--threads", "2"]),
            ("a warm cache", &["--cache", "kept", "--threads", "1"]),
            ("2 threads", &["--no-cache", "--threads", "2"]),
            ("16 threads", &["--no-cache", "--threads", "16"]),
        ];
        for (what, words) in &ways[..testing::cases(3, ways.len())] {
            let files = run(&document, at, "again", words);
            assert!(files == base.files, "{name}: with {what} other bytes in {:?}", other(&base.files, &files));
        }
    }
}

#[test]
fn bytes_do_not_depend_on_a_stop_on_the_way() {
    let stops = ["motion_steady", "motion_free", "motion_explicit", "motion_tolerance", "motion_ramp", "motion_modes"];
    for document in small_scenes::all().into_iter().filter(|d| stops.contains(&d.name)) {
        let name = document.name;
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path();
        document.lay_out(at).unwrap();
        let base = base(&document);
        let words = document.words_into("o", &["--no-cache", "--stop-after-cycles", "1"]);
        let stopped = ale_gear(program(), at, &words).output().unwrap();
        assert!(stopped.status.success(), "{name}: {}", String::from_utf8_lossy(&stopped.stderr));
        assert!(at.join("o.checkpoint").exists(), "{name}: no checkpoint");
        let files = run(&document, at, "o", &["--no-cache", "--resume", "--threads", "2"]);
        assert!(files == base.files, "{name}: taken up again other bytes in {:?}", other(&base.files, &files));
    }
}

const AGAIN: &str = "results changed: if someone decided that, write tests/data/digests.toml again by \
                     `cargo run --profile test --bin digests`";

#[test]
fn results_are_those_that_were_recorded() {
    let record: Record = toml::from_str(include_str!("../../data/digests.toml")).unwrap();
    let documents = small_scenes::all();
    let (mut names, mut recorded): (Vec<&str>, Vec<&str>) =
        (documents.iter().map(|d| d.name).collect(), record.keys().map(String::as_str).collect());
    names.sort_unstable();
    recorded.sort_unstable();
    assert_eq!(names, recorded, "documents and recorded results; {AGAIN}");
    for document in documents {
        let changes = record[document.name].changes(&base(&document).recorded);
        assert!(changes.is_empty(), "{}: {}\n{AGAIN}", document.name, changes.join("\n"));
    }
}
