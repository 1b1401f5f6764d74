//! A file of rows: names of columns, then numbers or words.

use std::{fs, io, path::Path};

/// Rows of a result.
#[derive(Debug, Clone)]
pub struct Csv {
    /// Names of the columns.
    pub names: Vec<String>,
    /// As they stand there.
    pub rows: Vec<Vec<String>>,
}

impl Csv {
    /// Reads a file without quotes.
    ///
    /// # Errors
    /// As the system says.
    pub fn read(path: &Path) -> io::Result<Self> {
        let text = fs::read_to_string(path)?;
        let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        let mut lines = text.lines();
        Ok(Self { names: lines.next().map(cells).unwrap_or_default(), rows: lines.map(cells).collect() })
    }

    /// Numbers of a column; words are no numbers. `None`: there is no such column.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let at = self.names.iter().position(|n| n == name)?;
        Some(self.rows.iter().map(|row| row.get(at).and_then(|c| c.parse().ok()).unwrap_or(f64::NAN)).collect())
    }

    /// Columns x, y, z of a vector, row by row.
    pub fn vectors(&self, of: &str, unit: &str) -> Option<Vec<[f64; 3]>> {
        let [x, y, z] = ["x", "y", "z"].map(|axis| self.column(&format!("{of}_{axis}_{unit}")));
        let (x, y, z) = (x?, y?, z?);
        Some((0..x.len()).map(|i| [x[i], y[i], z[i]]).collect())
    }
}

/// Largest size of finite numbers; 0 of none.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().filter(|v| v.is_finite()).fold(0.0, |m: f64, v| m.max(v.abs()))
}
