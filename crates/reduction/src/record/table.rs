//! File with the part of a table for directions other than the normal.

use super::{
    RecordError, RecordKey, TABLE,
    read::opened,
    write::{numbers, sealed},
};
use crate::TableKey;

/// The content of a file: header as for [`crate::ReductionRecord`], then key of the table, values.
pub fn table_bytes(table: &TableKey, values: &[f64], key: &RecordKey) -> Vec<u8> {
    sealed(TABLE, key, 8 * values.len() + 64, |bytes| {
        bytes.extend(table.0);
        numbers(bytes, values);
    })
}

/// Reads the values from a file of `length` bytes, if they belong to a table of the gear of `key`.
///
/// # Errors
/// [`RecordError`]: any changed, missing or added byte is detected.
pub fn read_table(
    table: &TableKey,
    from: impl std::io::Read,
    length: usize,
    key: &RecordKey,
) -> Result<Vec<f64>, RecordError> {
    opened(from, length, (TABLE, key), |cursor| {
        if cursor.few()? != table.0 {
            return Err(cursor.wrong("another table"));
        }
        let count = cursor.count()?;
        cursor.values(count)
    })
}
