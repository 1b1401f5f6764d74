//! Headline numbers and inputs of several runs, row by row.

use std::collections::HashMap;

use answer::leaves;
use serde::Serialize;
use serde_json::Value;

use super::ResultFolder;

/// A number of every run that has it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NumberRow {
    /// Name of the number with unit; `a.b` and `a[1]` where it lies deeper in the summary.
    pub key: String,
    /// Run by run; `None` where a run has no such number.
    pub values: Vec<Option<f64>>,
    /// Against the first run; the first entry belongs to the second run.
    pub differences: Vec<Option<Difference>>,
}

/// Difference between a number and that of the first run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Difference {
    /// This run's less the first one's, in the unit of the key.
    pub absolute: f64,
    /// This run's less the first one's over the first one's, per cent, so that a load twice as large reads +100 on
    /// either side of 0; `None` where the first is 0.
    pub per_cent: Option<f64>,
}

/// An input that the runs do not have in common.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WordRow {
    /// Key of the scene, with dots.
    pub key: String,
    /// Run by run, as JSON; `None` where a scene has no such key.
    pub values: Vec<Option<String>>,
}

/// Parts of the summary beside the headline that are worth a row.
pub const BESIDE: [&str; 5] = ["geometry.eps_gamma", "dof_before", "dof_after", "cost.wall_s", "cost.peak_memory_mb"];

/// Headline numbers of all runs in the order of their lists, which begin with the physics and end with residuals and
/// counts; then contact ratio, degrees of freedom and cost.
pub fn headline_rows(runs: &[ResultFolder]) -> Vec<NumberRow> {
    let row = |(key, values): (String, Vec<Option<f64>>)| {
        let first = values.first().copied().flatten();
        let differences = values.iter().skip(1).map(|v| Some(difference(first?, (*v)?))).collect();
        NumberRow { key, values, differences }
    };
    let mut rows = by_key(runs.iter().map(numbers));
    let lists = || analysis::objects().into_iter().filter(|(name, _)| name.starts_with("headline"));
    let listed: Vec<&str> = lists().flat_map(|(_, keys)| keys).map(|key| key.name).collect();
    let beside = |key: &str| BESIDE.iter().any(|own| key.starts_with(own));
    rows.sort_by_key(|(key, _)| {
        let first = key.split(['.', '[']).next().unwrap_or_default();
        (beside(key), listed.iter().position(|own| *own == first).unwrap_or(listed.len()))
    });
    rows.into_iter().map(row).collect()
}

/// A row for each key, in the order in which they first appear, with the value of every run that has it: of one that
/// has it twice the first.
fn by_key<T: Clone>(runs: impl ExactSizeIterator<Item = Vec<(String, T)>>) -> Vec<(String, Vec<Option<T>>)> {
    let count = runs.len();
    let mut places: HashMap<String, usize> = HashMap::new();
    let mut rows: Vec<(String, Vec<Option<T>>)> = Vec::new();
    for (run, values) in runs.enumerate() {
        for (key, value) in values {
            let place = *places.entry(key).or_insert_with_key(|key| {
                rows.push((key.clone(), vec![None; count]));
                rows.len() - 1
            });
            rows[place].1[run].get_or_insert(value);
        }
    }
    rows
}

fn difference(first: f64, other: f64) -> Difference {
    let absolute = other - first;
    Difference { absolute, per_cent: (first != 0.0).then(|| 100.0 * absolute / first) }
}

fn numbers(run: &ResultFolder) -> Vec<(String, f64)> {
    let mut all = Vec::new();
    let leaf = |key: &str, value: &Value, all: &mut Vec<(String, f64)>| {
        if let Some(number) = value.as_f64() {
            all.push((key.to_owned(), number));
        }
    };
    leaves("", &run.summary()["headline"], &mut |key, value| leaf(key, value, &mut all));
    for key in BESIDE {
        if let Some(value) = run.summary().pointer(&format!("/{}", key.replace('.', "/"))) {
            leaves(key, value, &mut |key, value| leaf(key, value, &mut all));
        }
    }
    all
}

/// Keys of the scenes that differ in value or that not all scenes have, in the order of the first run.
pub fn input_rows(runs: &[ResultFolder]) -> Vec<WordRow> {
    let rows = by_key(runs.iter().map(inputs)).into_iter().map(|(key, values)| WordRow { key, values });
    rows.filter(|row| row.values.iter().any(|v| *v != row.values[0])).collect()
}

fn inputs(run: &ResultFolder) -> Vec<(String, String)> {
    let mut all = Vec::new();
    leaves("", &run.summary()["inputs"], &mut |key, value| all.push((key.to_owned(), value.to_string())));
    all
}
