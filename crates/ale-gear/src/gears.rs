//! From the words of a scene to exact geometry and meshes.

use geometry::modification::{
    DataFileError, EndRelief, ProfilePlace, Relief, ReliefShape, Topography, read_pitch_errors,
};
use geometry::{FlankModification, Gear, GearData, GearModifications, GearPair, GeometryError, Side};

use crate::error::CommandError;
use crate::facts::GeometryFacts;
use crate::geometry_fault::geometry_fault;
use crate::scene::{FlankScene, GearScene, Scene, Shape};

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

/// Micro-geometry of a gear: the driving flanks are on the same side of both gears.
fn modifications(scene: &Scene, gear: &GearScene) -> Result<GearModifications, DataFileError> {
    let drive = flank(scene, &gear.modification.drive)?;
    let coast = flank(scene, &gear.modification.coast)?;
    let (left, right) = if scene.side() == Side::Left { (drive, coast) } else { (coast, drive) };
    let pitch_errors = match &gear.pitch_errors_file {
        Some(file) => read_pitch_errors(&scene.resolve(file))?,
        None => gear.pitch_errors_um.iter().map(|e| 1e-3 * e).collect(),
    };
    Ok(GearModifications { left, right, pitch_errors })
}

fn flank(scene: &Scene, f: &FlankScene) -> Result<FlankModification, DataFileError> {
    let mm = |um: Option<f64>| 1e-3 * um.unwrap_or(0.0);
    let grows = |shape: Option<Shape>| match shape {
        None | Some(Shape::Linear) => ReliefShape::Linear,
        Some(Shape::Parabolic) => ReliefShape::Parabolic,
    };
    let relief = |amount: Option<f64>, diameter: Option<f64>, roll_deg: Option<f64>, shape| {
        let start = diameter.map(ProfilePlace::Diameter).or(roll_deg.map(|u| ProfilePlace::Roll(u.to_radians())))?;
        Some(Relief { amount: 1e-3 * amount?, start, shape: grows(shape) })
    };
    let end = |amount: Option<f64>, length: Option<f64>| {
        Some(EndRelief { amount: 1e-3 * amount?, length: length?, shape: grows(f.end_relief_shape) })
    };
    Ok(FlankModification {
        tip_relief: relief(
            f.tip_relief_um,
            f.tip_relief_start_diameter_mm,
            f.tip_relief_start_roll_deg,
            f.tip_relief_shape,
        ),
        root_relief: relief(
            f.root_relief_um,
            f.root_relief_start_diameter_mm,
            f.root_relief_start_roll_deg,
            f.root_relief_shape,
        ),
        profile_crowning: mm(f.profile_crowning_um),
        profile_slope: mm(f.profile_slope_um),
        lead_crowning: mm(f.lead_crowning_um),
        lead_slope: mm(f.lead_slope_um),
        end_relief: [
            end(f.end_relief_lower_um, f.end_relief_lower_length_mm),
            end(f.end_relief_upper_um, f.end_relief_upper_length_mm),
        ],
        bias: mm(f.bias_um),
        topography: f.topography.as_ref().map(|path| Topography::read(&scene.resolve(path))).transpose()?,
        evaluation_start: f.evaluation_start_diameter_mm.map(ProfilePlace::Diameter),
    })
}

/// The exact pair of a scene.
///
/// # Errors
/// Exit status 2 when no running pair can be made of the data.
pub(crate) fn pair(scene: &Scene) -> Result<GearPair, CommandError> {
    let complaint = |table: &str, e: &GeometryError| geometry_fault(scene, table, e);
    let gear = |whose: &str, of: &GearScene| {
        let nominal = Gear::new(data(scene, of)).map_err(|e| complaint(whose, &e))?;
        let ground = modifications(scene, of).map_err(|e| CommandError::input(&e, e.hint()))?;
        nominal.with_modifications(ground).map_err(|e| complaint(whose, &e))
    };
    let pinion = gear("pinion", &scene.pinion)?;
    let wheel = gear("wheel", &scene.wheel)?;
    GearPair::new(pinion, wheel, scene.pair.centre_distance_mm).map_err(|e| complaint("pair", &e))
}

/// What a user should know of a pair that runs.
pub(crate) fn doubts(pair: &GearPair) -> Vec<String> {
    let gears = [("pinion", &pair.pinion), ("wheel", &pair.wheel)];
    let undercut = gears.into_iter().filter(|(_, gear)| gear.profile().is_undercut());
    let told = undercut.map(|(whose, gear)| {
        format!(
            "the {whose} is undercut: its involute begins at diameter {:.3} mm and its roots are weak; a `profile_shift` of {:.3} or more (it is {}) \
             or more teeth avoid that",
            2.0 * gear.form_radius(),
            (1e3 * gear.undercut_limit()).ceil() / 1e3,
            gear.data().profile_shift
        )
    });
    told.collect()
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
