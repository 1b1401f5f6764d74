//! Rows of an answer, column by column.

use std::{borrow::Cow, collections::BTreeSet, ops::Range, sync::Arc};

use serde::de::DeserializeOwned;

use crate::{KeptColumn, RowColumn, RowStore, TableError, row_column::kept, unit_of};

/// Numbers or texts of a column, one a row.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers; NaN where a row has none.
    Numbers(Vec<f64>),
    /// Texts.
    Texts(Vec<String>),
    /// Numbers that are read off rows, which need not be in memory.
    Kept(KeptColumn),
}

/// Values of some rows of a column.
pub(crate) enum Part<'a> {
    /// Numbers.
    Numbers(Cow<'a, [f64]>),
    /// Texts.
    Texts(&'a [String]),
}

impl Part<'_> {
    /// Its own list, whose room may serve again.
    pub fn into_list(self) -> Option<Vec<f64>> {
        match self {
            Self::Numbers(Cow::Owned(list)) => Some(list),
            _ => None,
        }
    }
}

impl Values {
    /// Rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(list) => list.len(),
            Self::Texts(list) => list.len(),
            Self::Kept(column) => column.len(),
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
            Values::Numbers(_) | Values::Kept(_) => unit_of(&self.name),
            Values::Texts(_) => String::new(),
        }
    }

    /// Its numbers, where they are in memory; nothing of one of texts, or of one that is read off rows.
    pub fn numbers(&self) -> &[f64] {
        match &self.values {
            Values::Numbers(list) => list,
            Values::Texts(_) | Values::Kept(_) => &[],
        }
    }

    /// Whether it holds texts.
    pub fn is_of_texts(&self) -> bool {
        matches!(self.values, Values::Texts(_))
    }

    /// Name and meaning, without values.
    fn named(&self) -> Self {
        Self { name: self.name.clone(), meaning: self.meaning.clone(), values: Values::Numbers(Vec::new()) }
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
                    // None is read from a text.
                    Values::Kept(_) => {}
                }
            }
        }
        let columns = names.into_iter().zip(columns);
        let columns = columns.map(|(name, values)| Column { name: name.into(), meaning: "".into(), values }).collect();
        Ok(Self { columns, ..Self::new(name.to_owned()) })
    }

    /// A table that is read off rows.
    pub fn of_rows<T>(name: impl Into<Cow<'static, str>>, rows: &Arc<RowStore<T>>, columns: Vec<RowColumn<T>>) -> Self
    where
        T: Clone + DeserializeOwned + Send + Sync + 'static,
    {
        let column = |(name, meaning, column)| Column { name, meaning, values: Values::Kept(column) };
        Self { columns: kept(rows, columns).map(column).collect(), ..Self::new(name) }
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

    /// Numbers of the column of that name; `None` where there is none, where it holds texts, and where it is read off
    /// rows: [`Self::part`] takes those into memory.
    pub fn find(&self, name: &str) -> Option<&[f64]> {
        let column = self.columns.iter().find(|c| c.name == name)?;
        matches!(column.values, Values::Numbers(_)).then(|| column.numbers())
    }

    /// Names of all columns.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|c| &*c.name)
    }

    /// Some rows of the columns whose names are wanted, in memory.
    ///
    /// # Errors
    /// [`TableError::Kept`] where rows cannot be read back.
    pub fn part(&self, rows: Range<usize>, wanted: impl Fn(&str) -> bool) -> Result<Self, TableError> {
        let all = || self.columns.iter().filter(|column| wanted(&column.name));
        let values = parts(all(), rows, &mut Vec::new())?.into_iter().map(|part| match part {
            Part::Numbers(list) => Values::Numbers(list.into_owned()),
            Part::Texts(list) => Values::Texts(list.to_vec()),
        });
        let own = |(column, values): (&Column, Values)| Column { values, ..column.named() };
        let columns = all().zip(values).map(own).collect();
        Ok(Self { name: self.name.clone(), columns, is_written: self.is_written })
    }

    /// With all rows in memory.
    ///
    /// # Errors
    /// [`TableError::Kept`] where rows cannot be read back.
    pub fn in_memory(self) -> Result<Self, TableError> {
        if self.columns.iter().any(|column| matches!(column.values, Values::Kept(_))) {
            return self.part(0..self.rows(), |_| true);
        }
        Ok(self)
    }

    /// The values of some rows, column by column; `lists` has room that parts before have had.
    pub(crate) fn parts(&self, rows: Range<usize>, lists: &mut Vec<Vec<f64>>) -> Result<Vec<Part<'_>>, TableError> {
        parts(self.columns.iter(), rows, lists)
    }
}

/// The values of some rows; columns that are read off the same rows are so in one pass.
fn parts<'a>(
    columns: impl Iterator<Item = &'a Column>,
    rows: Range<usize>,
    lists: &mut Vec<Vec<f64>>,
) -> Result<Vec<Part<'a>>, TableError> {
    let columns: Vec<&Column> = columns.collect();
    let mut kept: Vec<Option<Vec<f64>>> = vec![None; columns.len()];
    for k in 0..columns.len() {
        let (Values::Kept(first), None) = (&columns[k].values, &kept[k]) else { continue };
        let with_it = |column: &Column| match &column.values {
            Values::Kept(own) => own.place_in(first),
            _ => None,
        };
        let places: Vec<(usize, usize)> =
            columns.iter().enumerate().filter_map(|(i, column)| Some((i, with_it(column)?))).collect();
        let mut read: Vec<Vec<f64>> = places.iter().map(|_| lists.pop().unwrap_or_default()).collect();
        for list in &mut read {
            list.clear();
            list.reserve(rows.len());
        }
        first.read(rows.clone(), &places.iter().map(|place| place.1).collect::<Vec<usize>>(), &mut read)?;
        places.iter().zip(read).for_each(|((i, _), values)| kept[*i] = Some(values));
    }
    let part = |(column, kept): (&&'a Column, Option<Vec<f64>>)| match &column.values {
        Values::Numbers(list) => Part::Numbers(Cow::Borrowed(&list[rows.clone()])),
        Values::Texts(list) => Part::Texts(&list[rows.clone()]),
        Values::Kept(_) => Part::Numbers(Cow::Owned(kept.unwrap_or_default())),
    };
    Ok(columns.iter().zip(kept).map(part).collect())
}
