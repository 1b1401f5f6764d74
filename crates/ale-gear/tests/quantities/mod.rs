//! Which quantities of a result folder the documents leave out.

#![allow(dead_code)] // each test file uses its own part

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::markdown::Page;

/// Names in code font in a page, beside those that stand for many: `<gear>_..`, `..pair_<k>..`, `_suffix`.
pub struct Documented(BTreeSet<String>);

impl Documented {
    pub fn by(page: &Page) -> Self {
        let names = page.code().into_iter().map(|(name, _)| name);
        Self(names.flat_map(|name| [generalised(&name), name]).collect())
    }

    fn has(&self, name: &str) -> bool {
        let general = generalised(name);
        // Any column of `history.csv` may stand behind `mean_` where there is `mean_<column>`.
        let mut starts = self.0.iter().filter_map(|word| word.split_once("<column>").map(|(start, _)| start));
        // The same of derivatives, `d_<quantity>_per_<key>` of the scene.
        let mut by_key = self.0.iter().filter_map(|word| word.split_once("<key>").map(|(start, _)| start));
        self.0.contains(name)
            || by_key.any(|start| start.starts_with("d_") && general.starts_with(start))
            || self.0.contains(&general)
            || starts.any(|start| !start.is_empty() && !start.contains('<') && name.starts_with(start))
    }

    /// Columns of the tables and keys of the summary in `folder` that are not there, each with its file.
    pub fn missing(&self, folder: &Path) -> Vec<String> {
        let of_file = |(path, quantities): (PathBuf, BTreeSet<String>)| {
            // A key of the scene with its dots names its own column.
            let missing = quantities.into_iter().filter(|q| !q.contains('.') && !self.has(q));
            missing.map(|q| format!("{q} of {}", path.display())).collect::<Vec<_>>()
        };
        written_in(folder).into_iter().flat_map(of_file).collect()
    }
}

/// Columns of the tables and keys of the summary in a folder, file by file.
pub fn written_in(folder: &Path) -> Vec<(PathBuf, BTreeSet<String>)> {
    let mut names: Vec<_> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    names.sort();
    let quantities = |path: &PathBuf| -> Option<BTreeSet<String>> {
        let text = || std::fs::read_to_string(path).unwrap();
        match path.extension().and_then(|e| e.to_str()) {
            Some("csv") => Some(text().lines().next().unwrap_or("").split(',').map(str::to_owned).collect()),
            Some("json") => Some(keys(&serde_json::from_str(&text()).unwrap())),
            _ => None,
        }
    };
    names.into_iter().filter_map(|path| quantities(&path).map(|q| (path, q))).collect()
}

/// `pinion_x_um` as `<gear>_x_um`, numbers of pairs, meshes, bearings and outputs as `<k>`, of harmonics as `<h>`.
pub fn generalised(name: &str) -> String {
    let name = ["pinion_", "wheel_"]
        .iter()
        .find_map(|g| name.strip_prefix(g))
        .map_or(name.to_owned(), |n| format!("<gear>_{n}"));
    let mut words: Vec<&str> = name.split('_').collect();
    for i in 1..words.len() {
        let is_number = words[i].parse::<i64>().is_ok();
        match words[i - 1] {
            "pair" | "mesh" | "bearing" | "output" | "shaft" | "gear" if is_number => words[i] = "<k>",
            "harmonic" if is_number => words[i] = "<h>",
            "mode" | "order" if is_number => words[i] = "<n>",
            _ => {}
        }
    }
    words.join("_")
}

/// Keys of an object and of all objects in it; the scene that is echoed and the values of remarks have documents of their own.
fn keys(value: &serde_json::Value) -> BTreeSet<String> {
    match value {
        serde_json::Value::Object(map) => map
            .iter()
            .flat_map(|(key, inside)| {
                let elsewhere = key == "inputs" || key == "values" && map.contains_key("code");
                let below = if elsewhere { BTreeSet::new() } else { keys(inside) };
                below.into_iter().chain([key.clone()])
            })
            .collect(),
        serde_json::Value::Array(list) => list.iter().flat_map(keys).collect(),
        _ => BTreeSet::new(),
    }
}
