//! Reads a record from a file in one pass; every value is checked before it is used.

use std::{io::Read, sync::Arc};

use blake3::Hasher;
use faer::Mat;
use geometry::Side;
use pulp::bytemuck;

use super::{HEADER, MAGIC, RECORD_VERSION, RecordError, RecordKey, ReductionRecord};
use crate::{
    KeptTable, LayerProfile, LocalCompliance, ReducedGear, ReductionWay, TableKey, cyclic::ToothBlocks,
    reducer::Summary, window::Compliance,
};

/// Bytes that are read and hashed at a time: they stay in the cache of a processor until they are numbers.
const BLOCK: usize = 1 << 18;

impl ReductionRecord {
    /// Reads the record from the bytes of a file, if it is that of `key`.
    ///
    /// # Errors
    /// [`RecordError`]: any changed, missing or added byte is detected.
    pub fn from_bytes(bytes: &[u8], key: &RecordKey) -> Result<Self, RecordError> {
        Self::read(bytes, bytes.len(), key)
    }

    /// Reads the record from a file of `length` bytes, if it is that of `key`.
    ///
    /// # Errors
    /// Those of [`ReductionRecord::from_bytes`]; [`RecordError::Unreadable`].
    pub fn read(from: impl Read, length: usize, key: &RecordKey) -> Result<Self, RecordError> {
        opened(from, length, (MAGIC, key), Cursor::record)
    }
}

/// What `parse` finds in the payload of a file of `length` bytes, if it is of a kind and that of `key`.
pub(super) fn opened<R: Read, T>(
    mut from: R,
    length: usize,
    (magic, key): ([u8; 16], &RecordKey),
    parse: impl FnOnce(&mut Cursor<R>) -> Result<T, RecordError>,
) -> Result<T, RecordError> {
    let mut header = [0; HEADER];
    from.read_exact(&mut header[..HEADER.min(length)]).map_err(unreadable)?;
    if header[..16] != magic {
        return Err(RecordError::Foreign);
    }
    let found = length as u64;
    if length < HEADER {
        return Err(RecordError::WrongLength { found, wanted: HEADER as u64 });
    }
    let version = u32::from_le_bytes(part(&header, 16));
    if version != RECORD_VERSION {
        return Err(RecordError::OtherVersion { found: version });
    }
    let wanted = u64::from_le_bytes(part(&header, HEADER - 40)).saturating_add(HEADER as u64);
    if wanted != found {
        return Err(RecordError::WrongLength { found, wanted });
    }
    let mut hasher = Hasher::new();
    hasher.update(&header[..HEADER - 32]);
    let mut cursor = Cursor { from, hasher, block: Vec::new(), next: 0, unread: length - HEADER, length };
    let own = part::<32>(&header, 20) == key.0;
    let parsed = if own { parse(&mut cursor) } else { Err(RecordError::OtherGear) };
    // What is wrong in a damaged file says nothing: the checksum is heard first.
    let ended = cursor.left() == 0;
    let rest = cursor.wrong("bytes after the end");
    if cursor.checksum()? != part::<32>(&header, HEADER - 32) {
        return Err(RecordError::Damaged);
    }
    parsed.and_then(|parsed| if ended { Ok(parsed) } else { Err(rest) })
}

/// `N` bytes at a place inside the header.
fn part<const N: usize>(header: &[u8], at: usize) -> [u8; N] {
    std::array::from_fn(|i| header[at + i])
}

fn unreadable(e: std::io::Error) -> RecordError {
    RecordError::Unreadable { what: e.to_string() }
}

/// A place in the payload of a file.
pub(super) struct Cursor<R> {
    from: R,
    /// Of all that was read.
    hasher: Hasher,
    /// What was read last, and the first byte of it that is still to come.
    block: Vec<u8>,
    next: usize,
    /// Bytes of the file behind the block.
    unread: usize,
    length: usize,
}

impl<R: Read> Cursor<R> {
    /// Bytes still to come.
    fn left(&self) -> usize {
        self.block.len() - self.next + self.unread
    }

    pub(super) fn wrong(&self, what: &'static str) -> RecordError {
        RecordError::Inconsistent { at: self.length - self.left(), what }
    }

    /// Refuses more than there is.
    fn room(&self, count: usize, size: usize) -> Result<(), RecordError> {
        let fits = count.checked_mul(size).is_some_and(|bytes| bytes <= self.left());
        if fits { Ok(()) } else { Err(self.wrong("a list longer than the file")) }
    }

    /// Reads on, the block being done with.
    fn fill(&mut self) -> Result<(), RecordError> {
        let size = self.unread.min(BLOCK);
        self.block.resize(size, 0);
        self.from.read_exact(&mut self.block).map_err(unreadable)?;
        self.hasher.update(&self.block);
        (self.unread, self.next) = (self.unread - size, 0);
        Ok(())
    }

    /// Checksum of the whole file, the rest of which is read.
    fn checksum(mut self) -> Result<[u8; 32], RecordError> {
        while self.unread > 0 {
            self.fill()?;
        }
        Ok(*self.hasher.finalize().as_bytes())
    }

    /// The next few bytes.
    pub(super) fn few<const N: usize>(&mut self) -> Result<[u8; N], RecordError> {
        let mut few = [0; N];
        self.bytes(&mut few)?;
        Ok(few)
    }

    /// The next bytes, as many as there is room for in `to`: many of them straight from the file.
    fn bytes(&mut self, mut to: &mut [u8]) -> Result<(), RecordError> {
        self.room(to.len(), 1)?;
        while !to.is_empty() {
            let near = &self.block[self.next..];
            let count = near.len().min(to.len());
            let (own, rest) = to.split_at_mut(count);
            own.copy_from_slice(&near[..count]);
            self.next += count;
            to = rest;
            if to.len() >= BLOCK {
                let (own, rest) = to.split_at_mut(BLOCK);
                self.from.read_exact(own).map_err(unreadable)?;
                self.hasher.update(own);
                self.unread -= BLOCK;
                to = rest;
            } else if !to.is_empty() {
                self.fill()?;
            }
        }
        Ok(())
    }

    /// The next numbers, as many as there is room for in `to`.
    fn reals(&mut self, to: &mut [f64]) -> Result<(), RecordError> {
        self.bytes(bytemuck::cast_slice_mut(to))?;
        if cfg!(target_endian = "big") {
            to.iter_mut().for_each(|x| *x = f64::from_bits(x.to_bits().swap_bytes()));
        }
        Ok(())
    }

    fn byte(&mut self, most: u8) -> Result<u8, RecordError> {
        let [value] = self.few()?;
        if value > most { Err(self.wrong("a mark without meaning")) } else { Ok(value) }
    }

    pub(super) fn count(&mut self) -> Result<usize, RecordError> {
        Ok(u32::from_le_bytes(self.few()?) as usize)
    }

    pub(super) fn list(&mut self) -> Result<Vec<u32>, RecordError> {
        let count = self.count()?;
        self.room(count, 4)?;
        let mut list = vec![0; count];
        self.bytes(bytemuck::cast_slice_mut(&mut list))?;
        list.iter_mut().for_each(|value| *value = u32::from_le(*value));
        Ok(list)
    }

    pub(super) fn values(&mut self, count: usize) -> Result<Vec<f64>, RecordError> {
        self.room(count, 8)?;
        let mut values = vec![0.0; count];
        self.reals(&mut values)?;
        Ok(values)
    }

    /// A matrix that must have so many rows and columns.
    pub(super) fn matrix(&mut self, size: (usize, usize)) -> Result<Mat<f64>, RecordError> {
        let (rows, columns) = (self.count()?, self.count()?);
        if (rows, columns) != size {
            return Err(self.wrong("a matrix of another size than its nodes"));
        }
        self.room(rows.saturating_mul(columns), 8)?;
        let mut matrix = Mat::zeros(rows, columns);
        for j in 0..columns {
            self.reals(matrix.col_as_slice_mut(j))?;
        }
        Ok(matrix)
    }

    fn side(&mut self) -> Result<Side, RecordError> {
        Ok(if self.byte(1)? == 1 { Side::Right } else { Side::Left })
    }

    fn record(&mut self) -> Result<ReductionRecord, RecordError> {
        let way = match self.byte(2)? {
            0 => ReductionWay::General,
            1 => ReductionWay::CyclicSector,
            _ => ReductionWay::SectorAndBolts,
        };
        let cyclic = self.byte(1)? == 1;
        let free_count = u64::from_le_bytes(self.few()?) as usize;
        let summary = Summary { way, cyclic, free_count };
        let lowest_hz = Some(self.values(1)?[0]).filter(|hz| !hz.is_nan());
        // Counts of long things are not trusted with an allocation: each thing must be there first.
        let window = Arc::new(self.window()?);
        let mut halves = Vec::new();
        for _ in 0..self.count()? {
            let tooth = u32::from_le_bytes(self.few()?);
            let side = self.side()?;
            halves.push(((tooth, side), Arc::new(self.half()?)));
        }
        let mut tables = Vec::new();
        for _ in 0..self.count()? {
            let key = TableKey(self.few()?);
            let error = self.values(1)?[0];
            let count = self.count()?;
            tables.push((key, KeptTable { error, normal: Arc::new(self.values(count)?), others: None }));
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
        let compliance = if self.byte(1)? == 0 {
            Compliance::Whole(self.matrix((3 * nodes.len(), 3 * nodes.len()))?)
        } else {
            Compliance::Teeth(self.blocks(nodes.len())?)
        };
        Ok(ReducedGear::new(teeth, sides, nodes, compliance))
    }

    /// Compliance of so many nodes, tooth by tooth.
    fn blocks(&mut self, nodes: usize) -> Result<ToothBlocks, RecordError> {
        let count = self.count()?;
        let angles = self.values(count)?;
        let list = self.list()?;
        let (places, []) = list.as_chunks::<2>() else { return Err(self.wrong("half a place")) };
        let places = places.to_vec();
        let loads = places.iter().map(|place| 3 * (place[1] as usize + 1)).max().unwrap_or(0);
        let mut blocks = Vec::new();
        for _ in 0..count {
            blocks.push(self.matrix((loads, loads))?);
        }
        let blocks = ToothBlocks { blocks, places, angles };
        if blocks.fit(nodes) { Ok(blocks) } else { Err(self.wrong("teeth that do not fit together")) }
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
