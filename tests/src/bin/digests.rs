//! Results of the small documents as they are recorded in `tests/data/digests.toml`.
//!
//! `cargo run --profile test --bin digests` writes the file again: after a change of results that was
//! decided.
#![allow(clippy::print_stdout, reason = "what has changed is what one wants to see")]

use std::{error::Error, fs, path::PathBuf, process::ExitCode};

use testing::small_scenes;
use verification::{
    program::{ale_gear, as_command},
    recorded::{Record, of_folder},
};

fn main() -> ExitCode {
    if let Some(code) = as_command() {
        return code;
    }
    match write() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            println!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn write() -> Result<(), Box<dyn Error>> {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("data/digests.toml");
    let old: Record = fs::read_to_string(&file).ok().map(|text| toml::from_str(&text)).transpose()?.unwrap_or_default();
    let program = std::env::current_exe()?;
    let mut record = Record::new();
    for document in small_scenes::all() {
        let name = document.name;
        let folder = tempfile::tempdir()?;
        document.lay_out(folder.path())?;
        let words = document.words_into("o", &["--no-cache", "--threads", "1"]);
        let run = ale_gear(&program, folder.path(), &words).output()?;
        if !run.status.success() {
            return Err(format!("{name}: {}", String::from_utf8_lossy(&run.stderr)).into());
        }
        let now = of_folder(&folder.path().join("o"))?;
        match old.get(name).map(|then| then.changes(&now)) {
            None => println!("{name}: new"),
            Some(changes) if changes.is_empty() => {}
            Some(changes) => println!("{name}: {}", changes.join("; ")),
        }
        record.insert(name.to_owned(), now);
    }
    fs::write(&file, toml::to_string(&record)?)?;
    println!("{} documents", record.len());
    Ok(())
}
