//! Size of the flank that carries the micro-geometry.

use super::ProfilePlace;
use crate::GeometryError;

/// Half of a usual band of contact over the normal module.
const BANDS_A_MODULE: f64 = 30.0;

/// Size of the flank that a modification is put on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FlankSize {
    /// Roll angles at the root form circle and at the tip circle; of an internal gear the second is smaller.
    pub roll: [f64; 2],
    /// b/2, mm.
    pub half_width: f64,
    /// r_b, mm, negative of an internal gear.
    pub base_radius: f64,
    /// m_n, mm.
    pub normal_module: f64,
    /// Roll angle along a contact line by height, s tan(beta)/r, rad/mm.
    pub roll_by_height: f64,
}

impl FlankSize {
    /// Half of a typical contact band, mm.
    pub fn band(&self) -> f64 {
        self.normal_module / BANDS_A_MODULE
    }

    /// Roll angle of a place between root form circle and tip circle.
    pub(super) fn roll_of(&self, name: &'static str, place: ProfilePlace) -> Result<f64, GeometryError> {
        let roll = place.roll(self.base_radius);
        // Below the base circle the roll angle is no number, and no number is below the tip.
        let [form, tip] = self.roll;
        // Towards the tip; roll angles of a ring fall there.
        let way = (tip - form).signum();
        if way * (tip - roll) > 0.0 && way * (roll - form * (1.0 - 1e-9 * way)) >= 0.0 {
            return Ok(roll);
        }
        Err(self.off_flank(name, place))
    }

    pub(super) fn off_flank(&self, name: &'static str, place: ProfilePlace) -> GeometryError {
        match place {
            ProfilePlace::Roll(value) => GeometryError::OffFlank {
                name,
                value: value.to_degrees(),
                unit: "deg of roll",
                low: self.roll[0].min(self.roll[1]).to_degrees(),
                high: self.roll[0].max(self.roll[1]).to_degrees(),
            },
            ProfilePlace::Diameter(value) => {
                let [form, tip] = self.roll.map(|u| 2.0 * self.base_radius.abs() * u.hypot(1.0));
                let [low, high] = [form.min(tip), form.max(tip)];
                GeometryError::OffFlank { name, value, unit: "mm of diameter", low, high }
            }
        }
    }
}
