//! What a column of a file of rows is, and how files are made of them.

use std::{fmt::Debug, sync::Arc};

use answer::{RowColumn, RowStore, TableError, csv::push_row};
use serde::de::DeserializeOwned;
use study::Columns;

/// The gears as columns and files name them.
pub const GEARS: [&str; 2] = ["pinion", "wheel"];
/// What stands for a gear in a name.
const GEAR: &str = "<gear>";
/// What stands for the number of a tooth pair in a name.
const PAIR: &str = "<k>";

/// A kind of rows.
pub trait Rows: 'static {
    /// What all rows of a file share.
    type Layout: 'static;
    /// What one row is made of.
    type Record;

    /// The gears in the order of their coordinates.
    fn gear_order(_: &Self::Layout) -> [usize; 2] {
        [0, 1]
    }
}

/// Which gear and which tooth pair a column is of, where its name has `<gear>` or `<k>`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct At {
    /// 0 pinion, 1 wheel.
    pub gear: usize,
    /// Number of the pair within its mesh cycle.
    pub pair: i64,
}

/// A column of a file, or one for each gear, pair, or both.
pub struct Column<R: Rows> {
    /// Name with unit; `<gear>` and `<k>` stand for what the column is repeated over.
    pub name: &'static str,
    /// Unit as in a text; nothing for numbers without one.
    pub unit: &'static str,
    /// Meaning of the column, as in the table of `docs/outputs.md`.
    pub meaning: &'static str,
    /// Whether files of this layout have it.
    pub present: fn(&R::Layout, At) -> bool,
    /// Value of the column in a row.
    pub value: fn(&R::Layout, &R::Record, At) -> f64,
}

impl<R: Rows> Clone for Column<R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R: Rows> Copy for Column<R> {}

impl<R: Rows> Debug for Column<R> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} [{}]", self.name, self.unit)
    }
}

impl<R: Rows> Column<R> {
    /// Name of the column of one gear and pair.
    pub fn name_at(&self, at: At) -> String {
        self.name.replace(GEAR, GEARS[at.gear]).replace(PAIR, &at.pair.to_string())
    }
}

/// What a group of columns is repeated over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// Nothing: each column stands once.
    File,
    /// Pinion, then wheel.
    Gears,
    /// The gears in the order of their coordinates, [`Rows::gear_order`].
    GearsInOrder,
    /// Tooth pairs, ascending.
    Pairs,
    /// All pairs of the pinion, then all of the wheel.
    GearsAndPairs,
}

impl Over {
    fn places(self, order: [usize; 2], pairs: &[i64]) -> Vec<At> {
        let gears = 0..GEARS.len();
        match self {
            Self::File => vec![At::default()],
            Self::Gears => gears.map(|gear| At { gear, pair: 0 }).collect(),
            Self::GearsInOrder => order.iter().map(|&gear| At { gear, pair: 0 }).collect(),
            Self::Pairs => pairs.iter().map(|&pair| At { gear: 0, pair }).collect(),
            Self::GearsAndPairs => gears.flat_map(|gear| pairs.iter().map(move |&pair| At { gear, pair })).collect(),
        }
    }
}

/// Columns that are repeated together.
#[derive(Debug)]
pub struct Group<R: Rows> {
    /// Over what.
    pub over: Over,
    /// In the order of the file.
    pub columns: &'static [Column<R>],
}

/// All columns of a kind of rows, in the order of the file.
#[derive(Debug)]
pub struct Table<R: Rows> {
    /// Groups.
    pub groups: &'static [Group<R>],
}

impl<R: Rows> Table<R> {
    /// The columns of a file with this layout and these pairs.
    pub fn sheet(&self, layout: &R::Layout, pairs: &[i64]) -> Sheet<R> {
        let mut columns = Vec::new();
        for group in self.groups {
            for at in group.over.places(R::gear_order(layout), pairs) {
                columns.extend(group.columns.iter().filter(|c| (c.present)(layout, at)).map(|&c| (c, at)));
            }
        }
        Sheet { columns }
    }

    /// Every column once, as a line of the table in `docs/outputs.md`.
    pub fn documented(&self) -> Vec<String> {
        self.columns()
            .map(|c| format!("| `{}` | {} | {} |\n", c.name, c.unit, c.meaning).replace("|  |", "| |"))
            .collect()
    }

    /// Every column once.
    pub fn columns(&self) -> impl Iterator<Item = &'static Column<R>> {
        self.groups.iter().flat_map(|group| group.columns)
    }
}

/// The columns of one file.
#[derive(Debug)]
pub struct Sheet<R: Rows> {
    columns: Vec<(Column<R>, At)>,
}

impl<R: Rows> Sheet<R> {
    /// Names, in the order of the file.
    pub fn names(&self) -> Vec<String> {
        self.columns.iter().map(|(column, at)| column.name_at(*at)).collect()
    }

    /// The column of that name, and of which gear and pair it is.
    pub fn find(&self, name: &str) -> Option<(Column<R>, At)> {
        self.columns.iter().find(|(column, at)| column.name_at(*at) == name).copied()
    }

    /// The first line of the file.
    pub fn header(&self) -> String {
        self.names().join(",") + "\n"
    }

    /// The numbers of a row.
    pub fn row(&self, layout: &R::Layout, record: &R::Record) -> impl Iterator<Item = f64> {
        self.columns.iter().map(move |(column, at)| (column.value)(layout, record, *at))
    }

    /// All numbers by the names of their columns.
    ///
    /// # Errors
    /// [`TableError::Kept`] where rows cannot be read back.
    pub fn columns(&self, layout: &R::Layout, rows: &RowStore<R::Record>) -> Result<Columns, TableError>
    where
        R::Record: Clone + DeserializeOwned,
    {
        let mut columns = Columns::named(self.names());
        rows.for_each(0..rows.len(), |record| columns.push(self.row(layout, record)))?;
        Ok(columns)
    }

    /// The whole as a table of this name.
    pub fn table<'a>(
        &self,
        name: &'static str,
        layout: &R::Layout,
        records: impl IntoIterator<Item = &'a R::Record>,
    ) -> answer::Table {
        let mut values = vec![Vec::new(); self.columns.len()];
        for record in records {
            values.iter_mut().zip(self.row(layout, record)).for_each(|(column, value)| column.push(value));
        }
        let mut table = answer::Table::new(name);
        for ((column, at), values) in self.columns.iter().zip(values) {
            table.push_numbers(column.name_at(*at), column.meaning, values);
        }
        table
    }

    /// A table of this name that is read off rows of a motion; `record`: what of a row the columns are of.
    pub fn kept<T>(
        &self,
        name: &'static str,
        layout: &R::Layout,
        rows: &Arc<RowStore<T>>,
        record: fn(&T) -> &R::Record,
    ) -> answer::Table
    where
        T: Clone + DeserializeOwned + Send + Sync + 'static,
        R::Layout: Clone + Send + Sync,
    {
        let column = |&(column, at): &(Column<R>, At)| {
            let layout = layout.clone();
            let of = move |row: &T| (column.value)(&layout, record(row), at);
            RowColumn { name: column.name_at(at).into(), meaning: column.meaning.into(), of: Box::new(of) }
        };
        answer::Table::of_rows(name, rows, self.columns.iter().map(column).collect())
    }

    /// The whole file.
    pub fn csv<'a>(&self, layout: &R::Layout, records: impl IntoIterator<Item = &'a R::Record>) -> String {
        let mut csv = self.header();
        records.into_iter().for_each(|record| push_row(&mut csv, self.row(layout, record)));
        csv
    }
}

/// Columns of a kind, each a constant, and the list of them all: so a column is written once, and a misspelt one does
/// not compile.
///
/// `NAME = "name" [unit] "meaning", value;`, where `value` takes layout, record and [`At`]; `present` is for the
/// columns that do not say
/// `@ condition` themselves.
macro_rules! columns {
    ($kind:ty, $list:ident, $present:expr, {
        $($constant:ident = $name:literal [$unit:literal] $meaning:literal, $(@ $own:expr,)? $value:expr;)*
    }) => {
        $(
            #[doc = concat!("`", $name, "`: ", $meaning, ".")]
            pub const $constant: $crate::Column<$kind> = $crate::Column {
                name: $name,
                unit: $unit,
                meaning: $meaning,
                present: $crate::columns!(@present $present $(, $own)?),
                value: $value,
            };
        )*
        pub(crate) const $list: &[$crate::Column<$kind>] = &[$($constant),*];
    };
    (@present $all:expr) => { $all };
    (@present $all:expr, $own:expr) => { $own };
}
pub(crate) use columns;
