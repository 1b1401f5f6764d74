//! Remarks about the nominal pair of a scene, and its derived geometry.

use crate::remark;
use geometry::GearPair;
use serde::Serialize;

described::described! {
    /// Derived geometry of the pair.
    #[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
    pub struct GeometryFacts {
        /// centre distance
        pub centre_distance_mm: f64,
        /// transverse pressure angle
        pub transverse_pressure_angle_deg: f64,
        /// working transverse pressure angle
        pub working_pressure_angle_deg: f64,
        /// helix angle on the base cylinder
        pub base_helix_angle_deg: f64,
        /// base radii of pinion and wheel
        pub base_radius_mm: [f64; 2],
        /// transverse base pitch
        pub base_pitch_mm: f64,
        /// transverse contact ratio
        pub eps_alpha: f64,
        /// overlap ratio
        pub eps_beta: f64,
        /// total contact ratio
        pub eps_gamma: f64,
        /// mean total contact-line length of the unloaded pair
        pub mean_line_length_mm: f64,
        /// backlash along the transverse line of action
        pub backlash_mm: f64,
    }
}

/// Remarks about a pair that runs.
pub fn remarks(pair: &GearPair) -> Vec<answer::Remark> {
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
    let mut told: Vec<_> = told.collect();
    if let Some(ring) = pair.ring_sheet() {
        if ring.trimming_margin_deg < 0.0 {
            told.push(remark::axial_assembly(-ring.trimming_margin_deg));
        }
        if ring.shaper_trimming_margin_deg < 0.0 {
            told.push(remark::shaper_trims(-ring.shaper_trimming_margin_deg, ring.shaper_teeth));
        }
    }
    told
}

/// Geometry of a pair for the summary.
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
