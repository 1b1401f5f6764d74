//! The files of a table, from one pass over its rows.

use std::io::Write;

use crate::{
    Table, TableError,
    columnar::{GROUP, ParquetFile},
    csv,
    table::Part,
};

/// Bytes of text from which on a block of lines is handed out.
const BLOCK: usize = 1 << 16;
/// Rows that are looked at together where only text is made of them.
const ROWS: usize = 2_048;

/// Takes a block of whole lines of a file with commas.
pub type TakeLines<'a, E> = &'a mut (dyn FnMut(&str) -> Result<(), E> + Send);

/// Hands out the file with commas of a table, some lines at a time, and writes its Parquet file, each where it is wanted:
/// the rows are read once for both, and both are made side by side.
///
/// # Errors
/// The first that `lines` has, nothing is handed out after it; [`TableError::Parquet`] when a name is none that the format
/// takes, [`TableError::Write`] when the system refuses; [`TableError::Kept`] where rows cannot be read back.
pub fn write_table<E: From<TableError> + Send>(
    table: &Table,
    lines: Option<TakeLines<'_, E>>,
    parquet: Option<&mut (dyn Write + Send)>,
) -> Result<(), E> {
    let mut lines = lines.map(|take| Lines::new(table, take));
    let mut columns = parquet.map(|to| ParquetFile::new(table, to)).transpose()?;
    let at_once = if columns.is_some() { GROUP } else { ROWS };
    let (rows, mut lists) = (table.rows(), Vec::new());
    for first in (0..rows).step_by(at_once) {
        let block = first..rows.min(first + at_once);
        let parts = table.parts(block.clone(), &mut lists)?;
        let mut text = || lines.as_mut().map_or(Ok(()), |own| own.add(&parts, block.len()));
        let (text, written) = match &mut columns {
            Some(own) => rayon::join(text, || own.add(&parts)),
            None => (text(), Ok(())),
        };
        text?;
        written?;
        lists.extend(parts.into_iter().filter_map(Part::into_list));
    }
    if let Some(own) = columns {
        own.end()?;
    }
    lines.map_or(Ok(()), |own| (own.take)(&own.text))
}

/// Writes the Parquet file of a table, in groups of 65,536 rows, Snappy: one group at a time is in memory.
///
/// # Errors
/// [`TableError::Parquet`] when a name is none that the format takes, [`TableError::Write`] when the system refuses; [`TableError::Kept`] where
/// rows cannot be read back.
pub fn write_parquet(table: &Table, mut to: impl Write + Send) -> Result<(), TableError> {
    write_table(table, None, Some(&mut to))
}

impl Table {
    /// The file with commas: names first, then a line a row. Numbers have the shortest text that reads back to the same
    /// bits.
    ///
    /// # Errors
    /// [`TableError::Kept`] where rows cannot be read back.
    pub fn csv(&self) -> Result<String, TableError> {
        let mut text = String::new();
        self.csv_in_blocks(|block| {
            text.push_str(block);
            Ok::<_, TableError>(())
        })?;
        Ok(text)
    }

    /// The text of [`Self::csv`], some lines at a time.
    ///
    /// # Errors
    /// The first that `take` has, nothing is handed out after it; [`TableError::Kept`] where rows cannot be read back.
    pub fn csv_in_blocks<E: From<TableError> + Send>(
        &self,
        mut take: impl FnMut(&str) -> Result<(), E> + Send,
    ) -> Result<(), E> {
        write_table(self, Some(&mut take), None)
    }
}

/// Lines of a file with commas: names first, then a line a row.
struct Lines<'a, E> {
    text: String,
    take: TakeLines<'a, E>,
}

impl<'a, E> Lines<'a, E> {
    fn new(table: &Table, take: TakeLines<'a, E>) -> Self {
        Self { text: table.names().map(csv::quoted).collect::<Vec<_>>().join(",") + "\n", take }
    }

    fn add(&mut self, parts: &[Part<'_>], rows: usize) -> Result<(), E> {
        let Self { text, take } = self;
        for row in 0..rows {
            if text.len() >= BLOCK {
                take(text)?;
                text.clear();
            }
            for (k, part) in parts.iter().enumerate() {
                if k > 0 {
                    text.push(',');
                }
                match part {
                    Part::Numbers(list) => csv::push_number(text, list[row]),
                    Part::Texts(list) => text.push_str(&csv::quoted(&list[row])),
                }
            }
            text.push('\n');
        }
        Ok(())
    }
}
