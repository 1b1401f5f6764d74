//! Inertia forces of rotating elastic bodies.

use std::f64::consts::TAU;

/// Largest force on an elastic deformation caused by the body's rotation, divided by the elastic force. Theory (68).
///
/// ```text
/// M q'' + 2 W G q' + (K - W^2 N) q = f,   G_ij = phi_i' M (z x phi_j),   N_ij = (z x phi_i)' M (z x phi_j)
/// share = (2 W w + W^2) / w_1^2
/// ```
/// In the gear's own frame G is the gyroscopic (Coriolis) and N the centrifugal matrix; on modes of unit mass the norm
/// of neither exceeds 1. W is the rotation, w the frequency of the deformation, w_1 the lowest elastic frequency. A
/// frequency changes by at most W + W^2 / (2 w_1). The program neglects both terms; tilts of a rigid gear have their
/// gyroscopic moments.
///
/// All quantities in Hz (revolutions per second for the rotation). Source: texts on rotating elastic bodies, such as
/// Genta, Dynamics of Rotating Systems, 2005.
pub fn rotation_share(turns_per_second: f64, deformation_hz: f64, lowest_elastic_hz: f64) -> f64 {
    let [rotation, deformation, lowest] = [turns_per_second, deformation_hz, lowest_elastic_hz].map(|f| TAU * f);
    (2.0 * rotation * deformation + rotation * rotation) / (lowest * lowest)
}

#[cfg(test)]
mod tests {
    use super::rotation_share;

    /// Nothing turns, nothing changes; twice the speed of a quasi-static load is twice the share and a little more.
    #[test]
    fn the_share_grows_with_the_rotation() {
        assert_eq!(rotation_share(0.0, 500.0, 8000.0), 0.0);
        let [slow, fast] = [10.0, 20.0].map(|n| rotation_share(n, 500.0, 8000.0));
        assert!(fast > 2.0 * slow && fast < 2.1 * slow, "{slow} and {fast}");
        assert!((rotation_share(8000.0, 0.0, 8000.0) - 1.0).abs() < 1e-12, "at the lowest frequency it is whole");
    }
}
