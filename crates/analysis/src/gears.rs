//! What a user hears of the exact pair of a scene: warnings and derived geometry.

use crate::remark;
use geometry::GearPair;
use serde::Serialize;

/// Derived geometry of the pair.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct GeometryFacts {
    /// Working centre distance, mm.
    pub centre_distance_mm: f64,
    /// Transverse pressure angle, degrees.
    pub transverse_pressure_angle_deg: f64,
    /// Working transverse pressure angle, degrees.
    pub working_pressure_angle_deg: f64,
    /// Base helix angle, degrees.
    pub base_helix_angle_deg: f64,
    /// Base radii, mm.
    pub base_radius_mm: [f64; 2],
    /// Transverse base pitch, mm.
    pub base_pitch_mm: f64,
    /// Transverse contact ratio.
    pub eps_alpha: f64,
    /// Overlap ratio.
    pub eps_beta: f64,
    /// Total contact ratio.
    pub eps_gamma: f64,
    /// Mean of the analytic total contact-line length, mm.
    pub mean_line_length_mm: f64,
    /// Backlash on the transverse line of action, mm.
    pub backlash_mm: f64,
}

/// What a user should know of a pair that runs.
pub fn warnings(pair: &GearPair) -> Vec<answer::Remark> {
    let gears = [("pinion", &pair.pinion), ("wheel", &pair.wheel)];
    let undercut = gears.into_iter().filter(|(_, gear)| gear.profile().is_undercut());
    let told = undercut.map(|(whose, gear)| {
        remark::undercut(
            whose,
            2.0 * gear.form_radius(),
            (1e3 * gear.undercut_limit()).ceil() / 1e3,
            gear.data().profile_shift,
        )
    });
    told.collect()
}

/// What the summary says of a pair.
pub fn geometry_facts(pair: &GearPair) -> GeometryFacts {
    GeometryFacts {
        centre_distance_mm: pair.centre_distance(),
        transverse_pressure_angle_deg: pair.pinion.transverse_pressure_angle().to_degrees(),
        working_pressure_angle_deg: pair.working_pressure_angle().to_degrees(),
        base_helix_angle_deg: pair.base_helix_angle().to_degrees(),
        base_radius_mm: [pair.pinion.base_radius(), pair.wheel.base_radius()],
        base_pitch_mm: pair.transverse_base_pitch(),
        eps_alpha: pair.transverse_contact_ratio(),
        eps_beta: pair.overlap_ratio(),
        eps_gamma: pair.total_contact_ratio(),
        mean_line_length_mm: pair.mean_contact_line_length(),
        backlash_mm: pair.backlash(),
    }
}
