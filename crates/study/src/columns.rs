//! Named columns of equal length: the values of a history.

use std::collections::BTreeMap;

use crate::StudyError;

/// Named columns in order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Columns {
    places: BTreeMap<String, usize>,
    values: Vec<Vec<f64>>,
}

impl FromIterator<(String, Vec<f64>)> for Columns {
    /// Whole columns with their names.
    fn from_iter<I: IntoIterator<Item = (String, Vec<f64>)>>(all: I) -> Self {
        let (names, values): (Vec<String>, Vec<Vec<f64>>) = all.into_iter().unzip();
        Self { values, ..Self::named(names) }
    }
}

impl Columns {
    /// Columns without rows. If a name occurs twice, the last column is found.
    pub fn named<S: Into<String>>(names: impl IntoIterator<Item = S>) -> Self {
        let mut count = 0;
        let places = names.into_iter().map(Into::into).zip(0..).inspect(|_| count += 1).collect();
        let values = vec![Vec::new(); count];
        Self { places, values }
    }

    /// One more row, in the order of the names.
    pub fn push(&mut self, row: impl IntoIterator<Item = f64>) {
        self.values.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
    }

    /// Whether every value is a finite number.
    pub fn is_finite(&self) -> bool {
        self.values.iter().flatten().all(|x| x.is_finite())
    }

    /// The column with this name, if there is one.
    pub fn find(&self, name: &str) -> Option<&[f64]> {
        self.places.get(name).map(|&i| &*self.values[i])
    }

    /// The column with this name.
    ///
    /// # Errors
    /// [`StudyError::NoColumn`] if there is none.
    pub fn series(&self, name: &str) -> Result<&[f64], StudyError> {
        self.find(name).ok_or_else(|| StudyError::NoColumn { name: name.to_owned() })
    }

    /// Row by row, in the order of the names.
    pub fn rows(&self) -> impl Iterator<Item = impl Iterator<Item = f64> + '_> + '_ {
        (0..self.len()).map(|row| self.values.iter().map(move |column| column[row]))
    }

    /// The last `rows` rows of all columns.
    #[must_use]
    pub fn last(&self, rows: usize) -> Self {
        let tail = |all: &Vec<f64>| all[all.len().saturating_sub(rows)..].to_vec();
        Self { places: self.places.clone(), values: self.values.iter().map(tail).collect() }
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    /// All names, in order.
    pub fn names(&self) -> Vec<&str> {
        self.names_from("")
    }

    /// Names with this beginning, in order.
    pub fn names_from(&self, beginning: &str) -> Vec<&str> {
        let mut found: Vec<(usize, &str)> =
            self.places.iter().filter(|(n, _)| n.starts_with(beginning)).map(|(n, &i)| (i, n.as_str())).collect();
        found.sort_unstable();
        found.into_iter().map(|(_, n)| n).collect()
    }

    /// Arithmetic mean of a column; NaN without rows.
    ///
    /// # Errors
    /// [`StudyError::NoColumn`].
    pub fn mean(&self, name: &str) -> Result<f64, StudyError> {
        self.series(name).map(mean)
    }

    /// Smallest and largest value of a column; plus and minus infinity without rows.
    ///
    /// # Errors
    /// [`StudyError::NoColumn`].
    pub fn extent(&self, name: &str) -> Result<[f64; 2], StudyError> {
        self.series(name).map(extent)
    }
}

/// Arithmetic mean; NaN for an empty list.
pub fn mean(series: &[f64]) -> f64 {
    series.iter().sum::<f64>() / series.len() as f64
}

/// Smallest and largest value; plus and minus infinity for an empty list.
pub fn extent(series: &[f64]) -> [f64; 2] {
    series.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| [low.min(x), high.max(x)])
}

/// Largest minus smallest value; minus infinity for an empty list.
pub fn peak_to_peak(series: &[f64]) -> f64 {
    let [low, high] = extent(series);
    high - low
}

/// Root mean square about the mean; NaN for an empty list.
pub fn root_mean_square(series: &[f64]) -> f64 {
    let centre = mean(series);
    (series.iter().map(|x| (x - centre).powi(2)).sum::<f64>() / series.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A name that is none is an error with that name, never an empty series; what is there keeps its order.
    #[test]
    fn a_misspelt_column_is_an_error() {
        let mut columns = Columns::named(["time_s", "dte_um", "b"]);
        (0..4).for_each(|i| columns.push([f64::from(i), 2.0 * f64::from(i), 1.0]));
        assert_eq!(columns.mean("dte_um"), Ok(3.0));
        assert_eq!(columns.extent("dte_um").map(|[low, high]| high - low), Ok(peak_to_peak(&[0.0, 6.0])));
        assert_eq!(columns.mean("dte"), Err(StudyError::NoColumn { name: "dte".into() }));
        assert_eq!(columns.find("dte_um_"), None);
        assert_eq!(columns.names(), ["time_s", "dte_um", "b"]);
        let rows: Vec<Vec<f64>> = columns.last(2).rows().map(Iterator::collect).collect();
        assert_eq!(rows, [[2.0, 4.0, 1.0], [3.0, 6.0, 1.0]]);
    }
}
