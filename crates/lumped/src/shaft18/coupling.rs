//! What displacements of two gears do to the flanks between them. Theory (53).

use std::f64::consts::PI;

use geometry::{GearPair, Side};
use nalgebra::{SVector, Vector3};
use serde::{Deserialize, Serialize};

use crate::{
    LumpedError,
    error::{finite, positive},
};

/// Teeth of two gears and where the gears stand to each other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeshGeometry {
    /// Numbers of teeth of gear 1 and gear 2, below zero of a ring.
    pub teeth: [i32; 2],
    /// Normal module, mm.
    pub normal_module: f64,
    /// Normal pressure angle, rad.
    pub normal_pressure_angle: f64,
    /// Helix angle of gear 1, rad, right hand positive; gear 2 has the other hand, a ring the same.
    pub helix_angle: f64,
    /// Distance of the axes, mm; below zero where gear 2 is a ring.
    pub centre_distance: f64,
    /// Direction from gear 1's axis to the contact, rad from +x towards +y: to gear 2's axis, away from that of a ring.
    pub direction: f64,
    /// Height of the middle of the common face over the mid-faces of gear 1 and gear 2, mm.
    #[serde(default)]
    pub middle: [f64; 2],
    /// Flanks of gear 1 that carry the load: left where it drives counter-clockwise, or is driven clockwise.
    pub side: Side,
}

/// Line of action of a mesh as it acts on the six coordinates of either gear's centre.
///
/// ```text
/// delta = h_1 . d_1 + h_2 . d_2,   h_1 = [n; p_1 x n],  h_2 = -[n; p_2 x n]
/// n = cos b_b t - s sin b_b e_z,   t = (sin a_wt, s cos a_wt),   p_1 = r_w1 e_c + m_1 e_z,  p_2 = -r_w2 e_c + m_2 e_z
/// ```
/// delta: compression of the mesh along the normal, mm; a normal force F presses gear i with -F h_i. n: out of gear 1's
/// loaded flank, s = +1 left, -1 right; e_c along the line of centres; p: from the gear's centre at mid-face to the
/// pitch point in the middle of the common face (m: its heights), where the resultant of an evenly loaded mesh acts on
/// average. Turns alone give delta = s cos b_b (r_b1 theta_1 + r_b2 theta_2). On the
/// coast flanks the true line of action is the mirror image: with one line for both, backlash is exact in turning and
/// along the line, and not across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshLine {
    /// h_1 and h_2: 1 for displacements, mm for turns.
    pub levers: [SVector<f64, 6>; 2],
    /// Base radii r_b1 and r_b2, mm.
    pub base_radii: [f64; 2],
    /// cos b_b.
    pub cos_base_helix: f64,
}

impl MeshGeometry {
    /// Geometry of a pair with its line of centres along +x, flanks on `side` of the pinion loaded.
    pub fn of_pair(pair: &GearPair, side: Side) -> Self {
        let data = pair.pinion.data();
        Self {
            teeth: [&pair.pinion, &pair.wheel].map(|g| g.signed_teeth() as i32),
            normal_module: data.normal_module,
            normal_pressure_angle: data.normal_pressure_angle,
            helix_angle: data.helix_angle,
            centre_distance: pair.centre_distance(),
            direction: 0.0,
            middle: pair.common_middle(),
            side,
        }
    }

    /// The line of action.
    ///
    /// # Errors
    /// [`LumpedError`] when a value has no meaning, or the gears are so near that there is no line of action.
    pub fn line(&self) -> Result<MeshLine, LumpedError> {
        let method = "the line of action of two involute gears";
        let inside = |quantity, value: f64, low: f64, high: f64, allowed| {
            if value > low && value < high {
                Ok(())
            } else {
                Err(LumpedError::OutOfRange { quantity, value, method, allowed })
            }
        };
        let teeth = self.teeth.map(f64::from);
        inside("number of teeth of gear 1", teeth[0], 0.5, f64::INFINITY, "1 or more")?;
        inside("number of teeth of gear 2", teeth[1].abs(), 0.5, f64::INFINITY, "1 or more, or -1 or less")?;
        positive("normal module, mm", self.normal_module)?;
        inside("normal pressure angle, rad", self.normal_pressure_angle, 0.0, 0.5 * PI, "between 0 and pi/2")?;
        inside("helix angle, rad", self.helix_angle, -0.5 * PI, 0.5 * PI, "between -pi/2 and pi/2")?;
        finite("direction of the line of centres, rad", self.direction)?;
        for height in self.middle {
            finite("height of the middle of the common face, mm", height)?;
        }
        let (beta, alpha_n, s) = (self.helix_angle, self.normal_pressure_angle, self.side.sign());
        let alpha_t = (alpha_n.tan() / beta.cos()).atan();
        let base_radii = teeth.map(|z| 0.5 * self.normal_module * z / beta.cos() * alpha_t.cos());
        let least = base_radii[0] + base_radii[1];
        let apart = least.signum() * self.centre_distance;
        inside("centre distance, mm", apart, least.abs(), f64::INFINITY, "above the sum of the base radii")?;
        let working = (least / self.centre_distance).acos();
        let base_helix = (beta.sin() * alpha_n.cos()).asin();
        let normal_at = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let t = [working.sin(), s * working.cos()];
            Vector3::new(
                base_helix.cos() * (cos * t[0] - sin * t[1]),
                base_helix.cos() * (sin * t[0] + cos * t[1]),
                -s * base_helix.sin(),
            )
        };
        let n = normal_at(self.direction);
        let towards = Vector3::new(self.direction.cos(), self.direction.sin(), 0.0);
        let lever = |arm: Vector3<f64>, sign: f64| {
            let turn = arm.cross(&n);
            sign * SVector::<f64, 6>::from([n.x, n.y, n.z, turn.x, turn.y, turn.z])
        };
        let [r1, r2] = base_radii.map(|r| r / working.cos());
        let ([m1, m2], up) = (self.middle, |height: f64| Vector3::new(0.0, 0.0, height));
        Ok(MeshLine {
            levers: [lever(r1 * towards + up(m1), 1.0), lever(-(r2 * towards - up(m2)), -1.0)],
            base_radii,
            cos_base_helix: base_helix.cos(),
        })
    }
}
