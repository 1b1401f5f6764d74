//! What the tests of every program said of themselves, one file each in the target folder.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

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
    if let Some(folder) = std::env::var_os(FOLDER) {
        return folder.into();
    }
    let own = Path::new(env!("OUT_DIR"));
    let build = own.ancestors().find(|a| a.file_name().is_some_and(|n| n == "build"));
    build.and_then(Path::parent).unwrap_or(own).join("left-out")
}

/// Top of the repository.
fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap_or(Path::new("."))
}

/// Keeps in a folder what the tests of one source file (`file!()`) are about to do, in place of what they did the last time; `part` where several keep
/// their own.
///
/// # Errors
/// Of the file system.
pub fn note(folder: &Path, source: &str, part: &str, records: &[Record]) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let mut text = format!("{source}\n");
    for Record { test, reason } in records {
        let _ = writeln!(text, "{test}\t{}", reason.as_deref().unwrap_or_default());
    }
    let name: String = format!("{source} {part}").chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
    // Whole or not at all: another program may read at this moment.
    let partial = folder.join(format!(".{name}.{}", std::process::id()));
    std::fs::write(&partial, text)?;
    std::fs::rename(partial, folder.join(name))
}

/// All records, by source file; those of files that are no more are left alone.
fn read(folder: &Path) -> BTreeMap<String, Vec<Record>> {
    let mut all: BTreeMap<String, Vec<Record>> = BTreeMap::new();
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path()).collect();
    files.retain(|file| !file.file_name().is_some_and(|n| n.to_string_lossy().starts_with('.')));
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

/// Says the [`summary`] of this target folder on stderr, past a test harness that keeps what tests print.
pub fn tell() {
    // Whoever has closed stderr does not want to hear it.
    let _ = write!(std::io::stderr().lock(), "\n{}", summary(&folder()));
}
