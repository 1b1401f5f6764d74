//! Compliance between rows, read from a table at their positions.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::{
    BulkTable, DIRECTIONS, Entries, RUN, RUNS, TablePoint,
    whole::{Block, TilePoints},
};
use crate::lanes::{self, Four};

/// Loads that a tile of the table is multiplied with in one pass over it.
pub(super) const AT_ONCE: usize = 4;

impl BulkTable {
    /// Adds S between rows to `out` (n x n, column by column): opening of row i by a unit load of row j. `symmetric`:
    /// loads are the openings, and the lower triangle is enough.
    pub(crate) fn add(
        &self,
        openings: &[TablePoint],
        loads: &[TablePoint],
        symmetric: bool,
        work: &mut TableWork,
        out: &mut [f64],
    ) {
        let TableWork { groups: [of_openings, of_loads], arch } = work;
        group(openings, of_openings);
        of_loads.clear();
        let loads = if symmetric { openings } else { loads };
        if !symmetric {
            group(loads, of_loads);
        }
        let groups = [&of_openings[..], if symmetric { of_openings } else { of_loads }];
        let (count, entries) = (self.points() / DIRECTIONS, &self.entries);
        lanes::run(*arch, Interpolation { entries, count, places: [openings, loads], groups, symmetric, out });
    }
}

/// Rows that follow each other in one cell of the table, loaded along the same directions: neighbours on a contact line
/// mostly do and are.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Group {
    pub(super) rows: Range<usize>,
    pub(super) runs: [u32; RUNS],
    pub(super) along: [bool; DIRECTIONS],
}

pub(super) fn group(places: &[TablePoint], out: &mut Vec<Group>) {
    out.clear();
    for (i, place) in places.iter().enumerate() {
        let along = place.parts.map(|part| part != 0.0);
        match out.last_mut().filter(|group| group.runs == place.runs && group.along == along) {
            Some(group) => group.rows.end = i + 1,
            None => out.push(Group { rows: i..i + 1, runs: place.runs, along }),
        }
    }
}

/// S = W T W' from the tiles of the table that groups of rows stand on, read where they are.
struct Interpolation<'a> {
    entries: &'a Entries,
    /// Points along one direction.
    count: usize,
    /// Openings and loads.
    places: [&'a [TablePoint]; 2],
    groups: [&'a [Group]; 2],
    symmetric: bool,
    out: &'a mut [f64],
}

impl WithSimd for Interpolation<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { entries, count, places, groups: [of_openings, of_loads], symmetric, out } = self;
        let n = places[0].len();
        let mut own = [TilePoints::default(); DIRECTIONS];
        for (number, group) in of_loads.iter().enumerate() {
            let first = if symmetric { number } else { 0 };
            for opened in &of_openings[first..] {
                // Each load costs a pass over the tile: where S is symmetric, the smaller group is the load.
                let swapped = symmetric && opened.rows.len() < group.rows.len();
                let (load, opening) = if swapped { (opened, group) } else { (group, opened) };
                // Of the lower triangle, whichever is the load.
                let strides = if swapped { [1, n] } else { [n, 1] };
                let (loads, rows) = (&places[1][load.rows.clone()], &places[0][opening.rows.clone()]);
                for e in (0..DIRECTIONS).filter(|e| opening.along[*e]) {
                    let [first, second, third] = &mut own;
                    let tile = |d: usize, own| {
                        load.along[d].then(|| Tile::between(entries, count, [d, e], [load.runs, opening.runs], own))
                    };
                    let tiles = Tiles { of_loads: [tile(0, first), tile(1, second), tile(2, third)], along: e };
                    let mut start = load.rows.start * strides[0] + opening.rows.start * strides[1];
                    for part in loads.chunks(AT_ONCE) {
                        let out = &mut out[start..];
                        match part {
                            [_, _, _, _] => tiles.add::<S, 4>(simd, (part, rows), (out, strides)),
                            [_, _, _] => tiles.add::<S, 3>(simd, (part, rows), (out, strides)),
                            [_, _] => tiles.add::<S, 2>(simd, (part, rows), (out, strides)),
                            _ => tiles.add::<S, 1>(simd, (part, rows), (out, strides)),
                        }
                        start += AT_ONCE * strides[0];
                    }
                }
            }
        }
    }
}

/// What the loads of one group do at the points of another along one direction.
struct Tiles<'a> {
    /// Of what the loads are along each direction.
    of_loads: [Option<Tile<'a>>; DIRECTIONS],
    along: usize,
}

impl Tiles<'_> {
    /// Adds what `K` loads open `rows` by to entries of `out`, which are `strides` apart: from load to load and from row
    /// to row.
    ///
    /// What all directions of a load do is summed at the points, before rows look at it.
    #[inline(always)]
    fn add<S: Simd, const K: usize>(
        &self,
        simd: S,
        (loads, rows): (&[TablePoint], &[TablePoint]),
        (out, strides): (&mut [f64], [usize; 2]),
    ) {
        let Some(loads) = loads.first_chunk::<K>() else { return };
        let mut at_points = [[Four::splat(simd, 0.0); K]; RUNS];
        for (d, tile) in self.of_loads.iter().enumerate() {
            let Some(tile) = tile else { continue };
            let opened = tile.opened(simd, loads);
            for k in 0..K {
                let part = Four::splat(simd, loads[k].parts[d]);
                for (sum, opened) in at_points.iter_mut().zip(&opened) {
                    sum[k] = part.mul_add(opened[k], sum[k]);
                }
            }
        }
        let [first, second, third] = at_points;
        for k in 0..K {
            for (row, entry) in rows.iter().zip(out[k * strides[0]..].iter_mut().step_by(strides[1])) {
                let [a, b, c] = row.weights.each_ref().map(|weights| Four::new(simd, weights));
                let sum = a.mul_add(first[k], b.mul_add(second[k], c * third[k])).sum();
                *entry += row.parts[self.along] * sum;
            }
        }
    }
}

/// What the loads of one group do at the points of another, along one direction each.
pub(super) struct Tile<'a> {
    /// Columns of the table at the runs of the loads, four each.
    columns: [&'a [f64]; RUNS],
    count: usize,
    /// Runs of the openings.
    runs: [usize; RUNS],
}

impl<'a> Tile<'a> {
    /// The tile of loads in a cell along one direction and openings in another along the second one; `own`: room for one
    /// that is put together.
    #[inline(always)]
    pub(super) fn between(
        entries: &'a Entries,
        count: usize,
        along: [usize; 2],
        [load, opening]: [[u32; RUNS]; 2],
        own: &'a mut TilePoints,
    ) -> Self {
        match entries {
            Entries::Whole(table) => match table.block(along) {
                Block::Whole(block) => {
                    let columns = load.map(|first| &block[first as usize * count..][..RUN * count]);
                    return Self { columns, count, runs: opening.map(|first| first as usize) };
                }
                Block::Packed(packed) => *own = table.tile(packed, along, [load, opening]),
            },
            Entries::Layers(layers) => {
                let point = |b: usize, first: u32| along[b] * count + first as usize;
                *own = layers.tile(load.map(|p| point(0, p)), opening.map(|p| point(1, p)));
            }
        }
        Self::of(own)
    }

    /// A tile that stands by itself.
    fn of(points: &'a TilePoints) -> Self {
        let columns = [0, 1, 2].map(|c| points[RUN * c..RUN * (c + 1)].as_flattened());
        Self { columns, count: RUNS * RUN, runs: [0, RUN, 2 * RUN] }
    }

    /// What `K` loads of unit parts open the points of the three runs by.
    #[inline(always)]
    pub(super) fn opened<S: Simd, const K: usize>(&self, simd: S, loads: &[TablePoint; K]) -> [[Four<S>; K]; RUNS] {
        let [p0, p1, p2] = self.runs;
        let zero = Four::splat(simd, 0.0);
        // All of these stay in registers: four columns at once are as many as there is room for.
        let (mut first, mut second, mut third) = ([zero; K], [zero; K], [zero; K]);
        for c in 0..RUNS {
            for (a, column) in self.columns[c].chunks_exact(self.count).enumerate().take(RUN) {
                let (x0, x1, x2) = (run(simd, column, p0), run(simd, column, p1), run(simd, column, p2));
                for k in 0..K {
                    let weight = Four::splat(simd, loads[k].weights[c][a]);
                    first[k] = x0.mul_add(weight, first[k]);
                    second[k] = x1.mul_add(weight, second[k]);
                    third[k] = x2.mul_add(weight, third[k]);
                }
            }
        }
        [first, second, third]
    }
}

/// Four points of a column that follow each other.
#[inline(always)]
fn run<S: Simd>(simd: S, column: &[f64], first: usize) -> Four<S> {
    Four::new(simd, column[first..].first_chunk::<RUN>().unwrap_or(&[0.0; RUN]))
}

/// Reusable memory for values read from a table.
#[derive(Debug, Default)]
pub struct TableWork {
    /// Groups of openings, and of loads where these are others.
    groups: [Vec<Group>; 2],
    arch: pulp::Arch,
}

impl TableWork {
    /// Memory for `rows` rows.
    pub(crate) fn new(rows: usize) -> Self {
        let groups = || Vec::with_capacity(rows);
        Self { groups: [groups(), groups()], arch: pulp::Arch::new() }
    }

    /// Points of the table that the rows of the last call touched.
    pub(crate) fn touched(&self) -> usize {
        let points =
            self.groups.iter().flatten().flat_map(|group| group.runs).flat_map(|first| first..first + RUN as u32);
        points.collect::<std::collections::BTreeSet<u32>>().len()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::compliance::bulk_table::whole::WholeEntries;

    /// Points of a direction.
    const COUNT: usize = 40;

    /// A table that no gear has, symmetric as one of a gear is.
    pub(in super::super) fn table() -> BulkTable {
        let at = |i: usize, j: usize| (1.0 + ((i * j) as f64).sin()) / (1.0 + i.abs_diff(j) as f64);
        let mut table = vec![0.0; (DIRECTIONS * COUNT).pow(2)];
        for (d, e) in (0..DIRECTIONS).flat_map(|d| (0..DIRECTIONS).map(move |e| (d, e))) {
            for (q, p) in (0..COUNT).flat_map(|q| (0..COUNT).map(move |p| (q, p))) {
                table[((DIRECTIONS * d + e) * COUNT + q) * COUNT + p] = at(d * COUNT + q, e * COUNT + p);
            }
        }
        BulkTable {
            lines: Vec::new(),
            first: vec![0, COUNT],
            entries: Entries::Whole(WholeEntries::new(table, COUNT)),
            error: 0.0,
        }
    }

    /// Rows of a contact line, some of a cell together; `along`: directions that they are loaded along.
    pub(in super::super) fn places(along: usize) -> Vec<TablePoint> {
        let of = |i: usize| {
            let cell = (i / 5) as u32;
            let weight = |k: usize| ((i * 12 + k) as f64).cos();
            TablePoint {
                runs: [3 * cell, 3 * cell + 10, 3 * cell + 20],
                weights: std::array::from_fn(|b| std::array::from_fn(|a| weight(RUN * b + a))),
                parts: std::array::from_fn(|d| if d < along { 0.5 + 0.1 * ((i + d) as f64).sin() } else { 0.0 }),
            }
        };
        (0..17).map(of).collect()
    }

    /// Tiles give what each entry by itself does, with the same bits in plain instructions and the processor's own.
    #[test]
    fn tiles_are_their_entries() {
        let table = table();
        for (openings, loads, symmetric) in [(1, 1, true), (3, 3, true), (1, 3, false), (3, 2, false)] {
            let (openings, loads) = (places(openings), places(loads));
            let n = openings.len();
            let read = |arch: pulp::Arch| {
                let mut out = vec![0.0; n * n];
                let mut work = TableWork { arch, ..TableWork::new(n) };
                table.add(&openings, &loads, symmetric, &mut work, &mut out);
                out
            };
            let found = read(pulp::Arch::new());
            assert_eq!(found, read(pulp::Arch::Scalar), "other bits on another machine");
            for (j, load) in loads.iter().enumerate() {
                for (i, opened) in openings.iter().enumerate().skip(if symmetric { j } else { 0 }) {
                    let (entry, wanted) = (found[j * n + i], table.entry(opened, load));
                    assert!((entry - wanted).abs() < 1e-12, "{i}, {j}: {entry}, not {wanted}");
                }
            }
        }
    }
}
