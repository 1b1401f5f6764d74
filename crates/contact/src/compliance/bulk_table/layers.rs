//! Makes the table of a wide gear from a shorter one with the same layers.

use nalgebra::Matrix3;
use reduction::LayerStack;

use super::{
    BulkCompliance, BulkTable, DIRECTIONS, Entries, FlankGridLines, NodeBlocks, Pole, RUN, RUNS, first_points,
    grid_supports, whole::TilePoints,
};
use crate::{ContactError, flank::FlankPatch, nodal::Support};

/// Lines of points along the face that a cell has beyond the one before it.
const LINES: usize = 2;
/// Parts of an even load on a layer that its lines of points take.
const EVEN: [f64; LINES + 1] = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];
/// Error of a table by layers at most, relative to the largest self-compliance; on layers of 1.7 modules interpolation
/// alone is off by one or two thousandths between the grid lines.
const MOST_ERROR: f64 = 5e-3;

/// Entries between two points of a wide gear's flanks.
///
/// ```text
/// T(a, l, u; b, m, v) = t(b - a, l - 2 s, u; m - 2 s, v),   s = clamp(((l + m)/2 - n)/2, 0, N - n)
/// ```
/// Teeth a and b, lines l and m along the face (two a layer), points u and v along the profile; t is the table of the
/// gear of n layers by teeth apart, laid into that of N layers so that the two points are as near to its middle as the
/// end faces allow. Points further apart than n layers do not feel each other.
#[derive(Debug, Clone)]
pub(super) struct LayerEntries {
    /// N and n.
    layers: [usize; 2],
    /// Points along the profile; of one patch of the wide gear; of all its patches.
    profile: usize,
    of_patch: usize,
    all: usize,
    teeth: usize,
    /// Of n layers by teeth apart, from 1 - teeth on: column by column, each direction in turn.
    blocks: Vec<f64>,
    /// Rows of a block.
    side: usize,
}

/// A run of points that do not feel the other.
static FAR: [f64; RUN] = [0.0; RUN];

/// A point of the wide table.
struct Place {
    direction: usize,
    tooth: usize,
    line: usize,
    along: usize,
}

impl LayerEntries {
    fn place(&self, point: usize) -> Place {
        let (direction, point) = (point / self.all, point % self.all);
        let (tooth, point) = (point / self.of_patch, point % self.of_patch);
        Place { direction, tooth, line: point / self.profile, along: point % self.profile }
    }

    /// Entries of column `q` in the run of points along the profile from `first` on, mm/N.
    #[inline]
    pub(super) fn run(&self, q: usize, first: usize) -> &[f64] {
        self.entry(q, first).map_or(&FAR, |entry| &self.blocks[entry..][..RUN])
    }

    /// Entries between the points of two cells, by the first points of their runs: of loads and of openings.
    pub(super) fn tile(&self, loads: [usize; RUNS], openings: [usize; RUNS]) -> TilePoints {
        let mut all = [[0.0; RUNS * RUN]; RUNS * RUN];
        for (q, column) in loads.into_iter().flat_map(|first| first..first + RUN).zip(&mut all) {
            for (first, run) in openings.into_iter().zip(column.as_chunks_mut::<RUN>().0) {
                run.copy_from_slice(self.run(q, first));
            }
        }
        all
    }

    /// T of two points, mm/N.
    pub(super) fn at(&self, q: usize, p: usize) -> f64 {
        self.entry(q, p).map_or(0.0, |entry| self.blocks[entry])
    }

    /// Where two points are in the blocks; `None` where they do not feel each other.
    fn entry(&self, q: usize, p: usize) -> Option<usize> {
        let (load, moved, [all, own]) = (self.place(q), self.place(p), self.layers);
        // Lines of the shorter gear's first one: symmetric in both, so that the table is.
        let middle = (load.line + moved.line + LINES).saturating_sub(LINES * own) / (2 * LINES);
        let from = LINES * middle.min(all - own);
        let inside = |line: usize| line.checked_sub(from).filter(|line| *line <= LINES * own);
        let (column, row) = (inside(load.line)?, inside(moved.line)?);
        let apart = moved.tooth + self.teeth - 1 - load.tooth;
        let points = self.side / DIRECTIONS;
        let column = load.direction * points + column * self.profile + load.along;
        let row = moved.direction * points + row * self.profile + moved.along;
        Some((apart * self.side + column) * self.side + row)
    }

    /// t along the normal between points at one place of the profile of one tooth, mm/N.
    fn own(&self, along: usize, [l, m]: [usize; 2]) -> f64 {
        let at = |line: usize| line * self.profile + along;
        self.blocks[((self.teeth - 1) * self.side + at(m)) * self.side + at(l)]
    }

    /// The same between even loads on two layers.
    fn even(&self, along: usize, [i, j]: [usize; 2]) -> f64 {
        let lines = |layer: usize| [0, 1, 2].map(|k| LINES * layer + k).into_iter().zip(EVEN);
        lines(i).flat_map(|(l, v)| lines(j).map(move |(m, w)| v * w * self.own(along, [l, m]))).sum()
    }

    /// What the shorter gear does not tell of line loads along the face, relative to what it tells: what its end faces do
    /// to pairs of layers about its middle, and the influence near its width and beyond.
    ///
    /// ```text
    /// ends = sum over pairs i + j = n - 1, two layers or more from the ends, of |t(i, j) - t(i + 1, j + 1)|
    /// far = sum over the other pairs of |t(i, j)|
    /// remainder = 3 (ends + far)/sum over j of |t(n/2, j)|,   each sum over all points of the profile
    /// ```
    /// t is between even loads on two layers. What an end face adds falls as exp(-q x), and a pair one layer off the middle
    /// differs by cosh q - 1 of what both faces add: a third and more up to decay lengths 2/q of two and a half layers. Where
    /// it falls slower, far is too large. Beyond the width there is less than in its last four layers.
    fn remainder(&self) -> f64 {
        let (n, near) = (self.layers[1], 2);
        if n < 2 * near + 1 {
            return f64::INFINITY;
        }
        let sum = |layers: std::ops::Range<usize>, of: &dyn Fn(usize, usize) -> f64| -> f64 {
            (0..self.profile).map(|along| layers.clone().map(|i| of(along, i).abs()).sum::<f64>()).sum()
        };
        let pair = |along: usize, i: usize, k: usize| self.even(along, [i + k, n - 1 - i + k]);
        let ends = sum(near..n - near, &|along, i| pair(along, i, 0) - pair(along, i, 1));
        let far = |layers| sum(layers, &|along, i| pair(along, i, 0));
        3.0 * (ends + far(0..near) + far(n - near..n)) / sum(0..n, &|along, j| self.even(along, [n / 2, j]))
    }
}

impl BulkTable {
    /// Table of a gear whose teeth are all alike, of which `bulk` needs the columns of its first tooth alone; its grid lines
    /// are those of the mesh's faces. `None` where it is off by more than `tolerance`, relative, or the faces form no
    /// grid.
    pub(crate) fn of_teeth_alike(bulk: &BulkCompliance<'_>, tolerance: f64) -> Option<Self> {
        let layers = FlankGridLines::of_faces(bulk.patches.first()?)?.face_cells();
        let stack = LayerStack { layers, condensed: layers, free_count: 0 };
        Self::of_layers(bulk, stack, bulk.patches, tolerance).ok()
    }

    /// Table of a wide gear whose `whole` flanks have `stack.layers` layers of elements, from the shorter gear that
    /// `bulk` knows by the columns of its first tooth; its grid lines are those of the mesh's faces.
    ///
    /// # Errors
    /// [`ContactError::Layers`] where it is off by more than `tolerance` and [`MOST_ERROR`], relative, or the faces form no
    /// grid.
    pub(crate) fn of_layers(
        bulk: &BulkCompliance<'_>,
        stack: LayerStack,
        whole: &[FlankPatch],
        tolerance: f64,
    ) -> Result<Self, ContactError> {
        let most = if stack.layers > stack.condensed { tolerance.max(MOST_ERROR) } else { tolerance };
        let fails = |error| ContactError::Layers { error, most };
        let lines = bulk.patches.iter().map(FlankGridLines::of_faces).collect::<Option<Vec<_>>>();
        let lines = lines.ok_or_else(|| fails(f64::INFINITY))?;
        let (Some(one), teeth) = (lines.first().cloned(), lines.len()) else { return Err(fails(f64::INFINITY)) };
        let alike = |l: &FlankGridLines| l.count() == one.count() && l.face_cells() == stack.condensed;
        if !lines.iter().all(alike) || stack.condensed > stack.layers {
            return Err(fails(f64::INFINITY));
        }
        let entries = |layers: usize, blocks: Vec<f64>| {
            let of_patch = one.lines(0) * (LINES * layers + 1);
            let (profile, side) = (one.lines(0), DIRECTIONS * one.count());
            LayerEntries {
                layers: [layers, stack.condensed],
                profile,
                of_patch,
                all: teeth * of_patch,
                teeth,
                blocks,
                side,
            }
        };
        let supports = grid_supports(&lines, bulk.patches);
        let mut blocks = vec![0.0; (2 * teeth - 1) * (DIRECTIONS * one.count()).pow(2)];
        pulp::Arch::new().dispatch(Blocks { bulk, supports: &supports, count: one.count(), blocks: &mut blocks });
        let short = entries(stack.condensed, blocks);
        let remainder = if stack.layers > stack.condensed { short.remainder() } else { 0.0 };
        let first = first_points(&lines);
        let mut table = Self { lines, first, entries: Entries::Layers(short), error: 0.0 };
        let error = table.measured(bulk, 1).max(remainder);
        if error.is_nan() || error > most {
            return Err(fails(error));
        }
        let Self { lines, entries: Entries::Layers(short), .. } = table else { return Err(fails(error)) };
        let wide = |(lines, patch): (&FlankGridLines, &FlankPatch)| {
            let [[_, low], [_, high]] = patch.range();
            lines.along_face(stack.layers, [low, high])
        };
        let lines: Vec<_> = lines.iter().zip(whole).map(wide).collect();
        table = Self {
            first: first_points(&lines),
            lines,
            entries: Entries::Layers(entries(stack.layers, short.blocks)),
            error,
        };
        Ok(table)
    }
}

/// Blocks of entries by teeth apart, from loads on the first tooth.
struct Blocks<'a> {
    bulk: &'a BulkCompliance<'a>,
    supports: &'a [Option<[Support; DIRECTIONS]>],
    /// Points of one tooth.
    count: usize,
    blocks: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Blocks<'_> {
    type Output = ();

    // Compiled for each set of instructions that there may be; the processor's own is chosen as the program runs.
    #[inline(always)]
    fn call(self) {
        let Self { bulk, supports, count, blocks } = self;
        let (side, teeth) = (DIRECTIONS * count, supports.len() / count);
        let poles: Vec<Option<Pole>> = supports.iter().map(|s| s.as_ref().map(Pole::of)).collect();
        let (mut columns, mut moved): ([Vec<f64>; 3], NodeBlocks) = Default::default();
        for (q, load) in supports[..count].iter().enumerate() {
            let Some(load) = load else { continue };
            bulk.displacements(&load[0], &mut columns, &mut moved);
            for (p, pole) in poles.iter().enumerate() {
                let Some(pole) = pole else { continue };
                let between: Matrix3<f64> = pole.between(&moved);
                let (apart, row) = (p / count + teeth - 1, p % count);
                for (d, load) in load.iter().enumerate() {
                    let moved = between * load.load;
                    let column = (apart * side + d * count + q) * side;
                    for (e, direction) in pole.directions.iter().enumerate() {
                        blocks[column + e * count + row] = direction.dot(&moved);
                    }
                }
            }
        }
        // T_pq = T_qp: of one tooth to the bit, of two the block the other way.
        for apart in 0..teeth {
            let (low, high) = ((teeth - 1 - apart) * side * side, (teeth - 1 + apart) * side * side);
            for j in 0..side {
                for i in 0..side {
                    let (to, from) = (low + j * side + i, high + i * side + j);
                    if apart > 0 {
                        blocks[to] = blocks[from];
                    } else if i < j {
                        let mean = 0.5 * (blocks[to] + blocks[from]);
                        (blocks[to], blocks[from]) = (mean, mean);
                    }
                }
            }
        }
    }
}
