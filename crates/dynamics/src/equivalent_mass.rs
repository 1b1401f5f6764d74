//! Inertia of a pair, referred to its base circles.

use geometry::GearPair;

use crate::{Drive, MeshDamping, MotionOptions, RigidBody};

/// Inertias of both gears referred to their base circles, J / r_b^2, t.
pub fn masses_on_base_circles(pair: &GearPair, bodies: &[RigidBody; 2]) -> [f64; 2] {
    let base = [pair.pinion.base_radius(), pair.wheel.base_radius()];
    [0, 1].map(|i| bodies[i].polar_inertia / (base[i] * base[i]))
}

/// Reduced mass of the pair's rotations on the base circles, t; that of the driven gear alone if the driver's angle is
/// prescribed.
pub fn equivalent_mass_of(pair: &GearPair, options: &MotionOptions) -> f64 {
    let inertia = masses_on_base_circles(pair, &options.bodies);
    let driver = 1 - options.statics.driven();
    let held = matches!(options.drive, Drive::Speed(_));
    equivalent_mass(inertia, held.then_some(driver))
}

/// Reduced mass on the base circles of two inertias, t; one of them may be held.
pub fn equivalent_mass([a, b]: [f64; 2], held: Option<usize>) -> f64 {
    match held {
        Some(0) => b,
        Some(_) => a,
        None => a * b / (a + b),
    }
}

/// Mesh damping per length of contact line, N s/mm^2. `means` are the mesh stiffness (N/mm on the base circle) and the
/// length of contact lines (mm).
pub fn damping_per_length(pair: &GearPair, options: &MotionOptions, means: [f64; 2]) -> f64 {
    match options.damping {
        MeshDamping::PerLength(c) => c,
        MeshDamping::Ratio(zeta) => {
            // c of the base circle; a slice moves by cos(b_b) of it, and so does its force.
            let cos = pair.base_helix_angle().cos();
            2.0 * zeta * (means[0] * equivalent_mass_of(pair, options)).sqrt() / (means[1] * cos * cos)
        }
    }
}
