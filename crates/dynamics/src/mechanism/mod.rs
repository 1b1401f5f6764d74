//! Equations of motion of a pair. Theory (45).

mod balance;
mod build;
mod extremes;
mod memory;
mod observe;

use std::ops::Deref;

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::{
    COORDINATES, Extremes, FlankStates, MeshDamping, MeshResonance, PairBodies, Speed, ToothChanges, Torque,
    elastic_displacement::ElasticDisplacement,
    equivalent_mass::equivalent_mass,
    mesh_flanks::MeshFlanks,
    mesh_side::{MeshSide, SideContacts},
    modal::Modal,
};
use build::per_length;
use ltca::{RootStress, StaticError};

/// A pair of gears as an integrator sees it: bodies with elastic flanks between them.
///
/// ```text
/// M q'' = T' [w(d) + w_f(d) + w_d(d, d') - K_b d - C_b d' + gyroscopic + load + drive - M a_nominal],   d = T q
/// V = strain energy of teeth and bodies + d' K_b d / 2
/// ```
/// w normal contact forces on both gears and w_f, w_d friction and mesh damping; all elasticity is quasi-static in w. With
/// [`PairMechanism::with_modes`] coordinates of normal modes of both gears come behind the rigid ones.
#[derive(Debug)]
pub struct PairMechanism {
    bodies: PairBodies,
    mass: DMatrix<f64>,
    flanks: MeshFlanks,
    /// Mesh damping per length of contact line, N s/mm^2.
    damping: f64,
    /// Stiffness (N/mm) and length of contact lines (mm) that damping refers to.
    means: [f64; 2],
    modal: Option<Modal>,
    extremes: Extremes,
    /// Work that the load took from the driven gear in its nominal motion, over the cycles so far, N mm.
    throughput: f64,
    /// Fillets, where their stress is asked for; none with normal modes.
    roots: Option<RootStress>,
}

/// Windows of both sides and extremes so far. With an [`integrate::State`] this is the whole state of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MechanismState {
    /// Windows of both sides.
    pub flanks: FlankStates,
    /// Gathered so far.
    pub extremes: Extremes,
    /// Work that the load took from the driven gear in its nominal motion so far, N mm: what goes through the pair.
    pub throughput: f64,
}

/// What its bodies alone answer, the pair answers.
impl Deref for PairMechanism {
    type Target = PairBodies;

    fn deref(&self) -> &PairBodies {
        &self.bodies
    }
}

impl PairMechanism {
    /// Extremes since the start.
    pub fn extremes(&self) -> &Extremes {
        &self.extremes
    }

    /// Work that the load took from the driven gear in its nominal motion, over all cycles, N mm: what goes through the
    /// pair.
    pub fn throughput(&self) -> f64 {
        self.throughput
    }

    /// Whether the coast flanks may touch.
    pub fn has_coast_flanks(&self) -> bool {
        self.flanks.has_coast_flanks()
    }

    /// Tooth changes of the driving flanks.
    pub fn changes(&self) -> ToothChanges {
        self.flanks.changes()
    }

    /// Mean stiffness of the mesh, N/mm on the base circle.
    pub(crate) fn mean_stiffness(&self) -> f64 {
        self.means[0]
    }

    /// Frequency of the two gears turning against each other on their teeth, Hz: sqrt(k_m / m_e) / 2 pi with the mean
    /// tangent stiffness.
    pub fn mesh_resonance_hz(&self) -> f64 {
        (self.means[0] / self.equivalent_mass()).sqrt() / std::f64::consts::TAU
    }

    /// Frequencies of [`Self::mesh_resonance_hz`] with both gears free, and with the driver's angle prescribed, Hz: the
    /// drive decides which inertia counts.
    pub fn mesh_resonances_hz(&self) -> [f64; 2] {
        let inertia = self.base_circle_masses();
        let driver = 1 - self.options.statics.driven();
        [None, Some(driver)].map(|held| (self.means[0] / equivalent_mass(inertia, held)).sqrt() / std::f64::consts::TAU)
    }

    /// The mesh resonance with the damping ratio of the mesh: c / 2 sqrt(k_m m_e), c of the mean length of contact
    /// lines.
    pub fn mesh_resonance(&self) -> MeshResonance {
        let cos = self.pair.base_helix_angle().cos();
        let damping =
            self.damping * self.means[1] * cos * cos / (2.0 * (self.means[0] * self.equivalent_mass()).sqrt());
        MeshResonance { hz: self.mesh_resonance_hz(), damping }
    }

    /// Number of all coordinates: free rigid ones, then normal modes of pinion and wheel.
    pub fn count(&self) -> usize {
        self.mass.nrows()
    }

    /// Frequencies of the kept modes with the bores held, Hz, pinion's first; empty without modes.
    pub fn mode_frequencies_hz(&self) -> Vec<f64> {
        self.modal.as_ref().map_or(Vec::new(), Modal::frequencies_hz)
    }

    /// Sizes of all coordinates from those of the rigid ones: a mode's is what moves a flank by `length` (mm).
    pub fn scales(&self, rigid: &DVector<f64>, length: f64) -> DVector<f64> {
        let sizes = self.flanks.driving.contact().modal().map_or(&[][..], |modal| modal.sizes());
        let modes = sizes.iter().map(|s| length / s);
        DVector::from_iterator(rigid.len() + sizes.len(), rigid.iter().copied().chain(modes))
    }

    /// Size of a displacement at the flanks that counts as large, mm: how far the driven gear lags at rest (`lag`, mm), or
    /// as much as its load deflects the mesh where that is more.
    ///
    /// ```text
    /// max(|lag|, T / (r_b k_m))
    /// ```
    /// A lag is a place, which misalignment and micro-geometry move through zero and below it; a deflection is a size.
    pub fn motion_size(&self, lag: f64) -> f64 {
        let statics = &self.options.statics;
        let driven = [&self.pair.pinion, &self.pair.wheel][statics.driven()];
        let deflection = statics.torque.abs() / (driven.base_radius() * self.means[0]);
        // Gears without stiffness or load have no deflection.
        if deflection.is_finite() { lag.abs().max(deflection) } else { lag.abs() }
    }

    /// Map of the coordinates of a periodic motion from one mesh cycle to the next, n x n. Rigid coordinates repeat.
    /// Amplitudes of modes are in the gears' own frames: they become those of gears turned by a pitch. `None` where the
    /// modes of a gear are not mapped into each other; such a motion repeats after whole turns at best.
    pub(crate) fn over_a_pitch(&self) -> Option<DMatrix<f64>> {
        let (n, rigid) = (self.count(), self.coordinates.count());
        let mut all = DMatrix::identity(n, n);
        if let Some(modal) = &self.modal {
            let turn = modal.turned_by_a_pitch(self.options.statics.contact.sense.sign() as f64)?;
            all.view_mut((rigid, rigid), (n - rigid, n - rigid)).copy_from(&turn);
        }
        Some(all)
    }

    /// Whether normal modes are among the coordinates.
    pub(crate) fn has_modes(&self) -> bool {
        self.modal.is_some()
    }

    /// Whether flanks of teeth of a gear have forms of their own.
    pub(crate) fn has_own_flanks(&self) -> bool {
        [&self.pair.pinion, &self.pair.wheel].iter().any(|gear| gear.has_own_flanks())
    }

    /// Driving flanks, and coast flanks where these may touch.
    pub(crate) fn sides(&self) -> impl Iterator<Item = &MeshSide> {
        self.flanks.sides()
    }

    /// Puts the mean of the load in its place; gives the load.
    pub(crate) fn hold_mean_load(&mut self) -> Torque {
        self.bodies.hold_mean_load()
    }

    /// Puts a load on the driven gear, N mm against its turn.
    pub fn set_load(&mut self, load: Torque) {
        self.bodies.options.load = load;
    }

    /// Gives the driver another speed, rad/s.
    pub fn set_speed(&mut self, speed: Speed) {
        self.bodies.nominal.speed = speed;
    }

    /// Damps the mesh otherwise; a ratio refers to the means that the pair was made with.
    pub fn set_damping(&mut self, damping: MeshDamping) {
        self.bodies.options.damping = damping;
        self.damping = per_length(&self.bodies, self.means);
    }

    /// The pair at its start under the mean of its load.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn under_mean_load(&self) -> Result<Self, StaticError> {
        let mut pair = self.with_drive(self.options.drive.clone())?;
        pair.hold_mean_load();
        Ok(pair)
    }

    /// Mesh damping per length of contact line, N s/mm^2.
    pub(crate) fn damping_per_length(&self) -> f64 {
        self.damping
    }

    /// L D of the modes at time `t`; no rows without modes.
    fn coupling(&self, t: f64) -> DMatrix<f64> {
        match &self.modal {
            None => DMatrix::zeros(0, 2 * COORDINATES),
            Some(modal) => modal.coupling(self.flanks.driving.angles(&self.pair, self.cycles(t))),
        }
    }

    /// Coordinates with all modes at rest, p = L D d.
    pub(crate) fn stiffened(&self, t: f64, mut q: DVector<f64>) -> DVector<f64> {
        let (d, rigid) = (self.coordinates().displacement(&q), self.coordinates().count());
        q.rows_mut(rigid, self.count() - rigid).copy_from(&(self.coupling(t) * d));
        q
    }

    /// Displacements and amplitudes of the modes from coordinates, and the same for velocities.
    fn elastic_displacement(&self, t: f64, q: &DVector<f64>) -> ElasticDisplacement {
        let d = self.coordinates.displacement(q);
        let q = match &self.modal {
            None => DVector::zeros(0),
            Some(modal) => modal.amplitudes(&self.coupling(t), &d, &q.as_slice()[self.coordinates.count()..]),
        };
        ElasticDisplacement { d, q }
    }

    /// Contact of both sides.
    fn contact(&mut self, t: f64, at: &ElasticDisplacement, tangents: bool) -> Result<SideContacts, StaticError> {
        let cycles = self.cycles(t);
        self.flanks.contact(&self.bodies.pair, cycles, at, tangents)
    }
}
