//! What the tests of every program said of themselves, one file each in the target folder.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Variable of the environment that names another folder for the records.
pub const FOLDER: &str = "ALE_GEAR_LEFT_OUT";

/// A test that needs a program of others.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Record {
    /// Name of the test.
    pub test: String,
    /// Why it was left out; `None`: it was not.
    pub reason: Option<String>,
}

/// Where records are kept: `left-out` in the folder of the profile, `target/debug`.
pub fn folder() -> PathBuf {
    std::env::var_os(FOLDER).map_or_else(|| env!("ALE_GEAR_RECORDS").into(), PathBuf::from)
}

/// Top of the repository.
fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap_or(Path::new("."))
}

/// Keeps in a folder what the tests of one source file (`file!()`) are about to do, in place of what they did the last
/// time; `part` where several keep their own.
///
/// # Errors
/// Errors of the file system.
pub fn note(folder: &Path, source: &str, part: &str, records: &[Record]) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let mut text = format!("{source}\n");
    for Record { test, reason } in records {
        let _ = writeln!(text, "{test}\t{}", reason.as_deref().unwrap_or_default());
    }
    let name: String = format!("{source} {part}").chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
    // Tests of one program may come at the same time, and the last one must see all records.
    let _one = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    std::fs::write(folder.join(name).with_extension(RECORD), text)?;
    write_examples(folder)
}

static ONE: Mutex<()> = Mutex::new(());
/// What names of records end with.
const RECORD: &str = "txt";
/// File of the ignored examples.
const EXAMPLES: &str = "examples.rs";

/// A word of Rust that looks like a text.
fn identifier(text: &str) -> String {
    let plain: String = text.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { ' ' }).collect();
    plain.split_whitespace().collect::<Vec<_>>().join("_").to_lowercase()
}

/// Every test that was left out as an ignored example of a module named after the reason: what rustdoc shows.
fn write_examples(folder: &Path) -> std::io::Result<()> {
    let mut modules: BTreeMap<String, BTreeMap<String, String>> = BTreeMap::new();
    for Record { test, reason } in read(folder).into_values().flatten() {
        if let Some(reason) = reason {
            modules.entry(identifier(&reason)).or_default().insert(identifier(&test), reason);
        }
    }
    let mut text = String::new();
    for (module, tests) in modules {
        let _ = writeln!(text, "pub mod {module} {{");
        for (test, reason) in tests {
            let _ = writeln!(text, "/// ```ignore\n/// // {reason}\n/// ```\npub fn {test}() {{}}");
        }
        text.push_str("}\n");
    }
    std::fs::write(folder.join(EXAMPLES), text)
}

/// All records, by source file; those of files that are no more are left alone.
fn read(folder: &Path) -> BTreeMap<String, Vec<Record>> {
    let mut all: BTreeMap<String, Vec<Record>> = BTreeMap::new();
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path()).collect();
    files.retain(|file| file.extension().is_some_and(|e| e == RECORD));
    files.sort();
    for text in files.iter().filter_map(|file| std::fs::read_to_string(file).ok()) {
        let mut lines = text.lines();
        let Some(source) = lines.next().filter(|source| repository().join(source).is_file()) else { continue };
        let tests = lines.filter_map(|line| line.split_once('\t')).map(|(test, reason)| Record {
            test: test.to_owned(),
            reason: Some(reason).filter(|r| !r.is_empty()).map(str::to_owned),
        });
        all.entry(source.to_owned()).or_default().extend(tests);
    }
    all
}

/// What was left out, and why: a line for every reason, and a last one that says how much.
///
/// A record lasts until its program runs again; after all tests each is of this run.
pub fn summary(folder: &Path) -> String {
    let all = read(folder);
    let mut reasons: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let mut count = 0;
    for Record { test, reason } in all.values().flatten() {
        count += 1;
        if let Some(reason) = reason {
            reasons.entry(reason).or_default().push(test);
        }
    }
    let mut text = String::new();
    for (reason, tests) in &reasons {
        let _ = writeln!(text, "{reason}: left out {}", tests.join(", "));
    }
    let left: usize = reasons.values().map(Vec::len).sum();
    let _ = match (left, count) {
        (_, 0) => writeln!(text, "tests that need programs of others: none has been run yet"),
        (0, _) => writeln!(text, "tests that need programs of others: all {count} were run"),
        _ => {
            let why: Vec<&str> = reasons.into_keys().collect();
            writeln!(text, "tests that need programs of others: {left} of {count} LEFT OUT ({})", why.join("; "))
        }
    };
    text
}
