//! Random scenes over the whole documented range: every one is solved, or refused for a reason that is true.
//!
//! `cargo run --profile test -p verification --bin random_scenes -- KIND SEED FROM TO out.jsonl` runs documents
//! FROM .. TO of a seed, `pairs`, `gearboxes` or `plans`, and appends a line of JSON for each; those that are in the file
//! already are left out. The table is of all of them. `... --bin random_scenes -- show KIND SEED INDEX DIR` writes one
//! with its files into a folder.
#![allow(clippy::print_stdout, reason = "the table is what it is for")]

use std::{
    collections::BTreeSet,
    error::Error,
    fs,
    io::Write,
    path::{Path, PathBuf},
    process::ExitCode,
};

use verification::{
    program::as_command,
    random_scenes::{Limits, Refusals, Tally, drawer, try_scene},
};

fn main() -> ExitCode {
    if let Some(code) = as_command() {
        return code;
    }
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["show", kind, seed, index, folder] => show(kind, seed, index, folder).map(|()| 0),
        [kind, seed, from, to, out] => run(kind, seed, from, to, out),
        _ => Err("KIND SEED FROM TO OUT.jsonl are wanted".into()),
    };
    match done {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            println!("{error}");
            ExitCode::from(2)
        }
    }
}

/// Runs scenes; gives how many of them show a fault of the program.
fn run(kind: &str, seed: &str, from: &str, to: &str, out: &str) -> Result<usize, Box<dyn Error>> {
    let draw = drawer(kind)?;
    let (seed, from, to): (u64, u64, u64) = (seed.parse()?, from.parse()?, to.parse()?);
    let before = before(Path::new(out))?;
    let done: BTreeSet<u64> = before.iter().filter_map(|line| line["index"].as_u64()).collect();
    let mut file = fs::OpenOptions::new().create(true).append(true).open(out)?;
    let (program, refusals, mut tally) = (std::env::current_exe()?, Refusals::committed()?, Tally::default());
    before.iter().for_each(|line| tally.add(line));
    for index in (from..to).filter(|index| !done.contains(index)) {
        let folder = tempfile::tempdir()?;
        let scene = draw(seed, index);
        let verdict = try_scene(&program, folder.path(), index, &scene, (Limits::default(), &refusals))?;
        let line = verdict.to_json();
        writeln!(file, "{line}")?;
        file.flush()?;
        tally.add(&line);
        for wrong in &verdict.wrong {
            println!("{index} ({}): {wrong}", verdict.model);
        }
    }
    print!("{}", tally.table());
    Ok(tally.wrong())
}

/// What a file of results holds already.
fn before(out: &Path) -> Result<Vec<serde_json::Value>, Box<dyn Error>> {
    let text = if out.exists() { fs::read_to_string(out)? } else { String::new() };
    Ok(text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect())
}

fn show(kind: &str, seed: &str, index: &str, folder: &str) -> Result<(), Box<dyn Error>> {
    let scene = drawer(kind)?(seed.parse()?, index.parse()?);
    let folder = PathBuf::from(folder);
    fs::create_dir_all(&folder)?;
    fs::write(folder.join("scene.toml"), scene.draft.text()?)?;
    for (name, content) in &scene.draft.files {
        fs::write(folder.join(name), content)?;
    }
    Ok(())
}
