//! What a lumped model says at one time, in the words of the reduced model's history.

use std::convert::Infallible;

use contact::Wrench;
use geometry::Vec3;
use integrate::{Mechanism, State};
use nalgebra::DVector;
use serde::Serialize;

use crate::{LumpedPair, MeshFrame};

/// One row of a history.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HistoryRow {
    /// Time, s.
    pub time: f64,
    /// Mesh phase, 0 .. 1.
    pub mesh_phase: f64,
    /// Angle of the pinion, rad, in its sense, from the middle position of pair 0.
    pub pinion_angle: f64,
    /// Dynamic transmission error r_b1 theta_1 - r_b2 theta_2 of driver and driven gear, mm; positive when the driven
    /// gear lags.
    pub transmission_error: f64,
    /// Relative displacement of the flanks along the transverse line of action, mm: the transmission error and what the
    /// supports give way.
    pub mesh_deflection: f64,
    /// Mesh stiffness k on the transverse line of action, N/mm.
    pub mesh_stiffness: f64,
    /// Length of the contact lines, mm; 0 in the clearance.
    pub contact_line_length: f64,
    /// Normal force F_bn, N; negative on the coast flanks.
    pub normal_force: f64,
    /// Friction force on the driver across the line of action, N.
    pub friction_force: f64,
    /// Mesh force on pinion and wheel, moments about their own centres, global axes.
    pub wrench: [Wrench; 2],
    /// Coordinates, mm and rad, in the model's order.
    pub displacement: Vec<f64>,
    /// Velocities, mm/s and rad/s.
    pub velocity: Vec<f64>,
}

/// A mechanism made of a lumped pair.
pub trait LumpedModel: Mechanism<Error = Infallible> {
    /// Pair and operation.
    fn pair(&self) -> &LumpedPair;

    /// Row of the history at a state.
    fn row(&self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> HistoryRow;

    /// Coordinates at which the loaded pair stands at `cycles` mesh cycles as speed goes to zero, the driver's turn
    /// held; `None` where nothing holds it.
    fn quasi_static(&self, cycles: f64) -> Option<DVector<f64>>;

    /// What counts as a large motion of each coordinate: for the integrators' tolerances.
    fn scale(&self) -> DVector<f64>;
}

/// State in which a run starts: the loaded pair at rest as for speed to zero, moving with the nominal rotation; all
/// zero where nothing holds it.
pub fn starting_state(model: &impl LumpedModel) -> State {
    let n = model.mass().nrows();
    let start = model.quasi_static(model.pair().clock.cycles(0.0)).unwrap_or_else(|| DVector::zeros(n));
    State::new(0.0, start, DVector::zeros(n))
}

/// Mesh forces of a model in its own axes, for [`HistoryRow`].
pub(crate) struct MeshState {
    pub te: f64,
    pub deflection: f64,
    pub normal_force: f64,
    pub friction_force: f64,
    pub touching: bool,
    /// Force and moment on driver and driven gear about their own centres, global axes.
    pub on_gears: [(Vec3, Vec3); 2],
}

/// A row from the state of the mesh.
pub(crate) fn row_of(pair: &LumpedPair, t: f64, mesh: &MeshState, q: &DVector<f64>, v: &DVector<f64>) -> HistoryRow {
    let wrench = mesh.on_gears.map(|(f, m)| Wrench { force: f.into(), moment: m.into() });
    let turned = pair.clock.cycles(t) * pair.plane.base_pitch;
    let pinion_radius = pair.base_radii[usize::from(!pair.pinion_drives)];
    HistoryRow {
        time: t,
        mesh_phase: pair.clock.cycles(t).rem_euclid(1.0),
        pinion_angle: turned / pinion_radius,
        transmission_error: mesh.te,
        mesh_deflection: mesh.deflection,
        mesh_stiffness: pair.excitation(t)[0],
        contact_line_length: if mesh.touching { pair.line_length(t) } else { 0.0 },
        normal_force: mesh.normal_force,
        friction_force: mesh.friction_force,
        wrench: if pair.pinion_drives { wrench } else { [wrench[1], wrench[0]] },
        displacement: q.iter().copied().collect(),
        velocity: v.iter().copied().collect(),
    }
}

/// Places of a load at (xi, z) of the plane of action, from the centres of driver and driven gear, mm.
///
/// ```text
/// r_1 = r_b1 e_x + xi e_y + z e_z,   r_2 = -r_b2 e_x - (T - xi) e_y + z e_z
/// ```
pub(crate) fn places(frame: &MeshFrame, radii: [f64; 2], tangents: f64, [xi, z]: [f64; 2]) -> [Vec3; 2] {
    let (across, along) = (frame.across(), frame.along());
    [radii[0] * across + xi * along + z * Vec3::z(), -radii[1] * across - (tangents - xi) * along + z * Vec3::z()]
}

/// Angle a standing pair still turns in a second, rad: what is left of the rate of excitation is below round-off.
pub(crate) const STANDING: f64 = 1e-200;

/// Deflection under the load, or backlash where that is larger; turns by the base radii.
pub(crate) fn scale(pair: &LumpedPair, clearance: f64, n: usize, turns: &[usize]) -> DVector<f64> {
    let loaded = (pair.mean_force() / pair.cycle.stiffness.mean).abs();
    let errors = (1..=pair.cycle.error.orders()).map(|o| pair.cycle.error.amplitude(o)).fold(0.0, f64::max);
    let length = loaded.max(clearance).max(errors).max(1e-9);
    let radius = pair.base_radii[0].min(pair.base_radii[1]);
    DVector::from_fn(n, |i, _| if turns.contains(&i) { length / radius } else { length })
}
