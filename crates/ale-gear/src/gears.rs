//! From the words of a scene to exact geometry and meshes.

use geometry::{Gear, GearData, GearPair, GeometryError};

use crate::error::CommandError;
use crate::facts::GeometryFacts;
use crate::scene::{GearScene, Scene};

/// Gear data of pinion and wheel in the program's own units.
fn data(scene: &Scene, gear: &GearScene) -> GearData {
    GearData {
        teeth: gear.teeth,
        normal_module: scene.pair.normal_module_mm,
        normal_pressure_angle: scene.pair.normal_pressure_angle(),
        helix_angle: gear.helix_angle(),
        face_width: scene.pair.face_width_mm,
        profile_shift: gear.profile_shift,
        thickness_allowance: gear.thickness_allowance_mm,
        addendum_coefficient: scene.pair.addendum_coefficient,
        dedendum_coefficient: scene.pair.dedendum_coefficient,
        root_radius_coefficient: scene.pair.root_radius_coefficient,
        tip_diameter: gear.tip_diameter_mm,
        tip_edge_radius: gear.tip_edge_radius_mm,
        bore_diameter: gear.bore_diameter_mm,
    }
}

/// The exact pair of a scene.
///
/// # Errors
/// Exit status 2 when no running pair can be made of the data.
pub(crate) fn pair(scene: &Scene) -> Result<GearPair, CommandError> {
    let complaint = |whose: &str, e: &GeometryError| {
        CommandError::input(format_args!("{}: {whose}: {e}", scene.file.display()), e.hint())
    };
    let pinion = Gear::new(data(scene, &scene.pinion)).map_err(|e| complaint("[pinion]", &e))?;
    let wheel = Gear::new(data(scene, &scene.wheel)).map_err(|e| complaint("[wheel]", &e))?;
    GearPair::new(pinion, wheel, scene.pair.centre_distance_mm).map_err(|e| complaint("[pair]", &e))
}

/// What the summary says of a pair.
pub(crate) fn geometry_facts(pair: &GearPair) -> GeometryFacts {
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
