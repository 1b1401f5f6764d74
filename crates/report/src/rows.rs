//! Columns of a file of rows, read back: a run that was taken up again is judged by all of its rows.

use std::{collections::BTreeMap, path::Path};

use crate::{ReportError, csv::push_row};

/// Columns by name.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Columns {
    names: BTreeMap<String, usize>,
    values: Vec<Vec<f64>>,
}

impl Columns {
    /// Columns without rows.
    pub fn named<S: Into<String>>(names: impl IntoIterator<Item = S>) -> Self {
        let names: BTreeMap<String, usize> = names.into_iter().enumerate().map(|(i, n)| (n.into(), i)).collect();
        let values = vec![Vec::new(); names.len()];
        Self { names, values }
    }

    /// One more row, in the order of the names.
    pub fn push(&mut self, row: impl IntoIterator<Item = f64>) {
        self.values.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
    }

    /// The file of these rows.
    pub fn to_csv(&self) -> String {
        let mut text = self.names_from("").join(",") + "\n";
        for row in 0..self.len() {
            push_row(&mut text, self.values.iter().map(|column| column[row]));
        }
        text
    }

    /// Whether every value is a finite number.
    pub fn is_finite(&self) -> bool {
        self.values.iter().flatten().all(|x| x.is_finite())
    }

    /// Reads a file that this program has written.
    ///
    /// # Errors
    /// When it is not what it was.
    pub fn read(path: &Path) -> Result<Self, ReportError> {
        let text = std::fs::read_to_string(path).map_err(|cause| ReportError::Read { file: path.to_owned(), cause })?;
        Self::parse(&text).ok_or_else(|| ReportError::NoNumber { file: path.to_owned() })
    }

    /// The columns of a file's text; `None` where it holds what is no number.
    pub fn parse(text: &str) -> Option<Self> {
        let mut lines = text.lines();
        let names: Vec<&str> = lines.next()?.split(',').collect();
        let mut values = vec![Vec::new(); names.len()];
        for line in lines {
            let mut row = line.split(',');
            for column in &mut values {
                column.push(row.next()?.parse().ok()?);
            }
        }
        let names = names.into_iter().enumerate().map(|(i, n)| (n.to_owned(), i)).collect();
        Some(Self { names, values })
    }

    /// A column; nothing where there is none of that name.
    pub fn get(&self, name: &str) -> &[f64] {
        self.names.get(name).map_or(&[], |&i| &self.values[i])
    }

    /// The last rows of all columns.
    pub fn last(&self, rows: usize) -> Self {
        let tail = |all: &Vec<f64>| all[all.len().saturating_sub(rows)..].to_vec();
        Self { names: self.names.clone(), values: self.values.iter().map(tail).collect() }
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Rows.
    pub fn len(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// Names that begin so, in the order of the file.
    pub fn names_from(&self, beginning: &str) -> Vec<&str> {
        let mut found: Vec<(usize, &str)> =
            self.names.iter().filter(|(n, _)| n.starts_with(beginning)).map(|(n, &i)| (i, n.as_str())).collect();
        found.sort_unstable();
        found.into_iter().map(|(_, n)| n).collect()
    }

    /// Mean of a column; NaN where there is none of that name, or no row.
    pub fn mean(&self, name: &str) -> f64 {
        let all = self.get(name);
        all.iter().sum::<f64>() / all.len() as f64
    }

    /// Smallest and largest of a column.
    pub fn extent(&self, name: &str) -> [f64; 2] {
        self.get(name).iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| [low.min(x), high.max(x)])
    }

    /// Largest minus smallest.
    pub fn peak_to_peak(&self, name: &str) -> f64 {
        let [low, high] = self.extent(name);
        high - low
    }
}
