//! Rows of a motion in constant memory.

use std::{
    borrow::Cow,
    fmt,
    fs::File,
    io::{self, Read, Seek, SeekFrom, Write},
    ops::Range,
    sync::{Mutex, PoisonError},
};

use serde::{Serialize, de::DeserializeOwned};

use crate::TableError;

/// Rows in memory at most.
const IN_MEMORY: usize = 16_384;
/// Rows of a block of the file: what is read at a time.
const BLOCK: usize = 2_048;

/// Rows of one kind in their order, as many as a disk holds. The last ones, 16,384 at most, are in memory; those before
/// them are in an unnamed temporary file (in the folder that `TMPDIR` names), which goes with the value. What is read is
/// what was put in, bit for bit.
pub struct RowStore<T> {
    file: Mutex<Option<File>>,
    /// The blocks of the file; every one has [`BLOCK`] rows.
    blocks: Vec<Block>,
    tail: Vec<T>,
}

/// A block of the file.
struct Block {
    /// Where it is.
    place: Range<u64>,
    /// Bytes of each row, where all rows have as many: a row in their middle is found without those before it.
    each: Option<u64>,
}

impl<T> Default for RowStore<T> {
    fn default() -> Self {
        Self { file: Mutex::new(None), blocks: Vec::new(), tail: Vec::new() }
    }
}

impl<T> fmt::Debug for RowStore<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RowStore").field("rows", &self.len()).finish_non_exhaustive()
    }
}

impl<T> RowStore<T> {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.in_file() + self.tail.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Rows in the file, the first ones.
    fn in_file(&self) -> usize {
        BLOCK * self.blocks.len()
    }

    /// The bytes of some rows of a block of the file; how many rows before the first of them are with them.
    fn bytes(&self, block: usize, rows: Range<usize>, to: &mut Vec<u8>) -> io::Result<usize> {
        let Block { place: Range { start, end }, each } = &self.blocks[block];
        let (place, before) = match each {
            Some(each) => (start + each * rows.start as u64..start + each * rows.end as u64, 0),
            None => (*start..*end, rows.start),
        };
        to.resize((place.end - place.start) as usize, 0);
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let file = file.as_mut().ok_or(io::ErrorKind::NotFound)?;
        file.seek(SeekFrom::Start(place.start))?;
        file.read_exact(to)?;
        Ok(before)
    }
}

impl<T: Serialize> RowStore<T> {
    /// Puts a row behind the others.
    ///
    /// # Errors
    /// [`TableError::Kept`] where the rows before it do not go into a file: the disk is full.
    pub fn push(&mut self, row: T) -> Result<(), TableError> {
        if self.tail.len() == IN_MEMORY {
            self.write_tail().map_err(TableError::kept)?;
        }
        self.tail.push(row);
        Ok(())
    }

    /// Of rows in their order.
    ///
    /// # Errors
    /// As [`Self::push`].
    pub fn of(rows: impl IntoIterator<Item = T>) -> Result<Self, TableError> {
        let mut all = Self::default();
        rows.into_iter().try_for_each(|row| all.push(row))?;
        Ok(all)
    }

    /// Puts all rows of the tail into the file.
    fn write_tail(&mut self) -> io::Result<()> {
        let file = self.file.get_mut().unwrap_or_else(PoisonError::into_inner);
        let file = match file {
            Some(file) => file,
            None => file.insert(tempfile::tempfile()?),
        };
        let mut start = self.blocks.last().map_or(0, |block| block.place.end);
        file.seek(SeekFrom::Start(start))?;
        let (mut bytes, mut blocks) = (Vec::new(), Vec::new());
        for rows in self.tail.chunks_exact(BLOCK) {
            bytes.clear();
            let (mut each, mut even) = (None, true);
            for row in rows {
                let before = bytes.len();
                bytes = postcard::to_extend(row, bytes).map_err(|e| io::Error::other(e.to_string()))?;
                let own = (bytes.len() - before) as u64;
                even &= *each.get_or_insert(own) == own;
            }
            file.write_all(&bytes)?;
            let end = start + bytes.len() as u64;
            blocks.push(Block { place: start..end, each: each.filter(|_| even) });
            start = end;
        }
        // All or none: rows of a file that could not be written are still in memory.
        self.blocks.append(&mut blocks);
        self.tail.clear();
        Ok(())
    }
}

impl<T: Clone + DeserializeOwned> RowStore<T> {
    /// The rows with these numbers, from 0 on, as far as there are such: one pass over the file. Each may be what keeps it
    /// from being read, and is the last then.
    pub fn iter(&self, rows: Range<usize>) -> impl Iterator<Item = Result<Cow<'_, T>, TableError>> {
        Reader { of: self, next: rows.start, end: rows.end.min(self.len()), bytes: Vec::new(), at: 0 }
    }

    /// The row with this number.
    ///
    /// # Errors
    /// [`TableError::Kept`] where the file cannot be read.
    pub fn get(&self, row: usize) -> Result<Option<Cow<'_, T>>, TableError> {
        self.iter(row..row.saturating_add(1)).next().transpose()
    }

    /// Numbers of some rows.
    ///
    /// # Errors
    /// [`TableError::Kept`] where the file cannot be read.
    pub fn series(&self, rows: Range<usize>, of: impl Fn(&T) -> f64) -> Result<Vec<f64>, TableError> {
        self.iter(rows).map(|row| Ok(of(&*row?))).collect()
    }

    /// Does something for each of these rows.
    ///
    /// # Errors
    /// [`TableError::Kept`] where the file cannot be read.
    pub fn for_each(&self, rows: Range<usize>, mut take: impl FnMut(&T)) -> Result<(), TableError> {
        self.iter(rows).try_for_each(|row| row.map(|row| take(&row)))
    }

    /// Some rows in memory.
    ///
    /// # Errors
    /// [`TableError::Kept`] where the file cannot be read.
    pub fn part(&self, rows: Range<usize>) -> Result<Vec<T>, TableError> {
        self.iter(rows).map(|row| row.map(Cow::into_owned)).collect()
    }

    /// All rows in memory.
    ///
    /// # Errors
    /// [`TableError::Kept`] where the file cannot be read.
    pub fn to_vec(&self) -> Result<Vec<T>, TableError> {
        self.part(0..self.len())
    }

    /// The same rows in a store of their own, which more can be put into.
    ///
    /// # Errors
    /// [`TableError::Kept`] where a file cannot be read or written.
    pub fn copied(&self) -> Result<Self, TableError>
    where
        T: Serialize,
    {
        let mut all = Self::default();
        self.iter(0..self.len()).try_for_each(|row| all.push(row?.into_owned()))?;
        Ok(all)
    }
}

/// Rows on their way out.
struct Reader<'a, T> {
    of: &'a RowStore<T>,
    next: usize,
    end: usize,
    /// Of the block that the next row is in, and where in it that begins.
    bytes: Vec<u8>,
    at: usize,
}

impl<'a, T: Clone + DeserializeOwned> Reader<'a, T> {
    fn read(&mut self) -> io::Result<T> {
        let within = self.next % BLOCK;
        if within == 0 || self.bytes.is_empty() {
            let (block, begin) = (self.next / BLOCK, self.next - within);
            let before = self.of.bytes(block, within..BLOCK.min(self.end - begin), &mut self.bytes)?;
            self.at = 0;
            for _ in 0..before {
                self.row()?;
            }
        }
        self.row()
    }

    fn row(&mut self) -> io::Result<T> {
        let (row, rest) =
            postcard::take_from_bytes(&self.bytes[self.at..]).map_err(|e| io::Error::other(e.to_string()))?;
        self.at = self.bytes.len() - rest.len();
        Ok(row)
    }
}

impl<'a, T: Clone + DeserializeOwned> Iterator for Reader<'a, T> {
    type Item = Result<Cow<'a, T>, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.next >= self.end {
            return None;
        }
        let row = match self.next.checked_sub(self.of.in_file()) {
            Some(place) => Ok(Cow::Borrowed(&self.of.tail[place])),
            None => self.read().map(Cow::Owned).map_err(TableError::kept),
        };
        self.next = if row.is_ok() { self.next + 1 } else { self.end };
        Some(row)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.end.saturating_sub(self.next);
        (0, Some(left))
    }
}
