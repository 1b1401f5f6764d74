//! Terms that the equations of every lumped model have.

use integrate::Forces;

/// A spring and a damper from coordinate `i` to the nominal motion.
pub(crate) fn add_support(out: &mut Forces, i: usize, [stiffness, damping]: [f64; 2], [q, v]: [f64; 2]) {
    out.conservative[i] -= stiffness * q;
    out.other[i] -= damping * v;
    out.dissipated += damping * v * v;
    out.stiffness[(i, i)] += stiffness;
    out.damping[(i, i)] += damping;
}

/// A force of drive or load on coordinate `i`.
pub(crate) fn add_load(out: &mut Forces, i: usize, force: f64, v: f64) {
    out.other[i] += force;
    out.supplied += force * v;
}

/// Slope of an energy with time at fixed coordinates: stiffness and error are smooth over a millionth of a mesh cycle.
pub(crate) fn slope_in_time(energy: impl Fn(f64) -> f64, t: f64, mesh_frequency: f64) -> f64 {
    let h = 1e-6 / mesh_frequency;
    (energy(t + h) - energy(t - h)) / (2.0 * h)
}
