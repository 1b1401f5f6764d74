//! Entries of a table for all pairs of points.

use std::{
    ops::Range,
    sync::{
        Arc, OnceLock,
        atomic::{AtomicU32, Ordering},
    },
};

use reduction::TablePart;

use super::{
    BulkBody, DIRECTIONS, RUN, RUNS, filled,
    triangles::{packed, unpacked},
};
use crate::nodal::Support;

/// T, mm/N, by blocks of directions, each column by column.
#[derive(Debug, Clone)]
pub(super) struct WholeEntries {
    /// Points along one direction.
    pub(super) count: usize,
    /// Openings along the normal by loads along it: all that contact without friction and micro-geometry reads but at
    /// edges.
    normal: Arc<Vec<f64>>,
    others: Arc<Others>,
}

/// The other blocks.
#[derive(Debug)]
struct Others {
    /// All blocks in order, the first one need not be filled.
    blocks: OnceLock<Vec<f64>>,
    /// Where they come from.
    from: Option<Source>,
    /// Lower triangles of the other blocks, and how often a tile of them was read.
    packed: OnceLock<Arc<Vec<f64>>>,
    read: AtomicU32,
}

/// Tiles that are picked out of the lower triangles before these are laid out.
const FEW: u32 = 20_000;

/// Where the other blocks of a table that was kept come from when they are first read.
#[derive(Debug)]
pub(super) struct Source {
    pub part: TablePart,
    /// What they are made of where they are not kept.
    pub body: Arc<BulkBody>,
    pub supports: Vec<Option<[Support; DIRECTIONS]>>,
}

/// A block of a table, or what tells its tiles.
pub(super) enum Block<'a> {
    /// Column by column.
    Whole(&'a [f64]),
    /// Lower triangles of all blocks but the first.
    Packed(&'a [f64]),
}

impl WholeEntries {
    /// Entries of a table that was filled.
    pub(super) fn new(table: Vec<f64>, count: usize) -> Self {
        let normal = Arc::new(table[..count * count].to_vec());
        let (packed, read) = Default::default();
        Self { count, normal, others: Arc::new(Others { blocks: OnceLock::from(table), from: None, packed, read }) }
    }

    /// Entries of which the first block is at hand.
    pub(super) fn kept(normal: Vec<f64>, from: Source) -> Self {
        let count = from.supports.len();
        let (blocks, packed, read) = Default::default();
        Self { count, normal: Arc::new(normal), others: Arc::new(Others { blocks, from: Some(from), packed, read }) }
    }

    /// All blocks, of a table that was filled.
    pub(super) fn table(&self) -> &[f64] {
        self.others.blocks.get().map(Vec::as_slice).unwrap_or_default()
    }

    /// Openings along direction e by loads along direction d.
    #[inline(always)]
    pub(super) fn block(&self, [d, e]: [usize; 2]) -> Block<'_> {
        if d + e == 0 { Block::Whole(&self.normal) } else { self.other([d, e]) }
    }

    fn other(&self, [d, e]: [usize; 2]) -> Block<'_> {
        let (size, others) = (self.count * self.count, &*self.others);
        let of = |blocks| {
            let blocks: &Vec<f64> = blocks;
            let block = DIRECTIONS * d + e;
            Block::Whole(blocks.get(block * size..(block + 1) * size).unwrap_or_default())
        };
        if let Some(blocks) = others.blocks.get() {
            return of(blocks);
        }
        let packed = others.packed.get_or_init(|| others.from.as_ref().map(Source::packed).unwrap_or_default());
        if others.read.fetch_add(1, Ordering::Relaxed) < FEW {
            return Block::Packed(packed);
        }
        of(others.blocks.get_or_init(|| unpacked(packed, self.count, OTHERS).unwrap_or_default()))
    }

    /// T between points q and p, by a load along d and opening along e.
    pub(super) fn at(&self, along: [usize; 2], q: usize, p: usize) -> f64 {
        match self.block(along) {
            Block::Whole(block) => block[q * self.count + p],
            Block::Packed(packed) => packed[place(self.count, along, q, p)],
        }
    }

    /// The entries between the points of two cells, out of the lower triangles.
    pub(super) fn tile(&self, packed: &[f64], along: [usize; 2], [loads, openings]: [[u32; RUNS]; 2]) -> TilePoints {
        let mut all = [[0.0; RUNS * RUN]; RUNS * RUN];
        for (a, column) in all.iter_mut().enumerate() {
            let q = loads[a / RUN] as usize + a % RUN;
            for (run, first) in column.as_chunks_mut::<RUN>().0.iter_mut().zip(openings) {
                let p = first as usize;
                // Below the diagonal the run is there as it is.
                let below = if p > q { packed.get(place(self.count, along, q, p)..) } else { None };
                match below.and_then(|below| below.first_chunk::<RUN>()) {
                    Some(below) => *run = *below,
                    None => {
                        for (k, entry) in run.iter_mut().enumerate() {
                            *entry = packed[place(self.count, along, q, p + k)];
                        }
                    }
                }
            }
        }
        all
    }
}

/// T between the points of two cells, column by column.
pub(super) type TilePoints = [[f64; RUNS * RUN]; RUNS * RUN];

/// Blocks that are kept apart.
const OTHERS: Range<usize> = 1..DIRECTIONS * DIRECTIONS;

/// Place among the lower triangles of the other blocks of an entry: of those above the diagonal the one that
/// [`mirror`](super::mirror) puts there.
fn place(count: usize, [d, e]: [usize; 2], q: usize, p: usize) -> usize {
    let swapped = p < q || p == q && e < d;
    let (block, q, p) = if swapped { (DIRECTIONS * e + d, p, q) } else { (DIRECTIONS * d + e, q, p) };
    let of_block = count * (count + 1) / 2;
    (block - 1) * of_block + q * count - q * q.saturating_sub(1) / 2 + p - q
}

impl Source {
    /// Lower triangles of the other blocks.
    fn packed(&self) -> Arc<Vec<f64>> {
        let count = self.supports.len();
        let size = OTHERS.len() * count * (count + 1) / 2;
        if let Some(kept) = self.part.load().filter(|kept| kept.len() == size) {
            return kept;
        }
        let made = packed(&filled(&self.body.with(&[]), &self.supports), count, OTHERS);
        self.part.save(&made);
        Arc::new(made)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The places of all entries are those of the blocks that are laid out.
    #[test]
    fn lower_triangles_tell_all() {
        let count = 5;
        let size = OTHERS.len() * count * (count + 1) / 2;
        let values: Vec<f64> = (0..size).map(|i| i as f64).collect();
        let blocks = unpacked(&values, count, OTHERS).unwrap();
        for block in OTHERS {
            for (q, p) in (0..count).flat_map(|q| (0..count).map(move |p| (q, p))) {
                let along = [block / DIRECTIONS, block % DIRECTIONS];
                assert_eq!(
                    values[place(count, along, q, p)],
                    blocks[(block * count + q) * count + p],
                    "{along:?} {q} {p}"
                );
            }
        }
        assert_eq!(packed(&blocks, count, OTHERS).len(), size);
    }
}
