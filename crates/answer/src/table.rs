//! Rows of an answer, column by column.

use std::borrow::Cow;

use crate::{csv, unit_of};

/// Numbers or texts of a column, one a row.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers; NaN where a row has none.
    Numbers(Vec<f64>),
    /// Texts.
    Texts(Vec<String>),
}

impl Values {
    /// Rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(list) => list.len(),
            Self::Texts(list) => list.len(),
        }
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A column: its name, which ends with the unit, what it means, and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name as files and programs know it.
    pub name: Cow<'static, str>,
    /// Meaning, as `docs/outputs.md` has it.
    pub meaning: Cow<'static, str>,
    /// Values.
    pub values: Values,
}

impl Column {
    /// Unit as in a text, `""` for a number without one ([`unit_of`] the name).
    pub fn unit(&self) -> String {
        match self.values {
            Values::Numbers(_) => unit_of(&self.name),
            Values::Texts(_) => String::new(),
        }
    }
}

/// Columns of the same length under a name; `NAME.csv` and `NAME.parquet` are its files.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Name of the files, without their ending.
    pub name: &'static str,
    /// Columns in the order of the files.
    pub columns: Vec<Column>,
    /// Whether its file with commas has been written row by row, as the rows came.
    pub is_written: bool,
}

impl Table {
    /// A table without columns.
    pub fn new(name: &'static str) -> Self {
        Self { name, columns: Vec::new(), is_written: false }
    }

    /// The same, its file with commas being there already.
    #[must_use]
    pub fn written(self) -> Self {
        Self { is_written: true, ..self }
    }

    /// With a column of numbers behind the others.
    #[must_use]
    pub fn numbers(
        mut self,
        name: impl Into<Cow<'static, str>>,
        meaning: impl Into<Cow<'static, str>>,
        values: impl IntoIterator<Item = f64>,
    ) -> Self {
        self.push_numbers(name, meaning, values);
        self
    }

    /// With a column of texts behind the others.
    #[must_use]
    pub fn texts<S: Into<String>>(
        mut self,
        name: impl Into<Cow<'static, str>>,
        meaning: impl Into<Cow<'static, str>>,
        values: impl IntoIterator<Item = S>,
    ) -> Self {
        let values = Values::Texts(values.into_iter().map(Into::into).collect());
        self.columns.push(Column { name: name.into(), meaning: meaning.into(), values });
        self
    }

    /// Puts a column of numbers behind the others.
    pub fn push_numbers(
        &mut self,
        name: impl Into<Cow<'static, str>>,
        meaning: impl Into<Cow<'static, str>>,
        values: impl IntoIterator<Item = f64>,
    ) {
        let values = Values::Numbers(values.into_iter().collect());
        self.columns.push(Column { name: name.into(), meaning: meaning.into(), values });
    }

    /// Rows: as many as every column has.
    pub fn rows(&self) -> usize {
        self.columns.iter().map(|c| c.values.len()).min().unwrap_or(0)
    }

    /// Numbers of the column of that name; `None` where there is none, or where it holds texts.
    pub fn find(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|c| c.name == name).and_then(|c| match &c.values {
            Values::Numbers(list) => Some(&list[..]),
            Values::Texts(_) => None,
        })
    }

    /// Names of all columns.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|c| &*c.name)
    }

    /// The file with commas: names first, then a line a row. Numbers have the shortest text that reads back to the same
    /// bits.
    pub fn csv(&self) -> String {
        let mut text = self.names().collect::<Vec<_>>().join(",") + "\n";
        for row in 0..self.rows() {
            for (k, column) in self.columns.iter().enumerate() {
                if k > 0 {
                    text.push(',');
                }
                match &column.values {
                    Values::Numbers(list) => csv::push_number(&mut text, list[row]),
                    Values::Texts(list) => text.push_str(&csv::quoted(&list[row])),
                }
            }
            text.push('\n');
        }
        text
    }
}
