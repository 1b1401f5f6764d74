//! Draws mutants, leaves out those that do not compile, and builds the tests with the others.

use std::{
    collections::{BTreeMap, BTreeSet},
    error::Error,
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use rand::{SeedableRng, rngs::StdRng, seq::index};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::{
    sites::{Site, sites},
    tree::{self, Written},
};

/// What was drawn, and what became of it.
#[derive(Serialize, Deserialize)]
pub struct Drawn {
    pub seed: u64,
    /// All changes that could be made.
    pub of: usize,
    /// By number from 1 on; 0 is the program as it is.
    pub mutants: BTreeMap<usize, Site>,
    /// Those that are no program.
    pub not_compiled: BTreeSet<usize>,
}

impl Drawn {
    pub fn read(work: &Path) -> Result<Self, Box<dyn Error>> {
        Ok(serde_json::from_slice(&fs::read(work.join("drawn.json"))?)?)
    }

    pub fn viable(&self) -> impl Iterator<Item = (usize, &Site)> {
        self.mutants.iter().filter(|(n, _)| !self.not_compiled.contains(n)).map(|(n, s)| (*n, s))
    }
}

/// `mutants prepare`.
pub fn prepare(root: &Path, work: &Path, seed: u64, sample: usize) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(work.join("tree"))?;
    let root = fs::canonicalize(root)?;
    let tree = fs::canonicalize(work.join("tree"))?;
    let mut all = Vec::new();
    for (file, text) in tree::sources(&root)? {
        all.extend(sites(&file, &text).map_err(|e| format!("{file}: {e}"))?);
    }
    let mut chosen = index::sample(&mut StdRng::seed_from_u64(seed), all.len(), sample.min(all.len())).into_vec();
    chosen.sort_unstable();
    let mutants = chosen.iter().enumerate().map(|(n, &i)| (n + 1, all[i].clone())).collect();
    let mut drawn = Drawn { seed, of: all.len(), mutants, not_compiled: BTreeSet::new() };
    println!("{} changes can be made, {} are drawn", drawn.of, drawn.mutants.len());
    tree::copy(&root, &tree)?;
    loop {
        let places = tree::write(&tree, &root, &drawn.viable().collect::<Vec<_>>())?;
        let broken = broken(&tree, &places)?;
        if broken.is_empty() {
            break;
        }
        println!("{} do not compile", broken.len());
        drawn.not_compiled.extend(broken);
    }
    fs::write(work.join("drawn.json"), serde_json::to_vec_pretty(&drawn)?)?;
    println!("{} compile; building the tests", drawn.viable().count());
    let binaries = binaries(&tree)?;
    fs::write(work.join("binaries.json"), serde_json::to_vec_pretty(&binaries)?)?;
    println!("{} programs of tests", binaries.len());
    Ok(())
}

fn cargo(tree: &Path, words: &[&str]) -> Result<Vec<Value>, Box<dyn Error>> {
    let output = Command::new("cargo")
        .args(words)
        .args(["--workspace", "--message-format=json"])
        .current_dir(tree)
        .envs([("CARGO_INCREMENTAL", "0"), ("CARGO_PROFILE_DEV_DEBUG", "0"), ("CARGO_PROFILE_TEST_DEBUG", "0")])
        .stderr(Stdio::inherit())
        .output()?;
    Ok(output.stdout.split(|b| *b == b'\n').filter_map(|line| serde_json::from_slice(line).ok()).collect())
}

/// Mutants in which an error of the compiler lies.
fn broken(tree: &Path, places: &BTreeMap<String, Written>) -> Result<BTreeSet<usize>, Box<dyn Error>> {
    let mut broken = BTreeSet::new();
    for message in cargo(tree, &["check", "--keep-going"])? {
        let message = &message["message"];
        if message["level"] != "error" {
            continue;
        }
        let spans = message["spans"].as_array().map(Vec::as_slice).unwrap_or_default();
        let before = broken.len();
        let mut within = false;
        for span in spans {
            let (Some(file), Some(start), Some(end)) =
                (span["file_name"].as_str(), span["byte_start"].as_u64(), span["byte_end"].as_u64())
            else {
                continue;
            };
            let written = places.get(file).map(Vec::as_slice).unwrap_or_default();
            // The innermost one.
            let hit = written
                .iter()
                .filter(|(_, r)| r.start <= start as usize && (end as usize) <= r.end)
                .min_by_key(|(_, r)| r.len());
            if let Some((number, _)) = hit {
                within = true;
                broken.insert(*number);
            }
        }
        if !within && broken.len() == before && !spans.is_empty() {
            return Err(format!("an error outside of all mutants: {}", message["rendered"]).into());
        }
    }
    Ok(broken)
}

/// A program of tests: where it is, and the folder that Cargo starts it in.
#[derive(Serialize, Deserialize)]
pub struct Binary {
    pub path: PathBuf,
    pub folder: PathBuf,
    pub name: String,
}

fn binaries(tree: &Path) -> Result<Vec<Binary>, Box<dyn Error>> {
    let mut found = Vec::new();
    for message in cargo(tree, &["test", "--no-run"])? {
        let (Some(path), Some(manifest)) = (message["executable"].as_str(), message["manifest_path"].as_str()) else {
            continue;
        };
        if message["profile"]["test"] == true {
            let folder = Path::new(manifest).parent().ok_or("a manifest without a folder")?.to_path_buf();
            let name = message["target"]["name"].as_str().unwrap_or_default().to_string();
            found.push(Binary { path: path.into(), folder, name });
        }
    }
    if found.is_empty() {
        return Err("no test was built".into());
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(found)
}
