//! Influence vectors of the mesh from geometry.

use geometry::Vec3;
use nalgebra::SVector;

use crate::{LumpedPair, history::places};

/// Influence vectors at one phase, in the order of the coordinates; force entries 1, moment entries mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeshVectors {
    /// a_m: normal approach of the flanks at the centre of the lines for a unit of each coordinate.
    pub normal: SVector<f64, 12>,
    /// a_t: relative tilt about the direction across the plane of action (rad).
    pub tilt: SVector<f64, 12>,
    /// a_f: generalised friction force for a normal force of 1 spread evenly, mu = 1.
    pub friction: SVector<f64, 12>,
    /// a_ft: the same for a tilt moment of 1 (N mm): line load in proportion to the distance from the centre along the
    /// lines.
    pub tilt_friction: SVector<f64, 12>,
    /// k_t / k_m, mm^2.
    pub spread: f64,
}

impl MeshVectors {
    /// Influence vectors of a pair at `cycles` mesh cycles.
    pub fn of(pair: &LumpedPair, cycles: f64) -> Self {
        let lines = pair.plane.at(cycles);
        let frame = &pair.frame;
        let (n, across, along) = (frame.normal(), frame.across(), frame.along());
        let tangents = pair.plane.tangent_length;
        let [r1, r2] = places(frame, pair.base_radii, tangents, lines.centre);
        // A pair of forces at one place: +f on the driver's generalised force, -f on the driven gear's.
        let rubbing = |[s, s_xi, s_z]: [f64; 3]| {
            let lever = |xi: f64| (xi * along + s_z * Vec3::z()).cross(&across);
            stacked(s * across, lever(s_xi), -s * across, -lever(s_xi - tangents * s))
        };
        let psi_direction = frame.sign() * across;
        // Uneven load: sum of (w - [w]) f over the lines, per moment k_t phi = k phi spread.
        let share = if lines.spread > 0.0 { 1.0 / lines.spread } else { 0.0 };
        Self {
            normal: stacked(n, r1.cross(&n), -n, -r2.cross(&n)),
            tilt: stacked(Vec3::zeros(), psi_direction, Vec3::zeros(), -psi_direction),
            friction: rubbing(lines.split),
            tilt_friction: rubbing(lines.tilt_split.map(|x| share * x)),
            spread: lines.spread,
        }
    }
}

fn stacked(a: Vec3, b: Vec3, c: Vec3, d: Vec3) -> SVector<f64, 12> {
    SVector::from_iterator([a, b, c, d].iter().flat_map(|v| [v.x, v.y, v.z]))
}
