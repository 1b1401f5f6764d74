//! Files of measured pairs that grow: a line of JSON each, with the pair's `seed` and `index`.

use std::{
    error::Error,
    fs::{self, File},
    io::{BufRead, BufReader},
};

use serde_json::{Value, json};

/// Pairs of a seed that a file has; none where there is no such file.
///
/// # Errors
/// What is wrong with its lines.
pub fn pairs_done(file: &str, seed: u64) -> Result<Vec<u64>, Box<dyn Error + Send + Sync>> {
    let Ok(file) = File::open(file) else { return Ok(Vec::new()) };
    let mut found = Vec::new();
    for line in BufReader::new(file).lines() {
        let pair: Value = serde_json::from_str(&line?)?;
        if pair["seed"] == json!(seed) {
            found.extend(pair["index"].as_u64());
        }
    }
    Ok(found)
}

/// All lines of some files.
///
/// # Errors
/// What cannot be read.
pub fn lines(files: &[String]) -> Result<Vec<Value>, Box<dyn Error + Send + Sync>> {
    let mut all = Vec::new();
    for file in files {
        for line in fs::read_to_string(file)?.lines() {
            all.push(serde_json::from_str(line)?);
        }
    }
    Ok(all)
}
