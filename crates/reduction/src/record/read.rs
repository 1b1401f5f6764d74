//! From bytes to a record: nothing is believed that was not checked.

use std::sync::Arc;

use faer::Mat;
use geometry::Side;

use super::{HEADER, MAGIC, RECORD_VERSION, RecordError, RecordKey, ReductionRecord, write::checksum};
use crate::{KeptTable, LayerProfile, LocalCompliance, ReducedGear, ReductionWay, TableKey, reducer::Summary};

impl ReductionRecord {
    /// The record in the bytes of a file, if it is that of `key`.
    ///
    /// # Errors
    /// [`RecordError`]: any changed, missing or added byte is noticed.
    pub fn from_bytes(bytes: &[u8], key: &RecordKey) -> Result<Self, RecordError> {
        let mut cursor = opened(bytes, MAGIC, key)?;
        let record = cursor.record()?;
        cursor.ended()?;
        Ok(record)
    }
}

/// The payload of a file of a kind, if it is that of `key`.
pub(super) fn opened<'a>(bytes: &'a [u8], magic: [u8; 16], key: &RecordKey) -> Result<Cursor<'a>, RecordError> {
    if bytes.get(..16) != Some(&magic[..]) {
        return Err(RecordError::Foreign);
    }
    let found = bytes.len() as u64;
    let header = bytes.get(..HEADER).ok_or(RecordError::WrongLength { found, wanted: HEADER as u64 })?;
    let version = u32::from_le_bytes(part(header, 16));
    if version != RECORD_VERSION {
        return Err(RecordError::OtherVersion { found: version });
    }
    let wanted = u64::from_le_bytes(part(header, HEADER - 40)).saturating_add(HEADER as u64);
    if wanted != found {
        return Err(RecordError::WrongLength { found, wanted });
    }
    if checksum(bytes) != part::<32>(header, HEADER - 32) {
        return Err(RecordError::Damaged);
    }
    if part::<32>(header, 20) != key.0 {
        return Err(RecordError::OtherGear);
    }
    Ok(Cursor { bytes, at: HEADER })
}

/// `N` bytes at a place inside the header.
fn part<const N: usize>(header: &[u8], at: usize) -> [u8; N] {
    std::array::from_fn(|i| header[at + i])
}

/// A place in a file.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    /// Refuses bytes after the end.
    pub(super) fn ended(&self) -> Result<(), RecordError> {
        if self.at == self.bytes.len() { Ok(()) } else { Err(self.wrong("bytes after the end")) }
    }

    pub(super) fn wrong(&self, what: &'static str) -> RecordError {
        RecordError::Inconsistent { at: self.at, what }
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], RecordError> {
        let end = self.at.checked_add(count).filter(|&end| end <= self.bytes.len());
        let end = end.ok_or_else(|| self.wrong("a list longer than the file"))?;
        let taken = &self.bytes[self.at..end];
        self.at = end;
        Ok(taken)
    }

    fn byte(&mut self, most: u8) -> Result<u8, RecordError> {
        let value = self.take(1)?[0];
        if value > most { Err(self.wrong("a mark without meaning")) } else { Ok(value) }
    }

    pub(super) fn count(&mut self) -> Result<usize, RecordError> {
        Ok(u32::from_le_bytes(part(self.take(4)?, 0)) as usize)
    }

    pub(super) fn list(&mut self) -> Result<Vec<u32>, RecordError> {
        let count = self.count()?;
        let bytes = self.take(4 * count)?;
        Ok(bytes.as_chunks().0.iter().map(|c| u32::from_le_bytes(*c)).collect())
    }

    fn values(&mut self, count: usize) -> Result<Vec<f64>, RecordError> {
        let size = count.checked_mul(8).ok_or_else(|| self.wrong("a list longer than the file"))?;
        let bytes = self.take(size)?;
        Ok(bytes.as_chunks().0.iter().map(|c| f64::from_le_bytes(*c)).collect())
    }

    /// A matrix that must have so many rows and columns.
    pub(super) fn matrix(&mut self, size: (usize, usize)) -> Result<Mat<f64>, RecordError> {
        let (rows, columns) = (self.count()?, self.count()?);
        if (rows, columns) != size {
            return Err(self.wrong("a matrix of another size than its nodes"));
        }
        let count = rows.checked_mul(columns).ok_or_else(|| self.wrong("a list longer than the file"))?;
        let size = count.checked_mul(8).ok_or_else(|| self.wrong("a list longer than the file"))?;
        let (values, _) = self.take(size)?.as_chunks();
        Ok(Mat::from_fn(rows, columns, |i, j| f64::from_le_bytes(values[j * rows + i])))
    }

    fn side(&mut self) -> Result<Side, RecordError> {
        Ok(if self.byte(1)? == 1 { Side::Right } else { Side::Left })
    }

    fn record(&mut self) -> Result<ReductionRecord, RecordError> {
        let way = if self.byte(1)? == 1 { ReductionWay::CyclicSector } else { ReductionWay::General };
        let cyclic = self.byte(1)? == 1;
        let free_count = u64::from_le_bytes(part(self.take(8)?, 0)) as usize;
        let summary = Summary { way, cyclic, free_count };
        let lowest_hz = Some(self.values(1)?[0]).filter(|hz| !hz.is_nan());
        // Counts of long things are not trusted with an allocation: each thing must be there first.
        let window = Arc::new(self.window()?);
        let mut halves = Vec::new();
        for _ in 0..self.count()? {
            let tooth = u32::from_le_bytes(part(self.take(4)?, 0));
            let side = self.side()?;
            halves.push(((tooth, side), Arc::new(self.half()?)));
        }
        let mut tables = Vec::new();
        for _ in 0..self.count()? {
            let key = TableKey(part(self.take(32)?, 0));
            let error = self.values(1)?[0];
            let count = self.count()?;
            tables.push((key, KeptTable { error, values: Arc::new(self.values(count)?) }));
        }
        Ok(ReductionRecord { summary, lowest_hz, window, halves, tables })
    }

    fn window(&mut self) -> Result<ReducedGear, RecordError> {
        let teeth = self.list()?;
        let mut sides = Vec::new();
        for _ in 0..self.count()? {
            sides.push(self.side()?);
        }
        let nodes = self.nodes()?;
        let compliance = self.matrix((3 * nodes.len(), 3 * nodes.len()))?;
        Ok(ReducedGear::new(teeth, sides, nodes, compliance))
    }

    /// Node numbers, which are looked up by bisection.
    fn nodes(&mut self) -> Result<Vec<u32>, RecordError> {
        let nodes = self.list()?;
        if nodes.is_sorted_by(|a, b| a < b) { Ok(nodes) } else { Err(self.wrong("nodes out of order")) }
    }

    fn half(&mut self) -> Result<LocalCompliance, RecordError> {
        let nodes = self.nodes()?;
        let compliance = self.matrix((3 * nodes.len(), 3 * nodes.len()))?;
        let overshoot = self.values(1)?[0];
        let mut lists = [Vec::new(), Vec::new(), Vec::new()];
        for list in &mut lists {
            let count = self.count()?;
            *list = self.values(count)?;
        }
        let values = self.values(4)?;
        let layer = LayerProfile::from_parts(lists, [values[0], values[1], values[2], values[3]]);
        let layer = layer.ok_or_else(|| self.wrong("a layer without stations"))?;
        Ok(LocalCompliance { nodes, compliance, overshoot, layer })
    }
}
