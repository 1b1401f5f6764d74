//! Compliance between rows, read from the part of a table that they touch.

use std::ops::Range;

use super::{BulkTable, DIRECTIONS, Entries, RUN, RUNS, TablePoint};

/// No point of a table.
const NOWHERE: Range<usize> = Range { start: usize::MAX, end: 0 };

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
        work.stand_on(self, openings, if symmetric { &[] } else { loads });
        let TableWork { part, column, places: [openings, loads], needed, arch, .. } = work;
        let loads = if symmetric { &*openings } else { &*loads };
        needed.clear();
        if symmetric {
            needed.extend(openings.iter().rev().scan(NOWHERE, |all, place| {
                place.widen(all);
                Some(all.clone())
            }));
            needed.reverse();
        }
        arch.dispatch(Interpolation { part, column, openings, loads, needed, out });
    }
}

/// S from the part of a table that rows touch: one column of it per load, weighed and then read at the openings.
struct Interpolation<'a> {
    part: &'a [f64],
    column: &'a mut Vec<f64>,
    openings: &'a [TablePoint],
    loads: &'a [TablePoint],
    /// Where S is symmetric: points that the openings from each row on stand on.
    needed: &'a [Range<usize>],
    out: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Interpolation<'_> {
    type Output = ();

    // Compiled for each set of instructions that there may be; the processor's own is chosen as the program runs.
    #[inline(always)]
    fn call(self) {
        let Self { part, column, openings, loads, needed, out } = self;
        let n = openings.len();
        let m = part.len().isqrt();
        column.clear();
        column.resize(m, 0.0);
        for (j, load) in loads.iter().enumerate() {
            let (start, points) = needed.get(j).map_or((0, 0..m), |points| (j, points.clone()));
            let sums = &mut column[points.clone()];
            sums.fill(0.0);
            // Four columns of the part for every pass over their sum.
            for (&q, weights) in load.runs().iter().zip(&load.weights) {
                add_columns(sums, &part[m * q as usize..], (m, points.start), weights);
            }
            for (place, entry) in openings[start..].iter().zip(&mut out[j * n + start..(j + 1) * n]) {
                *entry += place.read_runs(column);
            }
        }
    }
}

/// S F from the part of a table that rows touch, without S itself.
struct Product<'a> {
    part: &'a [f64],
    column: &'a mut Vec<f64>,
    loaded: &'a mut Vec<f64>,
    openings: &'a [TablePoint],
    loads: &'a [TablePoint],
    forces: &'a [f64],
    out: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { part, column, loaded, openings, loads, forces, out } = self;
        let m = part.len().isqrt();
        if m == 0 {
            return;
        }
        for list in [&mut *loaded, &mut *column] {
            list.clear();
            list.resize(m, 0.0);
        }
        for (load, force) in loads.iter().zip(forces).filter(|(_, force)| **force != 0.0) {
            for (&q, weights) in load.runs().iter().zip(&load.weights) {
                let points = &mut loaded[q as usize..][..RUN];
                points.iter_mut().zip(weights).for_each(|(x, w)| *x += w * force);
            }
        }
        for (four, x) in part.chunks(RUN * m).zip(loaded.as_chunks::<RUN>().0) {
            if x.iter().any(|x| *x != 0.0) {
                add_columns(column, four, (m, 0), x);
            }
        }
        openings.iter().zip(out).for_each(|(place, opening)| *opening += place.read_runs(column));
    }
}

/// Adds four weighed columns of a matrix of `m` rows to sums in one pass over these, from row `first` on.
#[inline(always)]
fn add_columns(sums: &mut [f64], matrix: &[f64], (m, first): (usize, usize), weights: &[f64; RUN]) {
    let &[wa, wb, wc, wd] = weights;
    let count = sums.len();
    let (a, b) = (&matrix[first..][..count], &matrix[m + first..][..count]);
    let (c, d) = (&matrix[2 * m + first..][..count], &matrix[3 * m + first..][..count]);
    for ((((sum, a), b), c), d) in sums.iter_mut().zip(a).zip(b).zip(c).zip(d) {
        *sum += (wa * a + wb * b) + (wc * c + wd * d);
    }
}

impl TablePoint {
    /// What a column has at this place.
    #[inline(always)]
    fn read_runs(&self, column: &[f64]) -> f64 {
        let mut sums = [0.0; RUN];
        for (&first, weights) in self.runs().iter().zip(&self.weights) {
            let points = &column[first as usize..][..RUN];
            (0..RUN).for_each(|k| sums[k] += weights[k] * points[k]);
        }
        (sums[0] + sums[1]) + (sums[2] + sums[3])
    }

    /// Widens a range of points by those that it stands on.
    fn widen(&self, range: &mut Range<usize>) {
        for &first in self.runs() {
            *range = range.start.min(first as usize)..range.end.max(first as usize + RUN);
        }
    }
}

/// Memory for what is read from a table, used again.
#[derive(Debug, Default)]
pub struct TableWork {
    /// Runs that the rows touch, those touched before, and the place of each run in the part by its first point. Runs of
    /// neighbouring cells share a point, which the part then has twice.
    used: Vec<u32>,
    before: Vec<u32>,
    rank: Vec<u32>,
    part: Vec<f64>,
    column: Vec<f64>,
    loaded: Vec<f64>,
    /// Openings and loads, their points counted among those used.
    places: [Vec<TablePoint>; 2],
    needed: Vec<Range<usize>>,
    arch: pulp::Arch,
}

impl TableWork {
    /// Memory for `rows` rows on a table, for use with this table until [`TableWork::enter`] says otherwise.
    pub(crate) fn new(table: &BulkTable, rows: usize) -> Self {
        // A line of points along a profile has a run for every three of them.
        let runs = table.points().div_ceil(RUN - 1).min(rows * DIRECTIONS * RUNS);
        let most = RUN * runs;
        // Of a wide gear rows touch a small part, which grows where it must.
        let kept = if matches!(table.entries, Entries::Layers(_)) { 0 } else { most * most };
        Self {
            used: Vec::with_capacity(runs),
            before: Vec::with_capacity(runs),
            rank: vec![u32::MAX; table.points()],
            part: Vec::with_capacity(kept),
            column: Vec::with_capacity(most),
            loaded: Vec::with_capacity(most),
            places: [Vec::with_capacity(rows), Vec::with_capacity(rows)],
            needed: Vec::with_capacity(rows),
            arch: pulp::Arch::new(),
        }
    }

    /// Makes it ready for another table.
    pub(crate) fn enter(&mut self, table: &BulkTable) {
        self.used.clear();
        self.rank.clear();
        self.rank.resize(table.points(), u32::MAX);
    }

    /// Points of the table that the rows of the last call touched.
    pub(crate) fn touched(&self) -> usize {
        RUN * self.used.len()
    }

    /// Takes the part of the table that rows touch: where these open, and where their loads stand if these are others.
    pub(crate) fn stand_on(&mut self, table: &BulkTable, openings: &[TablePoint], loads: &[TablePoint]) {
        self.collect(table, openings.iter().chain(loads));
        for (to, from) in self.places.iter_mut().zip([openings, loads]) {
            to.clear();
            to.extend(from.iter().map(|place| {
                let mut own = *place;
                own.runs[..own.count].iter_mut().for_each(|p| *p = self.rank[*p as usize]);
                own
            }));
        }
    }

    /// Adds S F to `out`: openings of all rows (mm) by forces (N) along their loads, of the rows that it stands on.
    pub(crate) fn add_openings(&mut self, forces: &[f64], out: &mut [f64]) {
        let Self { part, column, loaded, places: [openings, loads], arch, .. } = self;
        let loads = if loads.is_empty() { &*openings } else { &*loads };
        arch.dispatch(Product { part, column, loaded, openings, loads, forces, out });
    }

    /// The part of the table that the places touch, side by side. Contact moves on slowly: often it is the part of the
    /// last call.
    fn collect<'a>(&mut self, table: &BulkTable, places: impl Iterator<Item = &'a TablePoint>) {
        std::mem::swap(&mut self.used, &mut self.before);
        self.before.iter().for_each(|&p| self.rank[p as usize] = u32::MAX);
        self.used.clear();
        let mut last = [u32::MAX; DIRECTIONS * RUNS];
        for place in places {
            // Neighbours mostly stand on the same runs.
            if place.runs[..place.count] == last[..place.count] {
                continue;
            }
            last = place.runs;
            for &first in place.runs() {
                if self.rank[first as usize] == u32::MAX {
                    self.rank[first as usize] = 0;
                    self.used.push(first);
                }
            }
        }
        self.used.sort_unstable();
        for (r, &first) in self.used.iter().enumerate() {
            self.rank[first as usize] = (RUN * r) as u32;
        }
        if self.used == self.before {
            return;
        }
        self.part.resize((RUN * self.used.len()).pow(2), 0.0);
        if self.used.is_empty() {
            return;
        }
        let columns = self.used.iter().flat_map(|&first| first as usize..first as usize + RUN);
        for (q, own) in columns.zip(self.part.chunks_exact_mut(RUN * self.used.len())) {
            let (own, _) = own.as_chunks_mut::<RUN>();
            let runs = self.used.iter().zip(own);
            match &table.entries {
                Entries::Whole(all) => {
                    let column = &all[q * table.points()..][..table.points()];
                    runs.for_each(|(&first, run)| run.copy_from_slice(&column[first as usize..][..RUN]));
                }
                Entries::Layers(layers) => {
                    runs.for_each(|(&first, run)| run.copy_from_slice(layers.run(q, first as usize)));
                }
            }
        }
    }
}
