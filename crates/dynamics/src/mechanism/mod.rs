//! Equations of motion of a pair. Theory (45).

mod balance;
mod build;
mod external;
mod extremes;
mod memory;
mod observe;

use geometry::GearPair;
use nalgebra::{DMatrix, DVector, SMatrix};
use serde::{Deserialize, Serialize};

use super::{
    COORDINATES, Coordinates, Displacement, Extremes, FlankStates, MeshDamping, MeshResonance, MotionOptions, Nominal,
    NominalState, Speed, ToothChanges, Torque,
    elastic_displacement::ElasticDisplacement,
    equivalent_mass::{damping_per_length, equivalent_mass, equivalent_mass_of, masses_on_base_circles},
    mesh_flanks::MeshFlanks,
    mesh_side::{MeshSide, SideContacts},
    modal::Modal,
    nominal::running_senses,
};
use ltca::{RootStress, StaticError};

/// A pair of gears as an integrator sees it.
///
/// ```text
/// M q'' = T' [w(d) + w_f(d) + w_d(d, d') - K_b d - C_b d' + gyroscopic + load + drive - M a_nominal],   d = T q
/// V = strain energy of teeth and bodies + d' K_b d / 2
/// ```
/// w normal contact forces on both gears and w_f, w_d friction and mesh damping; all elasticity is quasi-static in w.
/// Coordinates are deviations from the nominal motion, in which rigid gears turn in the ratio of their teeth. With
/// [`PairMechanism::with_modes`] coordinates of normal modes of both gears come behind the rigid ones.
#[derive(Debug)]
pub struct PairMechanism {
    pair: GearPair,
    options: MotionOptions,
    coordinates: Coordinates,
    mass: DMatrix<f64>,
    nominal: Nominal,
    flanks: MeshFlanks,
    bearing: [SMatrix<f64, 12, 12>; 2],
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

    /// Options of the motion.
    pub fn options(&self) -> &MotionOptions {
        &self.options
    }

    /// Frequency of the two gears turning against each other on their teeth, Hz: sqrt(k_m / m_e) / 2 pi with the mean
    /// tangent stiffness.
    pub fn mesh_resonance_hz(&self) -> f64 {
        (self.means[0] / equivalent_mass_of(&self.pair, &self.options)).sqrt() / std::f64::consts::TAU
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

    /// Inertias of pinion and wheel on their base circles, J / r_b^2, t.
    pub fn base_circle_masses(&self) -> [f64; 2] {
        masses_on_base_circles(&self.pair, &self.options.bodies)
    }

    /// Inertia that vibrates on the mesh, t: of both gears, or of the driven one alone where the driver's angle is
    /// prescribed.
    pub fn equivalent_mass(&self) -> f64 {
        equivalent_mass_of(&self.pair, &self.options)
    }

    /// Free coordinates.
    pub fn coordinates(&self) -> &Coordinates {
        &self.coordinates
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
        let sizes = self.flanks.mode_sizes();
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
        let deflection = statics.torque.abs() / (driven.base_radius().abs() * self.means[0]);
        // Gears without stiffness or load have no deflection.
        if deflection.is_finite() { lag.abs().max(deflection) } else { lag.abs() }
    }

    /// Map of the coordinates of a periodic motion at the end of so many mesh cycles to those at their beginning, n x n. Rigid
    /// coordinates repeat. Amplitudes of modes are in the gears' own frames: they become those of gears turned back by as
    /// many pitches. `None` where the modes of a gear are not mapped into each other; such a motion repeats after whole
    /// turns at best.
    pub(crate) fn back_over(&self, cycles: u64) -> Option<DMatrix<f64>> {
        let (n, rigid) = (self.count(), self.coordinates.count());
        let mut all = DMatrix::identity(n, n);
        if let Some(modal) = &self.modal {
            let teeth = running_senses(&self.pair, &self.options.statics).map(|sense| -(sense * cycles as f64) as i64);
            let turn = modal.turned_by_teeth(teeth)?;
            all.view_mut((rigid, rigid), (n - rigid, n - rigid)).copy_from(&turn);
        }
        Some(all)
    }

    /// Nominal motion.
    pub fn nominal(&self) -> &Nominal {
        &self.nominal
    }

    /// The flanks of its teeth.
    pub fn flanks(&self) -> &MeshFlanks {
        &self.flanks
    }

    /// Stiffness (N/mm) and length of contact lines (mm) that damping refers to.
    pub fn means(&self) -> [f64; 2] {
        self.means
    }

    /// The pair.
    pub fn pair(&self) -> &GearPair {
        &self.pair
    }

    /// Driving flanks, and coast flanks where these may touch.
    pub(crate) fn sides(&self) -> impl Iterator<Item = &MeshSide> {
        self.flanks.sides()
    }

    /// Puts the mean of the load in its place; gives the load.
    pub(crate) fn hold_mean_load(&mut self) -> Torque {
        let mean = Torque::Constant(self.options.mean_load());
        std::mem::replace(&mut self.options.load, mean)
    }

    /// Puts a load on the driven gear, N mm against its turn.
    pub fn set_load(&mut self, load: Torque) {
        self.options.load = load;
    }

    /// Gives the driver another speed, rad/s.
    pub fn set_speed(&mut self, speed: Speed) {
        self.nominal.speed = speed;
    }

    /// Damps the mesh otherwise; a ratio refers to the means that the pair was made with.
    pub fn set_damping(&mut self, damping: MeshDamping) {
        self.options.damping = damping;
        self.damping = damping_per_length(&self.pair, &self.options, self.means);
    }

    /// Time (s) at which the nominal motion has turned so many mesh cycles since the start.
    pub(crate) fn time_of_cycles(&self, cycles: f64) -> Option<f64> {
        self.nominal.time_at(&self.pair, &self.options.statics, cycles)
    }

    pub(crate) fn cycles(&self, t: f64) -> f64 {
        self.nominal.cycles(&self.pair, &self.options.statics, t)
    }

    pub(crate) fn nominal_state(&self, t: f64) -> NominalState {
        self.nominal.at(&self.pair, &self.options.statics, t)
    }

    /// Mesh cycles that the gears have turned, a driver's own deviation from its nominal turn included.
    fn turned_cycles(&self, t: f64, d: &Displacement) -> f64 {
        let contact = &self.options.statics;
        if self.coordinates.driver_turn().is_none() {
            return self.cycles(t);
        }
        let driver = 1 - contact.driven();
        self.cycles(t) + self.cycles_per_turn(driver) * d[COORDINATES * (driver + 1) - 1]
    }

    /// Mesh cycles that pass as a gear turns by a radian about +z.
    pub(crate) fn cycles_per_turn(&self, gear: usize) -> f64 {
        let sense = running_senses(&self.pair, &self.options.statics)[gear];
        sense / [&self.pair.pinion, &self.pair.wheel][gear].pitch_angle().abs()
    }

    /// L D of the modes at time `t`; no rows without modes.
    fn coupling(&self, t: f64) -> DMatrix<f64> {
        match &self.modal {
            None => DMatrix::zeros(0, 2 * COORDINATES),
            Some(modal) => modal.coupling(self.flanks.driving.angles(&self.pair, self.cycles(t))),
        }
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
        self.flanks.contact(&self.pair, cycles, at, tangents)
    }
}
