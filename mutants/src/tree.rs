//! A copy of the workspace, and the mutants in it.

use std::{collections::BTreeMap, error::Error, fs, ops::Range, path::Path};

use walkdir::WalkDir;

use crate::{CRATES, sites::Site};

/// The function that the branches ask. It allocates once at most: some tests count allocations.
const SWITCH: &str = r#"//! Which mutant is alive.
#![allow(missing_docs)]
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};

const UNKNOWN: u32 = u32::MAX;
const WATCHED: u32 = u32::MAX - 1;
static CHOSEN: AtomicU32 = AtomicU32::new(UNKNOWN);
static SEEN: [AtomicBool; 1 << 16] = [const { AtomicBool::new(false) }; 1 << 16];

#[inline(always)]
pub fn on(number: u32) -> bool {
    let chosen = CHOSEN.load(Relaxed);
    if chosen < WATCHED { chosen == number } else { first(number) }
}

#[cold]
fn first(number: u32) -> bool {
    if CHOSEN.load(Relaxed) == UNKNOWN {
        let chosen = match std::env::var("MUTANT") {
            Ok(n) if n == "watch" => WATCHED,
            Ok(n) => n.parse().unwrap_or(0),
            Err(_) => 0,
        };
        CHOSEN.store(chosen, Relaxed);
    }
    let chosen = CHOSEN.load(Relaxed);
    if chosen == WATCHED && !SEEN[number as usize].swap(true, Relaxed) {
        use std::io::Write;
        if let Some(path) = std::env::var_os("MUTANTS_SEEN") {
            if let Ok(mut file) = std::fs::OpenOptions::new().create(true).append(true).open(path) {
                _ = file.write_all(format!("{number}\n").as_bytes());
            }
        }
    }
    chosen == number
}
"#;

/// Copies what tests need, without what was built.
pub fn copy(root: &Path, to: &Path) -> Result<(), Box<dyn Error>> {
    for part in [
        "Cargo.toml",
        "Cargo.lock",
        "README.md",
        "CHANGELOG.md",
        ".ci",
        "crates",
        "tests",
        "benches",
        "meshes",
        "scenes",
        "docs",
    ] {
        for entry in WalkDir::new(root.join(part)).into_iter().filter_entry(|e| e.file_name() != "target") {
            let entry = entry?;
            let target = to.join(entry.path().strip_prefix(root)?);
            if entry.file_type().is_dir() {
                fs::create_dir_all(&target)?;
            } else {
                write_if_new(&target, &fs::read(entry.path())?)?;
            }
        }
    }
    let switch = to.join("crates/mutant");
    fs::create_dir_all(switch.join("src"))?;
    let manifest = "[package]\nname = \"mutant\"\nversion = \"0.1.0\"\nedition = \"2024\"\npublish = false\n\
                    [lib]\ntest = false\ndoctest = false\n";
    write_if_new(&switch.join("Cargo.toml"), manifest.as_bytes())?;
    write_if_new(&switch.join("src/lib.rs"), SWITCH.as_bytes())?;
    for name in CRATES {
        let path = to.join("crates").join(name).join("Cargo.toml");
        let text = fs::read_to_string(&path)?;
        let with = text.replacen("[dependencies]\n", "[dependencies]\nmutant = { path = \"../mutant\" }\n", 1);
        if with == text {
            return Err(format!("{}: there is no [dependencies]", path.display()).into());
        }
        fs::write(path, with)?;
    }
    Ok(())
}

/// Cargo looks at times: a file that is as it was keeps its own.
fn write_if_new(path: &Path, content: &[u8]) -> Result<(), Box<dyn Error>> {
    if fs::read(path).ok().as_deref() != Some(content) {
        fs::write(path, content)?;
    }
    Ok(())
}

/// Sources of the changed crates, paths below the root.
pub fn sources(root: &Path) -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let mut found = Vec::new();
    for name in CRATES {
        for entry in WalkDir::new(root.join("crates").join(name).join("src")).sort_by_file_name() {
            let entry = entry?;
            if entry.path().extension().is_some_and(|e| e == "rs") {
                let file = entry.path().strip_prefix(root)?.to_string_lossy().into_owned();
                found.push((file, fs::read_to_string(entry.path())?));
            }
        }
    }
    Ok(found)
}

/// A mutant's bytes in a file that has been written.
pub type Written = Vec<(usize, Range<usize>)>;

/// Writes the mutants `(number, site)` into the copy: from the file as it was, each expression with its branch around.
pub fn write(to: &Path, root: &Path, mutants: &[(usize, &Site)]) -> Result<BTreeMap<String, Written>, Box<dyn Error>> {
    let mut of_file: BTreeMap<&str, Vec<(usize, &Site)>> = BTreeMap::new();
    for (number, site) in mutants {
        of_file.entry(&site.file).or_default().push((*number, site));
    }
    let mut places = BTreeMap::new();
    for (file, text) in sources(root)? {
        let here = of_file.remove(file.as_str()).unwrap_or_default();
        let (changed, written) = instrument(&text, &here);
        write_if_new(&to.join(&file), changed.as_bytes())?;
        places.insert(file, written);
    }
    Ok(places)
}

/// The text with branches, and where each mutant stands in it.
fn instrument(text: &str, mutants: &[(usize, &Site)]) -> (String, Written) {
    let mut out = String::new();
    let mut written = Vec::new();
    let mut sorted: Vec<_> = mutants.to_vec();
    // Outer before inner.
    sorted.sort_by_key(|(_, s)| (s.place.start, std::cmp::Reverse(s.place.end)));
    emit(text, 0..text.len(), &sorted, &mut out, &mut written);
    (out, written)
}

/// The bytes `range` of the text with the mutants that lie within.
fn emit(text: &str, range: Range<usize>, mutants: &[(usize, &Site)], out: &mut String, written: &mut Written) {
    let mut at = range.start;
    let mut rest = mutants;
    while let Some(((number, site), after)) = rest.split_first() {
        if site.place.start < at || site.place.end > range.end {
            rest = after;
            continue;
        }
        out.push_str(&text[at..site.place.start]);
        let start = out.len();
        at = site.place.end;
        let within = after.iter().take_while(|(_, s)| s.place.start < site.place.end).count();
        if site.word.is_empty() {
            out.push_str(&format!(" if ::mutant::on({number}) {{ return {}; }} ", site.instead));
            rest = after;
        } else {
            out.push_str(&format!("(if ::mutant::on({number}) {{ "));
            out.push_str(&text[site.place.start..site.word.start]);
            out.push_str(&site.instead);
            out.push_str(&text[site.word.end..site.place.end]);
            out.push_str(" } else { ");
            emit(text, site.place.clone(), &after[..within], out, written);
            out.push_str(" })");
            rest = &after[within..];
        }
        written.push((*number, start..out.len()));
    }
    out.push_str(&text[at..range.end]);
}
