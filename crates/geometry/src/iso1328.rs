//! Flank tolerances of ISO 1328-1:2013.

use crate::Gear;

/// Tolerance classes of the standard.
pub const TOLERANCE_CLASSES: std::ops::RangeInclusive<u32> = 1..=11;

/// Tolerances of one gear, um.
///
/// ```text
/// f_pT  = (0.001 d + 0.4 m_n + 5) s          single pitch
/// F_pT  = (0.002 d + 0.55 sqrt(d) + 0.7 m_n + 12) s    total cumulative pitch
/// f_HaT = (0.4 m_n + 0.001 d + 4) s          profile slope
/// f_faT = (0.55 m_n + 5) s                   profile form
/// f_HbT = (0.05 sqrt(d) + 0.35 sqrt(b) + 4) s    helix slope
/// f_fbT = (0.07 sqrt(d) + 0.45 sqrt(b) + 4) s    helix form
/// s = sqrt(2)^(A - 5)
/// ```
/// d is the reference diameter (its magnitude for an internal gear), b the face width, both in mm; A is the class. The
/// values are not rounded; the standard rounds them for drawings.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(missing_docs)] // the names say what they are
pub struct FlankTolerances {
    pub single_pitch_um: f64,
    pub total_pitch_um: f64,
    pub profile_slope_um: f64,
    pub profile_form_um: f64,
    pub helix_slope_um: f64,
    pub helix_form_um: f64,
}

impl FlankTolerances {
    /// Tolerances of a gear in one class of [`TOLERANCE_CLASSES`].
    pub fn new(gear: &Gear, class: u32) -> Self {
        let (d, b, m) = (2.0 * gear.reference_radius().abs(), gear.face_width(), gear.data().normal_module);
        let step = 2f64.sqrt().powi(class as i32 - 5);
        Self {
            single_pitch_um: (0.001 * d + 0.4 * m + 5.0) * step,
            total_pitch_um: (0.002 * d + 0.55 * d.sqrt() + 0.7 * m + 12.0) * step,
            profile_slope_um: (0.4 * m + 0.001 * d + 4.0) * step,
            profile_form_um: (0.55 * m + 5.0) * step,
            helix_slope_um: (0.05 * d.sqrt() + 0.35 * b.sqrt() + 4.0) * step,
            helix_form_um: (0.07 * d.sqrt() + 0.45 * b.sqrt() + 4.0) * step,
        }
    }

    /// Tolerance for the deviation of a flank modification, by its key; `None` if the standard has no tolerance for
    /// this key.
    pub fn of_key(&self, key: &str) -> Option<f64> {
        match key.rsplit('.').next()? {
            "profile_slope_um" => Some(self.profile_slope_um),
            "profile_crowning_um" => Some(self.profile_form_um),
            "lead_slope_um" => Some(self.helix_slope_um),
            "lead_crowning_um" => Some(self.helix_form_um),
            _ => None,
        }
    }
}
