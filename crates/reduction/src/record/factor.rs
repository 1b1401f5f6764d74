//! File with the factor of a sector.

use fem::KeptFactor;

use super::{
    FACTOR, RecordError, RecordKey,
    read::opened,
    write::{list, numbers, sealed},
};

/// The content of a file: header as for [`crate::ReductionRecord`], then rows in the order of elimination, number of
/// interior rows, columns of the supernodes, number of rows below each, these rows, values.
pub fn factor_bytes(factor: &KeptFactor, key: &RecordKey) -> Vec<u8> {
    let KeptFactor { order, interior, widths, rows, values } = factor;
    let below = rows.concat();
    let size = 8 * values.len() + 4 * (order.len() + 2 * rows.len() + below.len()) + 64;
    sealed(FACTOR, key, size, |bytes| {
        list(bytes, order);
        bytes.extend(interior.to_le_bytes());
        list(bytes, widths);
        list(bytes, &rows.iter().map(|rows| rows.len() as u32).collect::<Vec<_>>());
        list(bytes, &below);
        numbers(bytes, values);
    })
}

/// Reads the factor from a file of `length` bytes, if it belongs to the gear of `key`.
///
/// # Errors
/// [`RecordError`]: any changed, missing or added byte is detected.
pub fn read_factor(from: impl std::io::Read, length: usize, key: &RecordKey) -> Result<KeptFactor, RecordError> {
    opened(from, length, (FACTOR, key), |cursor| {
        let order = cursor.list()?;
        let interior = cursor.count()? as u32;
        let (widths, counts) = (cursor.list()?, cursor.list()?);
        let below = cursor.list()?;
        let mut left = &below[..];
        let mut rows = Vec::with_capacity(counts.len());
        for &count in &counts {
            let Some((own, rest)) = left.split_at_checked(count as usize) else {
                return Err(cursor.wrong("supernodes that do not fit together"));
            };
            rows.push(own.to_vec());
            left = rest;
        }
        let count = cursor.count()?;
        let values = cursor.values(count)?;
        Ok(KeptFactor { order, interior, widths, rows, values })
    })
}
