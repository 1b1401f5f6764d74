//! Columns of a table that are read off rows.

use std::{borrow::Cow, fmt, ops::Range, sync::Arc};

use serde::de::DeserializeOwned;

use crate::{RowStore, TableError};

/// Number of a row.
pub type OfRow<T> = Box<dyn Fn(&T) -> f64 + Send + Sync>;

/// A column that is read off rows: name and meaning as those of a column, and its number in a row.
pub struct RowColumn<T> {
    /// Name as files and programs know it.
    pub name: Cow<'static, str>,
    /// Meaning, as `docs/outputs.md` has it.
    pub meaning: Cow<'static, str>,
    /// Number of a row; NaN where it has none.
    pub of: OfRow<T>,
}

impl<T> fmt::Debug for RowColumn<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RowColumn").field("name", &self.name).finish_non_exhaustive()
    }
}

/// Rows, and what is read off them.
trait Source: Send + Sync {
    fn len(&self) -> usize;

    /// Columns of some rows, in one pass, each into a list.
    fn read(&self, rows: Range<usize>, columns: &[usize], to: &mut [Vec<f64>]) -> Result<(), TableError>;
}

struct Rows<T> {
    rows: Arc<RowStore<T>>,
    columns: Vec<OfRow<T>>,
}

impl<T: Clone + DeserializeOwned + Send + Sync> Source for Rows<T> {
    fn len(&self) -> usize {
        self.rows.len()
    }

    fn read(&self, rows: Range<usize>, columns: &[usize], to: &mut [Vec<f64>]) -> Result<(), TableError> {
        self.rows.for_each(rows, |row| {
            to.iter_mut().zip(columns).for_each(|(list, &column)| list.push((self.columns[column])(row)));
        })
    }
}

/// Numbers of a column of rows.
#[derive(Clone)]
pub struct KeptColumn {
    source: Arc<dyn Source>,
    place: usize,
}

impl fmt::Debug for KeptColumn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("KeptColumn").field("rows", &self.len()).field("place", &self.place).finish()
    }
}

impl PartialEq for KeptColumn {
    fn eq(&self, other: &Self) -> bool {
        other.place_in(self) == Some(self.place)
    }
}

impl KeptColumn {
    /// Rows.
    pub(crate) fn len(&self) -> usize {
        self.source.len()
    }

    /// Its place among the columns of the rows that another is read off; `None` where those are others.
    pub(crate) fn place_in(&self, other: &Self) -> Option<usize> {
        Arc::ptr_eq(&self.source, &other.source).then_some(self.place)
    }

    /// Columns of its rows, by their places, each into an empty list.
    pub(crate) fn read(&self, rows: Range<usize>, places: &[usize], to: &mut [Vec<f64>]) -> Result<(), TableError> {
        self.source.read(rows, places, to)
    }
}

/// Columns of rows: name, meaning, numbers.
pub(crate) fn kept<T>(
    rows: &Arc<RowStore<T>>,
    columns: Vec<RowColumn<T>>,
) -> impl Iterator<Item = (Cow<'static, str>, Cow<'static, str>, KeptColumn)>
where
    T: Clone + DeserializeOwned + Send + Sync + 'static,
{
    let (names, columns): (Vec<_>, Vec<_>) = columns.into_iter().map(|c| ((c.name, c.meaning), c.of)).unzip();
    let source: Arc<dyn Source> = Arc::new(Rows { rows: Arc::clone(rows), columns });
    names
        .into_iter()
        .enumerate()
        .map(move |(place, (name, meaning))| (name, meaning, KeptColumn { source: Arc::clone(&source), place }))
}
