//! Compliance between rows, read from a table where they stand.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::{BulkTable, DIRECTIONS, RUN, RUNS, TablePoint};
use crate::lanes::{self, Four};

/// Loads that a tile of the table is multiplied with in one pass over it.
const AT_ONCE: usize = 6;

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
        let TableWork { groups: [of_openings, of_loads], spread, arch } = work;
        group(openings, of_openings);
        of_loads.clear();
        let loads = if symmetric { openings } else { loads };
        if !symmetric {
            group(loads, of_loads);
        }
        let groups = [&of_openings[..], if symmetric { of_openings } else { of_loads }];
        let (count, table) = (self.points() / DIRECTIONS, &self.table[..]);
        lanes::run(*arch, Interpolation { table, count, places: [openings, loads], groups, symmetric, spread, out });
    }
}

/// Rows that follow each other in one cell of the table, loaded along the same directions: neighbours on a contact line
/// mostly do and are.
#[derive(Debug, Clone, PartialEq)]
struct Group {
    rows: Range<usize>,
    runs: [u32; RUNS],
    along: [bool; DIRECTIONS],
}

fn group(places: &[TablePoint], out: &mut Vec<Group>) {
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
    table: &'a [f64],
    /// Points along one direction.
    count: usize,
    /// Openings and loads.
    places: [&'a [TablePoint]; 2],
    groups: [&'a [Group]; 2],
    symmetric: bool,
    /// Weights of the loads of a group along one direction.
    spread: &'a mut Vec<Spread>,
    out: &'a mut [f64],
}

impl WithSimd for Interpolation<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { table, count, places: [openings, loads], groups: [of_openings, of_loads], symmetric, spread, out } =
            self;
        let n = openings.len();
        for (number, group) in of_loads.iter().enumerate() {
            for d in (0..DIRECTIONS).filter(|d| group.along[*d]) {
                spread.clear();
                spread.extend(loads[group.rows.clone()].iter().map(|load| load.spread(d)));
                let first = if symmetric { number } else { 0 };
                for opened in &of_openings[first..] {
                    for e in (0..DIRECTIONS).filter(|e| opened.along[*e]) {
                        let block = &table[(DIRECTIONS * d + e) * count * count..][..count * count];
                        let rows = &openings[opened.rows.clone()];
                        let tile = Tile { block, count, runs: [&opened.runs, &group.runs] };
                        let columns = out[n * group.rows.start..].chunks_mut(n * AT_ONCE);
                        for (part, columns) in spread.chunks(AT_ONCE).zip(columns) {
                            let out = &mut columns[opened.rows.start..];
                            match part {
                                [_, _, _, _, _, _] => tile.add::<S, 6>(simd, part, (rows, e), (out, n)),
                                [_, _, _, _, _] => tile.add::<S, 5>(simd, part, (rows, e), (out, n)),
                                [_, _, _, _] => tile.add::<S, 4>(simd, part, (rows, e), (out, n)),
                                [_, _, _] => tile.add::<S, 3>(simd, part, (rows, e), (out, n)),
                                [_, _] => tile.add::<S, 2>(simd, part, (rows, e), (out, n)),
                                _ => tile.add::<S, 1>(simd, part, (rows, e), (out, n)),
                            }
                        }
                    }
                }
            }
        }
    }
}

/// What the loads of one group do at the points of another, along one direction each.
struct Tile<'a> {
    block: &'a [f64],
    count: usize,
    /// Runs of openings and loads.
    runs: [&'a [u32; RUNS]; 2],
}

impl Tile<'_> {
    /// Adds what `K` loads with the weights `spread` open `rows` by along direction `e`: to the first entries of as many
    /// columns of `out`, `n` apart.
    #[inline(always)]
    fn add<S: Simd, const K: usize>(
        &self,
        simd: S,
        spread: &[Spread],
        (rows, e): (&[TablePoint], usize),
        (out, n): (&mut [f64], usize),
    ) {
        let Some(spread) = spread.first_chunk::<K>() else { return };
        let zero = Four::splat(simd, 0.0);
        let (mut first, mut second, mut third) = ([zero; K], [zero; K], [zero; K]);
        let [rows_at, columns_at] = self.runs;
        let [p0, p1, p2] = [rows_at[0] as usize, rows_at[1] as usize, rows_at[2] as usize];
        for c in 0..RUNS {
            let from = columns_at[c] as usize * self.count;
            let columns = self.block[from..from + RUN * self.count].chunks_exact(self.count);
            for (a, column) in columns.enumerate() {
                let (x0, x1, x2) = (run(simd, column, p0), run(simd, column, p1), run(simd, column, p2));
                for k in 0..K {
                    let weight = Four::new(simd, &spread[k][c][a]);
                    first[k] = first[k] + x0 * weight;
                    second[k] = second[k] + x1 * weight;
                    third[k] = third[k] + x2 * weight;
                }
            }
        }
        for (k, column) in out.chunks_mut(n).take(K).enumerate() {
            for (row, entry) in rows.iter().zip(column) {
                let [a, b, c] = &row.weights;
                let ends = Four::new(simd, a) * first[k] + Four::new(simd, b) * second[k];
                *entry += row.parts[e] * (ends + Four::new(simd, c) * third[k]).sum();
            }
        }
    }
}

/// Four points of a column that follow each other.
#[inline(always)]
fn run<S: Simd>(simd: S, column: &[f64], first: usize) -> Four<S> {
    Four::new(simd, column[first..].first_chunk::<RUN>().unwrap_or(&[0.0; RUN]))
}

/// Weights of a load along one direction, each four times.
type Spread = [[[f64; RUN]; RUN]; RUNS];

impl TablePoint {
    fn spread(&self, d: usize) -> Spread {
        let mut all = [[[0.0; RUN]; RUN]; RUNS];
        for (spread, weight) in all.as_flattened_mut().iter_mut().zip(self.weights.as_flattened()) {
            *spread = [self.parts[d] * weight; RUN];
        }
        all
    }
}

/// Memory for what is read from a table, used again.
#[derive(Debug, Default)]
pub struct TableWork {
    /// Groups of openings, and of loads where these are others.
    groups: [Vec<Group>; 2],
    spread: Vec<Spread>,
    arch: pulp::Arch,
}

impl TableWork {
    /// Memory for `rows` rows.
    pub(crate) fn new(rows: usize) -> Self {
        let groups = || Vec::with_capacity(rows);
        Self { groups: [groups(), groups()], spread: Vec::with_capacity(rows), arch: pulp::Arch::new() }
    }

    /// Points of the table that the rows of the last call touched.
    pub(crate) fn touched(&self) -> usize {
        let points =
            self.groups.iter().flatten().flat_map(|group| group.runs).flat_map(|first| first..first + RUN as u32);
        points.collect::<std::collections::BTreeSet<u32>>().len()
    }
}
