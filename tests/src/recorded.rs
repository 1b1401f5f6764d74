//! Results as they are recorded in `tests/data/digests.toml`: one digest a document, and sums of every column by which
//! another machine is judged, whose last bits differ.

use std::{collections::BTreeMap, fs, io, path::Path};

use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use crate::random_scenes::Csv;

/// Columns that are nothing but round-off, or counts of steps towards it.
const NOISE: [&str; 8] = [
    "residual",
    "iterations",
    "newton_steps",
    "tail",
    "refused_steps",
    "relative_error",
    "periodicity",
    "bulk_compliance_error",
];
/// Digits of the digest.
const DIGITS: usize = 9;
/// Difference of sums over their size that other last bits may make.
const LAST_BITS: f64 = 1e-7;

/// What is recorded of a document.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recorded {
    /// Digest of the rows of all tables and of the headline, rounded.
    pub digest: String,
    /// Sums of every column, by table and name: sum of sizes, and the sum of values weighted by their row.
    pub sums: BTreeMap<String, [f64; 2]>,
}

/// The whole file.
pub type Record = BTreeMap<String, Recorded>;

/// What a folder of results comes to.
///
/// # Errors
/// When its files cannot be read.
pub fn of_folder(folder: &Path) -> io::Result<Recorded> {
    let mut columns: BTreeMap<String, Column> = BTreeMap::new();
    for file in csv_files(folder)? {
        let csv = Csv::read(&folder.join(&file))?;
        for name in csv.names.iter().filter(|n| !is_noise(n)) {
            let column = Column::of(&csv, name);
            columns.insert(format!("{}.{name}", file.trim_end_matches(".csv")), column);
        }
    }
    let summary: Json = serde_json::from_slice(&fs::read(folder.join("summary.json"))?).map_err(io::Error::other)?;
    flatten("headline", &summary["headline"], &mut columns);
    let mut hasher = blake3::Hasher::new();
    for (name, Column { values, words }) in &columns {
        hasher.update(name.as_bytes());
        hasher.update(words.as_bytes());
        let largest = values.iter().filter(|v| v.is_finite()).fold(0.0, |m: f64, v| m.max(v.abs()));
        for value in values {
            // What is a billionth of its column's largest is as good as nothing.
            let value = if value.abs() < 1e-9 * largest { 0.0 } else { *value };
            hasher.update(format!("{value:.0$e};", DIGITS - 1).as_bytes());
        }
    }
    let sums = columns.into_iter().map(|(name, column)| (name, sums(&column.values))).collect();
    Ok(Recorded { digest: hasher.finalize().to_hex().to_string(), sums })
}

/// Numbers of a column, and its cells that are none.
#[derive(Default)]
struct Column {
    values: Vec<f64>,
    words: String,
}

impl Column {
    fn of(csv: &Csv, name: &str) -> Self {
        let mut column = Self { values: csv.column(name).unwrap_or_default(), words: String::new() };
        let at = csv.names.iter().position(|n| n == name).unwrap_or_default();
        for (row, _) in csv.rows.iter().zip(&column.values).filter(|(_, v)| v.is_nan()) {
            column.words.push_str(row.get(at).map_or("", String::as_str));
            column.words.push(';');
        }
        column
    }
}

/// Names of the tables in a folder of results, in order.
fn csv_files(folder: &Path) -> io::Result<Vec<String>> {
    let names = fs::read_dir(folder)?.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    let mut names = names.collect::<io::Result<Vec<String>>>()?;
    names.retain(|n| n.ends_with(".csv"));
    names.sort();
    Ok(names)
}

fn is_noise(name: &str) -> bool {
    NOISE.iter().any(|n| name.contains(n))
}

fn sums(values: &[f64]) -> [f64; 2] {
    let finite = values.iter().enumerate().filter(|(_, v)| v.is_finite());
    finite.fold([0.0; 2], |[sizes, weighted], (i, v)| [sizes + v.abs(), weighted + v * (1.0 + (i % 7) as f64)])
}

/// Numbers of the headline, each a column of one row.
fn flatten(path: &str, value: &Json, columns: &mut BTreeMap<String, Column>) {
    match value {
        Json::Number(number) if !is_noise(path) && !path.contains("certificate") && !path.contains("worst_") => {
            let values = vec![number.as_f64().unwrap_or(f64::NAN)];
            columns.insert(path.to_owned(), Column { values, ..Column::default() });
        }
        Json::Array(list) => list.iter().enumerate().for_each(|(i, v)| flatten(&format!("{path}.{i}"), v, columns)),
        Json::Object(map) => map.iter().for_each(|(key, v)| flatten(&format!("{path}.{key}"), v, columns)),
        _ => {}
    }
}

impl Recorded {
    /// What is not as it was recorded: nothing where the digest is the same, or where every sum is to the last bits.
    pub fn changes(&self, now: &Self) -> Vec<String> {
        if self.digest == now.digest {
            return Vec::new();
        }
        let mut changed = Vec::new();
        for (name, then) in &self.sums {
            let Some(now) = now.sums.get(name) else {
                changed.push(format!("{name} is gone"));
                continue;
            };
            // Of what is round-off beside the other columns nothing is left to compare.
            if (0..2).any(|i| (then[i] - now[i]).abs() > LAST_BITS * (then[0].max(now[0])) + 1e-12) {
                changed.push(format!("{name}: sums {then:?}, now {now:?}"));
            }
        }
        changed.extend(now.sums.keys().filter(|n| !self.sums.contains_key(*n)).map(|n| format!("{n} is new")));
        changed
    }
}
