//! Compliance between rows, read from the part of a table that they touch.

use super::{BulkTable, CELL, DIRECTIONS, TablePoint};

impl BulkTable {
    /// Adds S between rows to `out` (n x n, column by column): opening of row i by a unit load of row j. `symmetric`:
    /// loads are the openings, and the lower triangle is enough.
    pub fn add(
        &self,
        openings: &[TablePoint],
        loads: &[TablePoint],
        symmetric: bool,
        work: &mut TableWork,
        out: &mut [f64],
    ) {
        work.collect(self, openings.iter().chain(if symmetric { &[] } else { loads }));
        work.renumber(openings, loads);
        let TableWork { part, column, places: [openings, loads], arch, .. } = work;
        arch.dispatch(Interpolation { part, column, openings, loads, symmetric, out });
    }
}

/// S from the part of a table that rows touch: one column of it per load, weighed and then read at the openings.
struct Interpolation<'a> {
    part: &'a [f64],
    column: &'a mut Vec<f64>,
    openings: &'a [TablePoint],
    loads: &'a [TablePoint],
    symmetric: bool,
    out: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Interpolation<'_> {
    type Output = ();

    // Compiled for each set of instructions that there may be; the processor's own is chosen as the program runs.
    #[inline(always)]
    fn call(self) {
        let Self { part, column, openings, loads, symmetric, out } = self;
        let n = openings.len();
        let m = part.len().isqrt();
        for (j, load) in loads.iter().enumerate() {
            column.clear();
            column.resize(m, 0.0);
            // Four columns of the part for every pass over their sum.
            let (points, weights) =
                (load.points[..load.count].chunks_exact(4), load.weights[..load.count].chunks_exact(4));
            for (q, w) in points.zip(weights) {
                let [a, b, c, d] = [q[0], q[1], q[2], q[3]].map(|q| &part[m * q as usize..][..m]);
                let [wa, wb, wc, wd] = [w[0], w[1], w[2], w[3]];
                for ((((sum, a), b), c), d) in column.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                    *sum += (wa * a + wb * b) + (wc * c + wd * d);
                }
            }
            let start = if symmetric { j } else { 0 };
            for (place, entry) in openings[start..].iter().zip(&mut out[j * n + start..(j + 1) * n]) {
                let each = place.points[..place.count].iter().zip(&place.weights[..place.count]);
                *entry += each.map(|(&p, w)| w * column[p as usize]).sum::<f64>();
            }
        }
    }
}

/// Memory for [`BulkTable::add`], used again.
#[derive(Debug, Default)]
pub struct TableWork {
    /// Points that the rows touch, those touched before, and the number of each point among them.
    used: Vec<u32>,
    before: Vec<u32>,
    rank: Vec<u32>,
    part: Vec<f64>,
    column: Vec<f64>,
    /// Openings and loads, their points counted among those used.
    places: [Vec<TablePoint>; 2],
    arch: pulp::Arch,
}

impl TableWork {
    /// Memory for `rows` rows on a table, for use with this table until [`TableWork::enter`] says otherwise.
    pub fn new(table: &BulkTable, rows: usize) -> Self {
        let most = table.points().min(rows * DIRECTIONS * CELL);
        Self {
            used: Vec::with_capacity(most),
            before: Vec::with_capacity(most),
            rank: vec![u32::MAX; table.points()],
            part: Vec::with_capacity(most * most),
            column: Vec::with_capacity(most),
            places: [Vec::with_capacity(rows), Vec::with_capacity(rows)],
            arch: pulp::Arch::new(),
        }
    }

    /// Makes it ready for another table.
    pub fn enter(&mut self, table: &BulkTable) {
        self.used.clear();
        self.rank.clear();
        self.rank.resize(table.points(), u32::MAX);
    }

    /// Points of the table that the rows of the last call touched.
    pub fn touched(&self) -> usize {
        self.used.len()
    }

    fn renumber(&mut self, openings: &[TablePoint], loads: &[TablePoint]) {
        for (to, from) in self.places.iter_mut().zip([openings, loads]) {
            to.clear();
            to.extend(from.iter().map(|place| {
                let mut own = *place;
                own.points[..own.count].iter_mut().for_each(|p| *p = self.rank[*p as usize]);
                own
            }));
        }
    }

    /// The part of the table that the places touch, side by side. Contact moves on slowly: often it is the part of the
    /// last call.
    fn collect<'a>(&mut self, table: &BulkTable, places: impl Iterator<Item = &'a TablePoint>) {
        std::mem::swap(&mut self.used, &mut self.before);
        self.before.iter().for_each(|&p| self.rank[p as usize] = u32::MAX);
        self.used.clear();
        for &p in places.flat_map(|place| &place.points[..place.count]) {
            if self.rank[p as usize] == u32::MAX {
                self.rank[p as usize] = 0;
                self.used.push(p);
            }
        }
        self.used.sort_unstable();
        for (r, &p) in self.used.iter().enumerate() {
            self.rank[p as usize] = r as u32;
        }
        if self.used == self.before {
            return;
        }
        self.part.clear();
        for &q in &self.used {
            let column = &table.table[q as usize * table.points()..][..table.points()];
            // Points that follow each other are copied at once.
            for run in self.used.chunk_by(|a, b| a + 1 == *b) {
                self.part.extend_from_slice(&column[run[0] as usize..][..run.len()]);
            }
        }
    }
}
