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
