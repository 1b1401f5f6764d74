//! Rows of an answer, column by column.

use std::{borrow::Cow, collections::BTreeSet, convert::Infallible};

use crate::{TableError, csv, unit_of};

/// Bytes of text from which on a block of lines is handed out.
const BLOCK: usize = 1 << 16;

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
    pub name: Cow<'static, str>,
    /// Columns in the order of the files.
    pub columns: Vec<Column>,
    /// Whether its file with commas has been written row by row, as the rows came.
    pub is_written: bool,
}

impl Table {
    /// A table without columns.
    pub fn new(name: impl Into<Cow<'static, str>>) -> Self {
        Self { name: name.into(), columns: Vec::new(), is_written: false }
    }

    /// The table in the text of its file with commas, up to `most` columns; meanings are not in it. A column is one of
    /// numbers where every field of it is a number.
    ///
    /// # Errors
    /// [`TableError::Damaged`] where the text is no such file: rows of another length, too many columns, two of a name.
    pub fn read(name: &str, text: &str, most: usize) -> Result<Self, TableError> {
        let damaged = |what: String| TableError::Damaged { table: name.to_owned(), what };
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        let names: Vec<String> =
            reader.headers().map_err(|e| damaged(e.to_string()))?.iter().map(str::to_owned).collect();
        if names.len() > most {
            return Err(damaged(format!("{} columns, read are {most} at the most", names.len())));
        }
        let distinct: BTreeSet<&String> = names.iter().collect();
        if distinct.len() < names.len() {
            return Err(damaged("two columns of one name".to_owned()));
        }
        // First which columns are numbers, so that no number of a long file is kept as a text.
        let mut are_numbers = vec![true; names.len()];
        for record in reader.records() {
            let record = record.map_err(|e| damaged(e.to_string()))?;
            for (are, field) in are_numbers.iter_mut().zip(&record) {
                *are = *are && field.parse::<f64>().is_ok();
            }
        }
        let empty = |are: bool| if are { Values::Numbers(Vec::new()) } else { Values::Texts(Vec::new()) };
        let mut columns: Vec<Values> = are_numbers.into_iter().map(empty).collect();
        for record in ::csv::Reader::from_reader(text.as_bytes()).records() {
            let record = record.map_err(|e| damaged(e.to_string()))?;
            for (column, field) in columns.iter_mut().zip(&record) {
                match column {
                    Values::Numbers(list) => list.extend(field.parse::<f64>()),
                    Values::Texts(list) => list.push(field.to_owned()),
                }
            }
        }
        let columns = names.into_iter().zip(columns);
        let columns = columns.map(|(name, values)| Column { name: name.into(), meaning: "".into(), values }).collect();
        Ok(Self { columns, ..Self::new(name.to_owned()) })
    }

    /// A table whose file with commas is there already.
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
        let mut text = String::new();
        // Taking a text in memory cannot fail.
        let _ = self.csv_in_blocks(|block| {
            text.push_str(block);
            Ok::<_, Infallible>(())
        });
        text
    }

    /// The text of [`Self::csv`], some lines at a time.
    ///
    /// # Errors
    /// The first that `take` has; nothing is handed out after it.
    pub fn csv_in_blocks<E>(&self, mut take: impl FnMut(&str) -> Result<(), E>) -> Result<(), E> {
        let mut text = self.names().map(csv::quoted).collect::<Vec<_>>().join(",") + "\n";
        for row in 0..self.rows() {
            if text.len() >= BLOCK {
                take(&text)?;
                text.clear();
            }
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
        take(&text)
    }
}
