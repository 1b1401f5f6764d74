//! Random scenes over the whole documented range: every one is solved, or refused for a reason that is true.
//!
//! `cargo run --profile test -p verification --bin random_scenes -- SEED FROM TO out.jsonl` runs scenes FROM .. TO of a
//! seed, appends a line of JSON for each; those that are in the file already are left out. The table is of all of them.
//! `... --bin random_scenes -- show SEED INDEX DIR` writes one scene with its files into a folder.
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
    random_scenes::{Limits, Refusals, Tally, draw, try_scene},
};

fn main() -> ExitCode {
    if let Some(code) = as_command() {
        return code;
    }
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["show", seed, index, folder] => show(seed, index, folder).map(|()| 0),
        [seed, from, to, out] => run(seed, from, to, out),
        _ => Err("SEED FROM TO OUT.jsonl are wanted".into()),
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
fn run(seed: &str, from: &str, to: &str, out: &str) -> Result<usize, Box<dyn Error>> {
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

fn show(seed: &str, index: &str, folder: &str) -> Result<(), Box<dyn Error>> {
    let scene = draw(seed.parse()?, index.parse()?);
    let folder = PathBuf::from(folder);
    fs::create_dir_all(&folder)?;
    fs::write(folder.join("scene.toml"), scene.draft.text()?)?;
    for (name, content) in &scene.draft.files {
        fs::write(folder.join(name), content)?;
    }
    Ok(())
}
