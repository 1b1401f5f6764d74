//! Rolling elements estimated from boundary dimensions only. Theory (100a).

use std::f64::consts::PI;

use super::{
    BallGeometry, Filling, RollerGeometry, RollerProfile, RollingBearingError,
    catalogue::{CAGED, CAGED_CYLINDERS, CONES, CYLINDERS, filled},
    geometry::MOST_ELEMENTS,
};

/// Diameter of balls over the outer diameter less the bore.
const BALLS: f64 = 0.3;
/// Length of rollers that presses over the width of the bearing; of tapered ones over that of both rings.
const CYLINDER_LENGTH: f64 = 0.57;
const CONE_LENGTH: f64 = 0.58;

/// Boundary dimensions of a single-row bearing, as in ISO 15 and ISO 355.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryDimensions {
    /// Bore, mm.
    pub bore: f64,
    /// Outer diameter, mm.
    pub outer_diameter: f64,
    /// Width, mm; for tapered rollers the width of both rings together.
    pub width: f64,
}

impl BoundaryDimensions {
    fn pitch_diameter(&self) -> f64 {
        0.5 * (self.bore + self.outer_diameter)
    }

    /// Balls of the usual size, D_w = 0.3 (D - d), as many as the filling permits.
    ///
    /// Ratings are within a fifth of catalogue values (`boundary_dimensions_lead_to_ratings_of_catalogues`). Catalogues have
    /// no stiffness to compare with.
    ///
    /// # Errors
    /// [`RollingBearingError`] if no such balls fit between the rings.
    pub fn balls(
        &self,
        filling: Filling,
        contact_angle: f64,
        conformity: [f64; 2],
    ) -> Result<BallGeometry, RollingBearingError> {
        let pitch_diameter = self.pitch_diameter();
        let diameter = BALLS * (self.outer_diameter - self.bore);
        let elements = whole(filled(filling, diameter, pitch_diameter));
        let found = BallGeometry { elements, diameter, pitch_diameter, contact_angle, conformity };
        found.check()?;
        Ok(found)
    }

    /// Rollers of the usual size.
    ///
    /// ```text
    /// D_w = 0.55 h, L = 0.57 B, Z = pi d_pw/(1.25 D_w) cylindrical,   0.47 h, 0.58 T, 1.15 tapered,   h = (D - d)/2
    /// ```
    /// Ratings of tapered rollers are within a fifth of catalogue values. Those of cylindrical rollers are up to 27 %
    /// below them, because reinforced designs have more and longer rollers. Catalogues have no stiffness to compare
    /// with.
    ///
    /// # Errors
    /// [`RollingBearingError`] if no such rollers fit between the rings.
    pub fn rollers(&self, contact_angle: f64, profile: RollerProfile) -> Result<RollerGeometry, RollingBearingError> {
        let pitch_diameter = self.pitch_diameter();
        let [share, pitch, length] = if contact_angle > 0.0 {
            [CONES, CAGED, CONE_LENGTH]
        } else {
            [CYLINDERS, CAGED_CYLINDERS, CYLINDER_LENGTH]
        };
        let diameter = 0.5 * share * (self.outer_diameter - self.bore);
        let elements = whole(PI * pitch_diameter / (pitch * diameter));
        let length = length * self.width;
        let found = RollerGeometry { elements, diameter, length, pitch_diameter, contact_angle, profile };
        found.check()?;
        Ok(found)
    }
}

fn whole(room: f64) -> usize {
    room.round().clamp(3.0, MOST_ELEMENTS as f64) as usize
}
