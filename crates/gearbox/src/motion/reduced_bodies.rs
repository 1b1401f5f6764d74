//! Moving shafts with few coordinates: component mode synthesis after Craig and Bampton. Theory (91).

use std::ops::Range;

use fem::{Condensation, Modes, natural_modes};
use nalgebra::{DMatrix, DVector};
use reduction::GearModes;

use crate::{Assembly, GearboxError, whirl::told_from_round_off};

/// Modes of shafts with their seats held are kept up to so many times the frequency that is asked for, at first: the usual
/// rule, which says nothing of seats that carry gears.
const BEYOND: f64 = 2.0;
/// Relative error of natural frequencies up to there beyond which more modes are kept.
const GOOD: f64 = 5e-3;

/// Limit at which the search for more modes ends.
const MOST: f64 = 1e9;

/// Matrices of shafts, discs and bearings in reduced coordinates y.
///
/// ```text
/// q = T y_seats + Phi y_modes,   T: how all nodes follow the seats at rest,   K_ii Phi = M_ii Phi omega^2,  omega <= 2 omega_max, and more
/// ```
/// Seats are the nodes of all discs and bearings, with six coordinates each. Coordinates on which forces act are not
/// reduced.
#[derive(Debug, Clone)]
pub struct ReducedBodies {
    /// First coordinate of the seats' nodes among those of the assembly, ascending, and the shaft of each.
    nodes: Vec<(usize, usize)>,
    /// Shaft of each mode, of shafts and then of gears.
    modes: Vec<usize>,
    /// Coordinates of each gear whose modes move, and what a turn of its disc by a radian adds to them.
    gears: Vec<(Range<usize>, Vec<f64>)>,
    basis: DMatrix<f64>,
    pub(super) mass: DMatrix<f64>,
    pub(super) stiffness: DMatrix<f64>,
    pub(super) damping: DMatrix<f64>,
    certificate: ReductionCertificate,
}

/// Accuracy of the reduced coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReductionCertificate {
    /// Number of coordinates of the full model, and of the reduced model.
    pub coordinates: [usize; 2],
    /// Number of retained shaft modes, with the seats held.
    pub modes: usize,
    /// Frequency limit requested, rad/s.
    pub limit: f64,
    /// Number of natural frequencies up to the limit, without meshes and without spin, that were compared with those of
    /// the full model.
    pub compared: usize,
    /// Largest relative difference among them.
    pub error: f64,
}

impl ReducedBodies {
    /// Reduces an assembly whose shafts `held` neither bend nor shift. Natural frequencies up to `limit` (rad/s) are
    /// compared with those of the full model, and modes are added until the difference is at most half a per cent.
    ///
    /// # Errors
    /// [`GearboxError::OutOfRange`] for a limit that is not above 0, [`GearboxError::Matrix`] if a coordinate has
    /// neither mass nor stiffness.
    pub fn new(assembly: &Assembly, held: &[bool], limit: f64) -> Result<Self, GearboxError> {
        if !(limit > 0.0 && limit.is_finite()) {
            let quantity = "highest frequency, rad/s";
            return Err(GearboxError::OutOfRange { part: "the motion".into(), quantity, value: limit });
        }
        let mut beyond = BEYOND;
        loop {
            let (bodies, is_all) = Self::with_modes(assembly, held, [limit, beyond * limit])?;
            if bodies.certificate.error <= GOOD || is_all || beyond > MOST {
                return Ok(bodies);
            }
            beyond *= 2.0;
        }
    }

    /// Bodies with the modes up to a frequency, and whether these are all modes.
    fn with_modes(
        assembly: &Assembly,
        held: &[bool],
        [limit, highest]: [f64; 2],
    ) -> Result<(Self, bool), GearboxError> {
        let mut is_all = true;
        let nodes = assembly.seat_nodes();
        let kept: Vec<usize> = nodes.iter().flat_map(|(n, _)| *n..*n + 6).collect();
        let (k, m) = (assembly.stiffness_without_meshes(), assembly.mass());
        let condensation = Condensation::new(&k, &kept)?;
        let mut columns: Vec<DVector<f64>> = Vec::new();
        let mut modes = Vec::new();
        for (shaft, (at, line)) in assembly.lines().enumerate().filter(|(s, _)| !held[*s]) {
            let inner: Vec<usize> = (at..at + line.mass.nrows()).filter(|i| !kept.contains(i)).collect();
            if inner.is_empty() {
                continue;
            }
            let Modes { frequencies, shapes } = natural_modes(&block(&k, &inner), &block(&m, &inner))?;
            is_all &= frequencies.iter().all(|w| *w <= highest);
            for (i, _) in frequencies.iter().enumerate().filter(|(_, w)| **w <= highest) {
                let mut column = DVector::zeros(assembly.size());
                inner.iter().enumerate().for_each(|(row, &at)| column[at] = shapes[(row, i)]);
                columns.push(column);
                modes.push(shaft);
            }
        }
        let seats = kept.len();
        let basis = DMatrix::from_fn(assembly.size(), seats + columns.len(), |i, j| {
            if j < seats { condensation.map[(i, j)] } else { columns[j - seats][i] }
        });
        let of = |matrix: &DMatrix<f64>| {
            let raw = basis.transpose() * matrix * &basis;
            0.5 * (&raw + raw.transpose())
        };
        let (mass, stiffness, damping) = (of(&m), of(&k), of(&assembly.damping()));
        let coordinates = [assembly.size(), basis.ncols()];
        let certificate = ReductionCertificate { coordinates, modes: modes.len(), limit, compared: 0, error: 0.0 };
        let mut bodies = Self { nodes, modes, gears: Vec::new(), basis, mass, stiffness, damping, certificate };
        // Of shafts that are rigid bodies nothing is left out.
        if assembly.size() > 6 * assembly.structure().shafts.len() {
            bodies.compare(assembly, held, [&k, &m])?;
        }
        Ok((bodies, is_all))
    }

    /// Holds natural frequencies against those of all nodes; held shafts are left out on both sides.
    fn compare(&mut self, assembly: &Assembly, held: &[bool], [k, m]: [&DMatrix<f64>; 2]) -> Result<(), GearboxError> {
        let limit = self.certificate.limit;
        let frequencies = |k: DMatrix<f64>, m: DMatrix<f64>| -> Result<Vec<f64>, GearboxError> {
            if k.is_empty() { Ok(Vec::new()) } else { Ok(natural_modes(&k, &m)?.frequencies) }
        };
        let free = |shaft: &usize| !held[*shaft];
        let ranges = assembly.lines().map(|(at, line)| at..at + line.mass.nrows()).enumerate();
        let all: Vec<usize> = ranges.filter(|(shaft, _)| free(shaft)).flat_map(|(_, own)| own).collect();
        let own: Vec<usize> = (0..self.size()).filter(|i| free(&self.shaft(*i))).collect();
        let whole = frequencies(block(k, &all), block(m, &all))?;
        let few = frequencies(block(&self.stiffness, &own), block(&self.mass, &own))?;
        // Turns of the shafts are free; what is left of their squares is round-off of the highest. Both have them.
        let rigid = assembly.rigid_motions(|shaft| if held[shaft] { 0..0 } else { 0..6 }, false);
        told_from_round_off(&whole, rigid)?;
        let below = whole.iter().skip(rigid).take_while(|w| **w <= limit).count();
        let pairs = whole.iter().enumerate().skip(rigid).take(below);
        let errors = pairs.map(|(i, w)| few.get(i).map_or(1.0, |f| (f / w - 1.0).abs()));
        self.certificate.error = errors.fold(0.0, f64::max);
        self.certificate.compared = below;
        Ok(())
    }

    /// The bodies with the modes of gears as coordinates P behind all others: unit mass, and what they share of the inertia
    /// of their discs taken off there. Theory (93b).
    ///
    /// `gears`: disc and modes of each.
    pub(super) fn with_gears<'a>(
        mut self,
        assembly: &Assembly,
        gears: impl Iterator<Item = (usize, &'a GearModes)>,
    ) -> Self {
        for (disc, modes) in gears {
            let (n, m) = (self.size(), modes.count());
            let shaft = assembly.structure().discs[disc].shaft;
            let disc = self.of_node(assembly.disc(disc).unwrap_or(0));
            let mut block = self.mass.fixed_view_mut::<6, 6>(disc, disc);
            block -= modes.shared_inertia();
            for matrix in [&mut self.mass, &mut self.stiffness, &mut self.damping] {
                matrix.resize_mut(n + m, n + m, 0.0);
            }
            (n..n + m).for_each(|i| self.mass[(i, i)] = 1.0);
            self.basis.resize_horizontally_mut(n + m, 0.0);
            self.modes.extend(std::iter::repeat_n(shaft, m));
            self.gears.push((n..n + m, modes.coupling().iter().map(|own| own[5]).collect()));
        }
        self
    }

    /// Coordinates of the modes of a gear, in the order in which they came.
    pub(super) fn of_gear(&self, gear: usize) -> Range<usize> {
        self.gears.get(gear).map_or(0..0, |(own, _)| own.clone())
    }

    /// What a turn of its gear by a radian adds to a coordinate that is a gear's mode; `None` for others.
    pub(super) fn by_turn(&self, coordinate: usize) -> Option<f64> {
        let own = self.gears.iter().find(|(own, _)| own.contains(&coordinate));
        own.map(|(own, by_turn)| by_turn[coordinate - own.start])
    }

    /// Accuracy compared with the full model.
    pub fn certificate(&self) -> &ReductionCertificate {
        &self.certificate
    }

    /// Number of coordinates y.
    pub fn size(&self) -> usize {
        self.basis.ncols()
    }

    /// Shaft that a coordinate belongs to.
    pub(super) fn shaft(&self, coordinate: usize) -> usize {
        match self.nodes.get(coordinate / 6) {
            Some((_, shaft)) => *shaft,
            None => self.modes[coordinate - 6 * self.nodes.len()],
        }
    }

    /// Which of the six coordinates of a node this one is; `None` for modes.
    pub(super) fn axis(&self, coordinate: usize) -> Option<usize> {
        (coordinate < 6 * self.nodes.len()).then_some(coordinate % 6)
    }

    /// First coordinate of a node of the assembly.
    pub(super) fn of_node(&self, node: usize) -> usize {
        6 * self.nodes.iter().position(|(n, _)| *n == node).unwrap_or(0)
    }

    /// Forces of preloaded bearings on the coordinates.
    pub(super) fn preload(&self, assembly: &Assembly) -> DVector<f64> {
        self.of_forces(&assembly.preload())
    }

    /// How a turn of the frame by a radian moves the coordinates: J of the places of all axes, mm.
    pub(super) fn by_frame(&self, assembly: &Assembly) -> DVector<f64> {
        let places_of_axes = assembly.places_of_axes();
        let mut all = DVector::zeros(self.size());
        for (i, (node, _)) in self.nodes.iter().enumerate() {
            // Nodes within shafts follow their seats.
            (all[6 * i], all[6 * i + 1]) = (-places_of_axes[node + 1], places_of_axes[*node]);
        }
        all
    }

    /// A matrix of all nodes in reduced coordinates.
    pub(super) fn of_nodes(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        self.basis.transpose() * matrix * &self.basis
    }

    /// Forces on all nodes on the coordinates.
    pub(super) fn of_forces(&self, forces: &DVector<f64>) -> DVector<f64> {
        self.basis.tr_mul(forces)
    }

    /// A matrix of all nodes in reduced coordinates; skew-symmetric ones stay so to the last bit.
    pub(super) fn skew(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let raw = self.of_nodes(matrix);
        0.5 * (&raw - raw.transpose())
    }
}

fn block(matrix: &DMatrix<f64>, of: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(of.len(), of.len(), |i, j| matrix[(of[i], of[j])])
}
