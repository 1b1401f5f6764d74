//! Bulk compliance of a body as a table over its flanks: the compliance of the mesh without its local indentations.
//! Theory (36).

mod keep;
mod layers;
mod rates;
mod rows;
mod triangles;
mod whole;

use std::{borrow::Cow, sync::Arc};

use faer::{ColRef, MatRef};
use nalgebra::Matrix3;
use reduction::{LocalCompliance, ReducedGear};

use crate::{
    Vec3,
    compliance::{bulk_grid::FlankGridLines, condensed::load_columns},
    flank::{FacePoint, FlankPatch},
    nodal::Support,
    opening,
};

pub(crate) use keep::Keeper;
use layers::LayerEntries;
use whole::WholeEntries;

pub(crate) use rates::{PointRate, RateWork, Reading};
pub use rows::TableWork;

/// One body's compliance, and what is to be taken away of it.
#[derive(Debug)]
pub(crate) struct BulkBody {
    /// Its W, mm/N, 3n x 3n, node by node x, y, z.
    pub reduced: Arc<ReducedGear>,
    /// W_c of each patch with the numbers its nodes have in W, ascending.
    pub local: Vec<(Vec<u32>, Arc<LocalCompliance>)>,
}

impl BulkBody {
    /// With the body's patches.
    pub(crate) fn with<'a>(&'a self, patches: &'a [FlankPatch]) -> BulkCompliance<'a> {
        let local = self.local.iter().map(|(numbers, half)| (&numbers[..], half.compliance.as_ref())).collect();
        BulkCompliance { whole: &self.reduced, local, patches }
    }
}

/// One body's compliance, and what is to be taken away of it, borrowed.
#[derive(Debug, Clone)]
pub(crate) struct BulkCompliance<'a> {
    /// It has W.
    pub whole: &'a ReducedGear,
    /// W_c of each patch with the numbers its nodes have in W, ascending.
    pub local: Vec<(&'a [u32], MatRef<'a, f64>)>,
    /// The body's patches.
    pub patches: &'a [FlankPatch],
}

/// Table of the bulk compliance of one body.
///
/// ```text
/// D = W - sum over flanks of W_c,    S_ij = a_i' D a_j  ~  w_i' T w_j,    T_pq = a_p' D a_q
/// ```
/// T is D for unit forces at grid points p of the flanks, along the flank's normal, its profile and its generator. w
/// interpolates between grid points, cubic along the profile and quadratic along the face. The cells are the faces of
/// the mesh if these form a grid; then the interpolation reproduces the effect of the shape functions on D almost
/// exactly. Normal forces need only the first direction. [`BulkTable::error`] is the difference from A D A'.
#[derive(Debug, Clone)]
pub struct BulkTable {
    lines: Vec<FlankGridLines>,
    /// First point of each patch; the last entry is the number of points.
    first: Vec<usize>,
    entries: Entries,
    error: f64,
}

/// T of a table.
#[derive(Debug, Clone)]
enum Entries {
    /// Of all pairs of points.
    Whole(WholeEntries),
    /// By teeth apart, on the shorter gear of a wide one.
    Layers(LayerEntries),
}

/// Points and weights of one row in a table: three runs of points that follow each other along the profile.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TablePoint {
    /// First point of each run.
    runs: [u32; RUNS],
    weights: [[f64; RUN]; RUNS],
    /// What of a unit force is along each direction.
    parts: [f64; DIRECTIONS],
}

/// Points of a run, and runs of a cell along the face.
const RUN: usize = 4;
const RUNS: usize = 3;
/// Normal, profile, generator.
const DIRECTIONS: usize = 3;
/// Share of the force along one of the others that is round-off.
const NONE: f64 = 1e-9;
/// Points of a table at most, all directions: 288 MiB.
const MOST_POINTS: usize = 6144;
/// Uniform grids to try, each twice as fine as the one before.
const REFINEMENTS: usize = 3;
/// Places of each patch at which a table is held against the matrices, either way.
const CHECKS: usize = 5;

/// D at the nodes by unit forces along x, y, z at a place, mm/N: of each node the displacements along x by the three
/// forces, then those along y and along z.
type NodeBlocks = Vec<[f64; 9]>;

impl BulkCompliance<'_> {
    /// D by unit forces along x, y, z at a place.
    #[inline(always)]
    fn displacements(&self, support: &Support, columns: &mut [Vec<f64>; 3], out: &mut NodeBlocks) {
        for (k, column) in columns.iter_mut().enumerate() {
            column.clear();
            column.resize(self.whole.coordinates(), 0.0);
            for (&node, &w) in support.nodes[..support.count].iter().zip(&support.weights).filter(|(_, w)| **w != 0.0) {
                self.add_column((node, k), w, column);
            }
        }
        let [x, y, z] = columns.each_ref().map(|c| c.as_chunks::<3>().0);
        out.clear();
        out.extend(x.iter().zip(y).zip(z).map(|((x, y), z)| [x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]]));
    }

    /// D a for a unit force, mm/N.
    fn displacement(&self, support: &Support, out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.whole.coordinates(), 0.0);
        load_columns(support, |dof, f| self.add_column(((dof / 3) as u32, dof % 3), f, out));
    }

    /// Adds the displacements by a force at a node along an axis.
    #[inline(always)]
    fn add_column(&self, (node, axis): (u32, usize), force: f64, out: &mut [f64]) {
        let column = contiguous(self.whole.compliance().col(3 * node as usize + axis));
        out.iter_mut().zip(&*column).for_each(|(o, w)| *o += force * w);
        let blocks = out.as_chunks_mut::<3>().0;
        for (numbers, local) in &self.local {
            let Ok(own) = numbers.binary_search(&node) else { continue };
            let column = contiguous(local.col(3 * own + axis));
            for (&number, [x, y, z]) in numbers.iter().zip(column.as_chunks().0) {
                let block = &mut blocks[number as usize];
                *block = [block[0] - force * x, block[1] - force * y, block[2] - force * z];
            }
        }
    }
}

/// A column as it stands, or copied.
#[inline(always)]
fn contiguous(column: ColRef<'_, f64>) -> Cow<'_, [f64]> {
    match column.try_as_col_major() {
        Some(column) => Cow::Borrowed(column.as_slice()),
        None => column.iter().copied().collect(),
    }
}

/// Weights of a unit force's nodes, those without weight left out, and its three directions.
struct Pole {
    nodes: Vec<(u32, f64)>,
    directions: [Vec3; DIRECTIONS],
}

impl Pole {
    fn of(along: &[Support; DIRECTIONS]) -> Self {
        let Support { nodes, weights, count, .. } = &along[0];
        let all = nodes[..*count].iter().copied().zip(*weights);
        Self { nodes: all.filter(|(_, w)| *w != 0.0).collect(), directions: along.each_ref().map(|s| s.direction) }
    }
}

impl Pole {
    /// Displacement at this place by forces along x, y, z at the other, mm/N.
    #[inline(always)]
    fn between(&self, moved: &NodeBlocks) -> Matrix3<f64> {
        let mut between = [0.0; 9];
        for &(node, w) in &self.nodes {
            let block = &moved[node as usize];
            (0..9).for_each(|k| between[k] += w * block[k]);
        }
        Matrix3::from_row_slice(&between)
    }
}

/// T of one gear on its grid points, all directions, mm/N.
struct Filling<'a> {
    bulk: &'a BulkCompliance<'a>,
    supports: &'a [Option<[Support; DIRECTIONS]>],
    table: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Filling<'_> {
    type Output = ();

    // Compiled for each set of instructions that there may be; the processor's own is chosen as the program runs.
    #[inline(always)]
    fn call(self) {
        let Self { bulk, supports, table } = self;
        let count = supports.len();
        let poles: Vec<Option<Pole>> = supports.iter().map(|s| s.as_ref().map(Pole::of)).collect();
        let (mut columns, mut moved): ([Vec<f64>; 3], NodeBlocks) = Default::default();
        for (q, load) in supports.iter().enumerate() {
            let Some(load) = load else { continue };
            bulk.displacements(&load[0], &mut columns, &mut moved);
            let own = &mut table[..];
            for (p, pole) in poles.iter().enumerate().skip(q) {
                let Some(pole) = pole else { continue };
                let between = pole.between(&moved);
                for (d, load) in load.iter().enumerate() {
                    let moved = between * load.load;
                    for (e, direction) in pole.directions.iter().enumerate() {
                        own[((DIRECTIONS * d + e) * count + q) * count + p] = direction.dot(&moved);
                    }
                }
            }
        }
        mirror(table, count, 0);
    }
}

/// T between all points, all directions: in blocks, openings along the normal, then along the profile, then along the
/// generator by loads along the normal, and so on; each block column by column.
fn filled(bulk: &BulkCompliance<'_>, supports: &[Option<[Support; DIRECTIONS]>]) -> Vec<f64> {
    let mut table = vec![0.0; (DIRECTIONS * supports.len()).pow(2)];
    pulp::Arch::new().dispatch(Filling { bulk, supports, table: &mut table });
    table
}

/// Side of the tiles in which a triangle of a table is copied, points.
const TILE: usize = 32;

/// The other triangle: T_pq = T_qp, of points as filled for p >= q; of one point with itself as the later direction sees
/// the earlier one. Blocks before number `from` are not there, or as many as fill the table.
fn mirror(table: &mut [f64], count: usize, from: usize) {
    let at = |d: usize, q: usize, e: usize, p: usize| ((DIRECTIONS * d + e) * count + q) * count + p;
    let blocks = (0..DIRECTIONS * DIRECTIONS).take(table.len() / (count * count).max(1)).skip(from);
    for (d, e) in blocks.map(|block| (block / DIRECTIONS, block % DIRECTIONS)) {
        for first in (0..count).step_by(TILE) {
            for other in (0..=first).step_by(TILE) {
                for p in first..count.min(first + TILE) {
                    for q in other..p.min(other + TILE) {
                        table[at(e, p, d, q)] = table[at(d, q, e, p)];
                    }
                }
            }
        }
        if e < d {
            (0..count).for_each(|q| table[at(d, q, e, q)] = table[at(e, q, d, q)]);
        }
    }
}

/// Supports of unit forces along the three directions at a place of a patch.
fn supports(flank: &FlankPatch, at: [f64; 2]) -> Option<[Support; DIRECTIONS]> {
    let mut face: Option<FacePoint> = None;
    let along = directions(flank, at);
    let support = crate::nodal::support_at(flank, at, along[0], &mut face)?;
    Some(along.map(|d| Support { direction: d, load: d, ..support }))
}

/// Supports of unit forces along the three directions, at all grid points of all patches.
fn grid_supports(lines: &[FlankGridLines], patches: &[FlankPatch]) -> Vec<Option<[Support; DIRECTIONS]>> {
    let of_patch = |(grid, flank): (&FlankGridLines, &FlankPatch)| {
        (0..grid.count()).map(|p| supports(flank, grid.point(p))).collect::<Vec<_>>()
    };
    lines.iter().zip(patches).flat_map(of_patch).collect()
}

/// Normal, direction of the profile and that of the generator at a place of a flank, of its nominal surface: kinks of
/// reliefs are none of the mesh's.
fn directions(patch: &FlankPatch, at: [f64; 2]) -> [Vec3; DIRECTIONS] {
    let [normal, along] = patch.surface().nominal_frame(at);
    [normal, along, normal.cross(&along)]
}

/// What of a unit force along `direction` (own frame) is along the three directions at a place of a flank.
pub(crate) fn parts(flank: &FlankPatch, at: [f64; 2], direction: &Vec3) -> [f64; DIRECTIONS] {
    directions(flank, at).map(|e| e.dot(direction))
}

impl BulkTable {
    /// The first table whose error is at most `tolerance`, relative to the largest self-compliance: on the faces of the
    /// mesh, else on uniform grids that grow finer; `None` where none within reason is good enough. What `keeper` has is
    /// not made again.
    pub(crate) fn new(bulk: &BulkCompliance<'_>, tolerance: f64, keeper: Option<Keeper<'_>>) -> Option<Self> {
        let of_faces = bulk.patches.iter().map(FlankGridLines::of_faces).collect::<Option<Vec<_>>>();
        let uniform = |refinement| bulk.patches.iter().map(|p| FlankGridLines::uniform(p, refinement)).collect();
        let small = |lines: &Vec<FlankGridLines>| {
            DIRECTIONS * lines.iter().map(FlankGridLines::count).sum::<usize>() <= MOST_POINTS
        };
        let candidates = of_faces.into_iter().chain((0..REFINEMENTS).map(uniform));
        candidates.filter(small).map(|lines| Self::on(bulk, lines, keeper)).find(|table| table.error <= tolerance)
    }

    fn on(bulk: &BulkCompliance<'_>, lines: Vec<FlankGridLines>, keeper: Option<Keeper<'_>>) -> Self {
        let first = first_points(&lines);
        let count = first.last().copied().unwrap_or(0);
        let supports = grid_supports(&lines, bulk.patches);
        let kept = keeper.map(|keeper| (keeper, keeper.key(&supports, bulk.patches)));
        if let Some((keeper, key)) = kept
            && let Some((error, entries)) = keeper.table(&key, &supports)
        {
            return Self { lines, first, entries: Entries::Whole(entries), error };
        }
        let table = filled(bulk, &supports);
        let mut made = Self { lines, first, entries: Entries::Whole(WholeEntries::new(table, count)), error: 0.0 };
        made.error = made.measured(bulk, bulk.patches.len());
        if let (Some((keeper, key)), Entries::Whole(entries)) = (kept, &made.entries) {
            keeper.keep(key, made.error, entries.table(), count);
        }
        made
    }

    /// Largest difference to A D A' between the grid points, relative to the largest self-compliance there: of each
    /// place on the first `loaded` patches with itself and with the places checked before it, where these are all, else
    /// with all places.
    fn measured(&self, bulk: &BulkCompliance<'_>, loaded: usize) -> f64 {
        let mut places = Vec::new();
        for (patch, flank) in bulk.patches.iter().enumerate() {
            let [low, high] = flank.range();
            // Steps that are no simple parts of the flank, so as to miss the grid lines.
            for i in 0..CHECKS * CHECKS {
                let share = |k: f64| (0.5 + k * 0.618_033_988_749_894_9).fract();
                let part = [(i as f64 + 0.5) / (CHECKS * CHECKS) as f64, share(i as f64)];
                let at = [0, 1].map(|k| low[k] + part[k] * (high[k] - low[k]));
                if let (Some(exact), Some(place)) = (supports(flank, at), self.at(patch, at, [1.0, 0.0, 0.0])) {
                    places.push((exact[0], place, patch));
                }
            }
        }
        let (mut worst, mut largest) = (0.0f64, f64::MIN_POSITIVE);
        let mut u = Vec::new();
        for (i, (support, place, _)) in places.iter().enumerate().filter(|(_, (.., patch))| *patch < loaded) {
            bulk.displacement(support, &mut u);
            largest = largest.max(opening(support, &u));
            let seen = if loaded < bulk.patches.len() { &places[..] } else { &places[..=i] };
            for (other, other_place, _) in seen {
                worst = worst.max((opening(other, &u) - self.entry(other_place, place)).abs());
            }
        }
        worst / largest
    }

    /// Displacements u of the boundary (3n each, mm) as unit forces at all points see them, one list each: what
    /// [`TablePoint::read`] reads openings from.
    ///
    /// ```text
    /// A u  ~  w_i' s,   s_p = a_p' u
    /// ```
    /// Interpolated like the compliance itself, so that taking a' Phi Phi' a away from it leaves what the table would
    /// have of the rest.
    pub(crate) fn sample(&self, patches: &[FlankPatch], displacements: &[&[f64]]) -> Vec<Vec<f64>> {
        let supports = grid_supports(&self.lines, patches);
        let along = |k: usize| supports.iter().map(move |s| s.as_ref().map(|s| &s[k]));
        let of_one = |u: &&[f64]| {
            let value = |support: Option<&Support>| support.map_or(0.0, |s| opening(s, u));
            (0..DIRECTIONS).flat_map(|k| along(k).map(value)).collect()
        };
        displacements.iter().map(of_one).collect()
    }

    /// Error relative to the largest self-compliance, measured between the grid points when the table was made.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Number of points, all directions.
    pub(crate) fn points(&self) -> usize {
        DIRECTIONS * self.first.last().copied().unwrap_or(0)
    }

    /// Place of a row in the table: `at` on patch number `patch`, `parts` what of the unit force is along the three
    /// directions there ([`parts`]).
    #[inline]
    pub(crate) fn at(&self, patch: usize, at: [f64; 2], parts: [f64; DIRECTIONS]) -> Option<TablePoint> {
        let (runs, weights) = self.lines.get(patch)?.weights(at);
        Some(TablePoint {
            runs: runs.map(|first| (self.first[patch] + first) as u32),
            weights,
            parts: parts.map(|part| if part.abs() > NONE { part } else { 0.0 }),
        })
    }

    /// Rate of a place's weights, direction by direction, as surface coordinates and parts change by `at_rate` and
    /// `parts_rate`.
    pub(crate) fn rate(
        &self,
        (patch, at, point): (usize, [f64; 2], &TablePoint),
        at_rate: [f64; 2],
        parts_rate: [f64; DIRECTIONS],
    ) -> Option<PointRate> {
        let [by_u, by_z] = self.lines.get(patch)?.weight_slopes(at);
        let moved = |b: usize, a: usize| by_u[b][a] * at_rate[0] + by_z[b][a] * at_rate[1];
        let moved: [[f64; RUN]; RUNS] = std::array::from_fn(|b| std::array::from_fn(|a| moved(b, a)));
        let of = |d: usize, b: usize, a: usize| moved[b][a] * point.parts[d] + point.weights[b][a] * parts_rate[d];
        Some(std::array::from_fn(|d| std::array::from_fn(|b| std::array::from_fn(|a| of(d, b, a)))))
    }

    /// S between two places, mm/N.
    pub(crate) fn entry(&self, first: &TablePoint, second: &TablePoint) -> f64 {
        let count = self.points() / DIRECTIONS;
        let at = |[d, q]: [usize; 2], [e, p]: [usize; 2]| match &self.entries {
            Entries::Whole(table) => table.at([d, e], q, p),
            Entries::Layers(layers) => layers.at(d * count + q, e * count + p),
        };
        let between = |e: usize, d: usize| {
            let opening = |q: usize| first.each().map(|(p, w)| w * at([d, q], [e, p])).sum::<f64>();
            second.each().map(|(q, w)| w * opening(q)).sum::<f64>()
        };
        (0..DIRECTIONS * DIRECTIONS)
            .map(|i| (i % DIRECTIONS, i / DIRECTIONS, first.parts[i % DIRECTIONS] * second.parts[i / DIRECTIONS]))
            .filter(|(_, _, part)| *part != 0.0)
            .map(|(e, d, part)| part * between(e, d))
            .sum()
    }
}

/// First point of each patch, and the number of all.
fn first_points(lines: &[FlankGridLines]) -> Vec<usize> {
    let mut first = vec![0];
    lines.iter().for_each(|l| first.push(first.last().map_or(0, |f| f + l.count())));
    first
}

impl TablePoint {
    /// Number of points that it stands on: 12 for each direction that it is loaded along.
    pub(crate) fn points(&self) -> usize {
        RUN * RUNS * self.parts.iter().filter(|part| **part != 0.0).count()
    }

    /// Opening (mm) at this place by a displacement sampled at the table's points.
    pub(crate) fn read(&self, samples: &[f64]) -> f64 {
        let along = |of_direction: &[f64]| self.each().map(|(p, w)| w * of_direction[p]).sum::<f64>();
        let all = samples.chunks_exact(samples.len() / DIRECTIONS);
        self.parts.iter().zip(all).filter(|(part, _)| **part != 0.0).map(|(part, of)| part * along(of)).sum()
    }

    /// Points and their weights.
    fn each(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let runs = self.runs.iter().zip(&self.weights);
        runs.flat_map(|(&first, weights)| (first as usize..).zip(weights.iter().copied()))
    }
}
