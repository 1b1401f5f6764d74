//! Effect of errors of the static pair on its motion.

use std::f64::consts::SQRT_2;

use scene::Quantity;

use super::PairAtRest;

/// Contribution of the static pair's bounds to the bound of a value of its motion, um. Theory (65).
///
/// ```text
/// m = B sum_k A_k R(rho_k) / sum_k A_k + 2 sum_k A_k max |R(rho_k / sqrt(1 +- kappa)) - R(rho_k)|
/// R(rho) = 1 / |1 - rho^2 + 2 i zeta rho|,   rho_k = k f_m / f_0
/// ```
/// A_k are harmonics of the quasi-static transmission error, B is the bound of its peak to peak (um), kappa the
/// relative bound of the mean tangent stiffness, which shifts the resonance f_0. The first part is the error of the
/// excitation, the second that of the response. The root mean square takes 1 / (2 sqrt 2) of it, as for one harmonic.
pub fn mesh_bound(quantity: Quantity, rest: &PairAtRest, peak_to_peak_bound_um: f64, stiffness_bound: f64) -> f64 {
    let (mut excited, mut answered, mut all) = (0.0, 0.0, 0.0);
    for (i, amplitude) in rest.amplitudes_um.iter().enumerate() {
        let own = rest.response(i + 1, 1.0);
        // A resonance may be off to either side; one at zero would answer to nothing.
        let shifted = [1.0 - stiffness_bound, 1.0 + stiffness_bound].map(|k| rest.response(i + 1, k.max(0.0).sqrt()));
        answered += amplitude * shifted.iter().map(|r| (r - own).abs()).fold(0.0, f64::max);
        excited += amplitude * own;
        all += amplitude;
    }
    let gain = if all > 0.0 { excited / all } else { rest.response(1, 1.0) };
    let bound = gain * peak_to_peak_bound_um + 2.0 * answered;
    match quantity {
        Quantity::RmsDte => bound / (2.0 * SQRT_2),
        _ => bound,
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{MeshResonance, RigidBody};

    use super::*;

    fn pair(mesh_hz: f64) -> PairAtRest {
        let body = RigidBody { mass: 1.0, transverse_inertia: 1.0, polar_inertia: 1.0 };
        PairAtRest {
            mesh_hz,
            resonance: MeshResonance { hz: 1000.0, damping: 0.05 },
            elastic_hz: [20_000.0; 2],
            amplitudes_um: vec![1.0, 0.2],
            ste_um: [0.72, 2.2],
            bodies: [body; 2],
        }
    }

    /// Slow pairs pass bounds on as they are, the resonance magnifies them by 1 / (2 zeta), fast pairs hardly hear of
    /// them.
    #[test]
    fn bounds_are_magnified_as_the_motion_is() {
        let of = |hz: f64, kappa: f64| mesh_bound(Quantity::PeakToPeakDte, &pair(hz), 0.1, kappa);
        assert!((of(1.0, 0.0) - 0.1).abs() < 1e-5);
        assert!((of(1000.0, 0.0) - 0.1 * (10.0 + 0.2 / 3.0) / 1.2).abs() < 1e-2, "{}", of(1000.0, 0.0));
        assert!(of(10_000.0, 0.0) < 0.01 * 0.1 * 1.2);
        // An uncertain stiffness matters on the flank of the resonance, and not where nothing swings.
        assert!(of(950.0, 0.02) > 3.0 * of(950.0, 0.0), "{}", of(950.0, 0.02));
        assert!(of(10.0, 0.02) < 1.01 * of(10.0, 0.0));
        let [rms, peak] = [Quantity::RmsDte, Quantity::PeakToPeakDte].map(|q| mesh_bound(q, &pair(400.0), 0.1, 0.01));
        assert!((peak / rms - 8f64.sqrt()).abs() < 1e-12);
    }
}
