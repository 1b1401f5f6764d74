//! Normal modes of both gears on the slices of a window. Theory (61).

use faer::Mat;
use reduction::{ElasticGear, GearModes};

use crate::{ContactError, ContactSet, TablePoint, complementarity::DenseSolver, nodal::ContactRow, opening};

/// Modes of both gears on the rows of a contact.
///
/// ```text
/// g_i = g0_i + H_i q + sum_j R_ij F_j + delta_i(F_i),   R = S - H Omega^-2 H_t',   H = A Phi_B
/// forces on the modes: H_t' F
/// ```
/// S is the compliance of the slices: the share of the kept modes responds with their inertia, the rest statically. H_t
/// is H for loads, friction included.
#[derive(Debug)]
pub struct ModalFlanks {
    /// Modes of either gear.
    counts: [usize; 2],
    /// omega^-2, s^2.
    flexibility: Vec<f64>,
    shapes: [Shapes; 2],
    /// q, mm t^(1/2).
    amplitudes: Vec<f64>,
    /// Largest opening of a gap by q, mm.
    largest: f64,
    /// Largest opening of a gap by a unit of each mode.
    sizes: Vec<f64>,
    forces: ModalForces,
}

/// How the modes open the rows that were found at some poses.
#[derive(Debug, Default)]
pub(crate) struct ModalRows {
    /// Opening by all modes up to which no further row may close, mm.
    pub largest: f64,
    /// Modes of both gears, m.
    count: usize,
    /// H and, with friction, H_t; row by row.
    openings: Vec<f64>,
    loads: Vec<f64>,
}

impl ModalRows {
    /// H_i.
    fn opening(&self, row: usize) -> &[f64] {
        &self.openings[row * self.count..(row + 1) * self.count]
    }

    /// H_t,i.
    fn load(&self, row: usize) -> &[f64] {
        let list = if self.loads.is_empty() { &self.openings } else { &self.loads };
        &list[row * self.count..(row + 1) * self.count]
    }
}

/// Forces on the modes, and the derivatives of these and of the forces on the rigid bodies by all coordinates.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ModalForces {
    /// H' F, mm N / (mm t^(1/2)).
    pub normal: Vec<f64>,
    /// (H_t - H)' F.
    pub friction: Vec<f64>,
    /// Tangent df/dq, (12 + m) x (12 + m), row by row: rigid coordinates, then modes of pinion and wheel.
    pub tangent: Vec<f64>,
}

/// Shapes on the boundary of one gear.
#[derive(Debug)]
enum Shapes {
    /// Mode shapes at the points of the gear's table, mode by mode.
    Table(Vec<Vec<f64>>),
    /// Phi_B.
    Nodes(Mat<f64>),
}

impl ModalFlanks {
    /// Takes the modes to the flanks of a window.
    ///
    /// # Errors
    /// [`ContactError::Reduction`] for modes of another gear; [`ContactError::ModesOnFullGear`] for gears with all
    /// their degrees of freedom.
    pub fn new(gears: &[ElasticGear; 2], modes: [&GearModes; 2], set: &ContactSet) -> Result<Self, ContactError> {
        let shapes = |g: usize| -> Result<Shapes, ContactError> {
            let (ElasticGear::Reduced(reducer), Some(windows)) = (&gears[g], set.windows()) else {
                return Err(ContactError::ModesOnFullGear { gear: ["pinion", "wheel"][g] });
            };
            let fail = |source| ContactError::Reduction { gear: ["pinion", "wheel"][g], source };
            let on_nodes = modes[g].on_window(reducer, &windows[g]).map_err(fail)?;
            Ok(match set.slices().and_then(|s| s.bulk()) {
                None => Shapes::Nodes(on_nodes),
                Some(tables) => {
                    let columns: Vec<&[f64]> = (0..on_nodes.ncols()).map(|j| on_nodes.col_as_slice(j)).collect();
                    Shapes::Table(tables[g].sample(&set.patches()[g], &columns))
                }
            })
        };
        let counts = modes.map(GearModes::count);
        let flexibility: Vec<f64> = modes.iter().flat_map(|m| m.squares()).map(|s| 1.0 / s).collect();
        let m = flexibility.len();
        let shapes = [shapes(0)?, shapes(1)?];
        Ok(Self {
            sizes: sizes(&shapes, counts),
            shapes,
            counts,
            flexibility,
            amplitudes: vec![0.0; m],
            largest: 0.0,
            forces: ModalForces::default(),
        })
    }

    /// Number of modes of both gears.
    pub fn count(&self) -> usize {
        self.flexibility.len()
    }

    /// Sets the amplitudes q.
    pub fn deform(&mut self, amplitudes: &[f64]) {
        self.amplitudes.copy_from_slice(amplitudes);
        let (first, second) = amplitudes.split_at(self.counts[0]);
        self.largest = self.shapes[0].largest(first) + self.shapes[1].largest(second);
    }

    /// Largest change of a gap by q, either sign, mm.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// The amplitudes q.
    pub fn amplitudes(&self) -> &[f64] {
        &self.amplitudes
    }

    /// Largest normal displacement of a flank per unit of each mode. A mode that does not move the flanks of this
    /// window gets a tenth of the value of the others.
    pub fn sizes(&self) -> &[f64] {
        &self.sizes
    }

    /// Makes room for some rows that serve until modes open gaps by more than `largest` (mm).
    pub(crate) fn begin(&self, of: &mut ModalRows, rows: usize, friction: bool, largest: f64) {
        (of.count, of.largest) = (self.count(), largest);
        for (list, used) in [(&mut of.openings, true), (&mut of.loads, friction)] {
            list.clear();
            list.resize(if used { rows * of.count } else { 0 }, 0.0);
        }
    }

    /// Takes the openings of a gear's places in its table, or its loads.
    pub(crate) fn read_places(&self, of: &mut ModalRows, gear: usize, places: &[TablePoint], loads: bool) {
        let (m, start) = (self.count().max(1), if gear == 0 { 0 } else { self.counts[0] });
        let Shapes::Table(samples) = &self.shapes[gear] else { return };
        let list = if loads { &mut of.loads } else { &mut of.openings };
        for (row, place) in list.chunks_mut(m).zip(places) {
            row[start..].iter_mut().zip(samples).for_each(|(h, s)| *h = place.read(s));
        }
    }

    /// Takes the openings and loads of rows from the nodes that they rest on.
    pub(crate) fn read_rows(&self, of: &mut ModalRows, rows: &[ContactRow]) {
        let m = self.count();
        for (i, row) in rows.iter().enumerate() {
            for (g, start) in [(0, 0), (1, self.counts[0])] {
                let Shapes::Nodes(shapes) = &self.shapes[g] else { continue };
                let support = &row.supports[g];
                let load = crate::nodal::Support { direction: support.load, ..*support };
                for j in 0..shapes.ncols() {
                    let at = i * m + start + j;
                    of.openings[at] = opening(support, shapes.col_as_slice(j));
                    if let Some(h) = of.loads.get_mut(at) {
                        *h = opening(&load, shapes.col_as_slice(j));
                    }
                }
            }
        }
    }

    /// Gaps of the rows with the modes at other amplitudes.
    pub(crate) fn bend_by(&self, of: &ModalRows, amplitudes: &[f64], rows: &mut [ContactRow]) {
        rows.iter_mut().enumerate().for_each(|(i, row)| row.gap += dot(of.opening(i), amplitudes));
    }

    /// H_i q, mm.
    pub(crate) fn shift(&self, of: &ModalRows, row: usize) -> f64 {
        dot(of.opening(row), &self.amplitudes)
    }

    /// Subtracts the modes' share from the compliance S, which becomes R: n x n, column by column.
    pub(crate) fn take_from(&self, of: &ModalRows, n: usize, compliance: &mut [f64]) {
        let mut flexible = vec![0.0; self.count()];
        for (j, column) in compliance.chunks_mut(n.max(1)).enumerate() {
            let shares = of.load(j).iter().zip(&self.flexibility);
            flexible.iter_mut().zip(shares).for_each(|(f, (l, c))| *f = l * c);
            column.iter_mut().enumerate().for_each(|(i, entry)| *entry -= dot(of.opening(i), &flexible));
        }
    }

    /// Forces on the modes from a solution.
    pub(crate) fn sum_forces(&mut self, of: &ModalRows, solver: &DenseSolver) {
        let m = self.count();
        let forces = &mut self.forces;
        for list in [&mut forces.normal, &mut forces.friction] {
            list.clear();
            list.resize(m, 0.0);
        }
        for (i, &f) in solver.forces().iter().enumerate().filter(|(_, f)| **f != 0.0) {
            let (opening, load) = (of.opening(i), of.load(i));
            for k in 0..m {
                forces.normal[k] += f * opening[k];
                forces.friction[k] += f * (load[k] - opening[k]);
            }
        }
    }

    /// All tangents from a solution; `rigid(i)`: J and J_t of the rigid coordinates.
    pub(crate) fn find_tangent(
        &mut self,
        of: &ModalRows,
        solver: &mut DenseSolver,
        rigid: impl Fn(usize) -> [[f64; 12]; 2],
    ) {
        let n = 12 + self.count();
        let mut tangent = std::mem::take(&mut self.forces.tangent);
        tangent.resize(n * n, 0.0);
        let fill = |i: usize, opening: &mut [f64], load: &mut [f64]| {
            let [j, j_t] = rigid(i);
            opening[..12].copy_from_slice(&j);
            opening[12..].copy_from_slice(of.opening(i));
            load[..12].copy_from_slice(&j_t);
            load[12..].copy_from_slice(of.load(i));
        };
        solver.tangent_of(&mut vec![0.0; 2 * n], fill, &mut tangent);
        self.forces.tangent = tangent;
    }

    /// Takes tangents that `ModalFlanks::find_tangent` once found.
    pub(crate) fn take_tangent(&mut self, tangent: &[f64]) {
        self.forces.tangent.clear();
        self.forces.tangent.extend_from_slice(tangent);
    }

    /// Forces on the modes in the last solution.
    pub fn forces(&self) -> &ModalForces {
        &self.forces
    }
}

fn sizes(shapes: &[Shapes; 2], counts: [usize; 2]) -> Vec<f64> {
    let of_gear = |g: usize| {
        let unit = move |j: usize| (0..counts[g]).map(|k| f64::from(u8::from(k == j))).collect::<Vec<_>>();
        (0..counts[g]).map(move |j| shapes[g].largest(&unit(j)))
    };
    let all: Vec<f64> = (0..2).flat_map(of_gear).collect();
    let largest = all.iter().fold(0.0f64, |m, s| m.max(*s));
    // Nothing moves where no flank is: any size will do.
    let least = if largest > 0.0 { 0.1 * largest } else { 1.0 };
    all.into_iter().map(|s| s.max(least)).collect()
}

impl Shapes {
    /// Largest displacement that some amplitudes make: normal to the flanks, or in any direction.
    fn largest(&self, amplitudes: &[f64]) -> f64 {
        match self {
            Self::Table(samples) => {
                // The first third of the points is along the normals.
                let normals = samples.first().map_or(0, |s| s.len() / 3);
                let at = |p: usize| samples.iter().zip(amplitudes).map(|(s, a)| s[p] * a).sum::<f64>().abs();
                (0..normals).map(at).fold(0.0, f64::max)
            }
            Self::Nodes(shapes) => {
                let at = |row: usize| amplitudes.iter().enumerate().map(|(j, a)| shapes[(row, j)] * a).sum::<f64>();
                let node = |i: usize| (0..3).map(|axis| at(3 * i + axis).powi(2)).sum::<f64>().sqrt();
                (0..shapes.nrows() / 3).map(node).fold(0.0, f64::max)
            }
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
