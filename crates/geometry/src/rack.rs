//! The tip of a generating rack and the fillet that it makes.

use serde::Serialize;

/// Rounding of the generating rack's tip; origin at the pitch point, y away from the gear's centre.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct RackTip {
    /// Centre of the rounding, normal section, mm.
    pub centre: [f64; 2],
    pub radius: f64,
    pub cos_helix: f64,
}

impl RackTip {
    /// Point of the fillet made by the rounding's point at angle `theta` from its lowest point:
    /// radius and angle from the middle of the tooth space.
    ///
    /// The rack touches the gear where its normal passes through the pitch point: x_f = y n_x / n_y; the gear has
    /// then turned by (x_f - x)/r.
    pub fn generated(&self, theta: f64, reference_radius: f64) -> (f64, f64) {
        let (sin, cos) = theta.sin_cos();
        let x = (self.centre[0] + self.radius * sin) / self.cos_helix;
        let y = self.centre[1] - self.radius * cos;
        let touch = -y * sin * self.cos_helix / cos;
        let radial = reference_radius + y;
        (touch.hypot(radial), touch.atan2(radial) - (touch - x) / reference_radius)
    }

    /// Angle (rad) of the fillet's tangent at `theta` against the middle of the tooth space: the rack's own,
    /// atan(cos theta / (cos beta sin theta)), less the gear's turn (x_f - x)/r.
    pub fn tangent(&self, theta: f64, reference_radius: f64) -> f64 {
        let (sin, cos) = theta.sin_cos();
        let x = (self.centre[0] + self.radius * sin) / self.cos_helix;
        let touch = -(self.centre[1] - self.radius * cos) * sin * self.cos_helix / cos;
        cos.atan2(self.cos_helix * sin) - (touch - x) / reference_radius
    }
}
