//! From a file to a record, read once: nothing is believed that was not checked.

use std::{io::Read, sync::Arc};

use blake3::Hasher;
use faer::Mat;
use geometry::Side;

use super::{HEADER, MAGIC, RECORD_VERSION, RecordError, RecordKey, ReductionRecord};
use crate::{KeptTable, LayerProfile, LocalCompliance, ReducedGear, ReductionWay, TableKey, reducer::Summary};

/// Bytes that are read and hashed at a time: they stay in the cache of a processor until they are numbers.
const BLOCK: usize = 1 << 18;

impl ReductionRecord {
    /// The record in the bytes of a file, if it is that of `key`.
    ///
    /// # Errors
    /// [`RecordError`]: any changed, missing or added byte is noticed.
    pub fn from_bytes(bytes: &[u8], key: &RecordKey) -> Result<Self, RecordError> {
        Self::read(bytes, bytes.len(), key)
    }

    /// The record in a file of `length` bytes, if it is that of `key`.
    ///
    /// # Errors
    /// As [`ReductionRecord::from_bytes`]; [`RecordError::Unreadable`].
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
    fn few<const N: usize>(&mut self) -> Result<[u8; N], RecordError> {
        self.room(N, 1)?;
        let mut few = [0; N];
        for byte in &mut few {
            if self.next == self.block.len() {
                self.fill()?;
            }
            *byte = self.block[self.next];
            self.next += 1;
        }
        Ok(few)
    }

    /// The next numbers, as many as there is room for in `to`.
    fn numbers<const N: usize, T>(&mut self, to: &mut [T], number: impl Fn([u8; N]) -> T) -> Result<(), RecordError> {
        let mut done = 0;
        while done < to.len() {
            let (whole, _) = self.block[self.next..].as_chunks::<N>();
            let count = whole.len().min(to.len() - done);
            to[done..].iter_mut().zip(whole).for_each(|(to, bytes)| *to = number(*bytes));
            self.next += N * count;
            done += count;
            // One that begins in this block and ends in the next.
            if let Some(split) = to.get_mut(done) {
                *split = number(self.few()?);
                done += 1;
            }
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
        self.numbers(&mut list, u32::from_le_bytes)?;
        Ok(list)
    }

    fn values(&mut self, count: usize) -> Result<Vec<f64>, RecordError> {
        self.room(count, 8)?;
        let mut values = vec![0.0; count];
        self.numbers(&mut values, f64::from_le_bytes)?;
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
            self.numbers(matrix.col_as_slice_mut(j), f64::from_le_bytes)?;
        }
        Ok(matrix)
    }

    fn side(&mut self) -> Result<Side, RecordError> {
        Ok(if self.byte(1)? == 1 { Side::Right } else { Side::Left })
    }

    fn record(&mut self) -> Result<ReductionRecord, RecordError> {
        let way = if self.byte(1)? == 1 { ReductionWay::CyclicSector } else { ReductionWay::General };
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
