//! From a scene to the exact geometry of its pair: gear data, micro-geometry, pitch errors.

use geometry::modification::{
    DataFileError, EndRelief, ProfilePlace, Relief, ReliefShape, Topography, read_pitch_errors,
};
use geometry::{FlankModification, Gear, GearData, GearModifications, GearPair, Side};

use crate::{FlankScene, GearScene, Scene, SceneError, Shape};

impl Scene {
    /// The exact pair of the scene, in mm and rad, with its micro-geometry and pitch errors.
    ///
    /// # Errors
    /// [`SceneError::Geometry`] when no running pair can be made of the data, [`SceneError::DataFile`] when a topography or
    /// a list of pitch errors cannot be read.
    pub fn gear_pair(&self) -> Result<GearPair, SceneError> {
        let gear = |whose: &'static str, of: &GearScene| {
            let nominal = Gear::new(data(self, of)).map_err(|e| self.geometry_fault(whose, e))?;
            nominal.with_modifications(modifications(self, of)?).map_err(|e| self.geometry_fault(whose, e))
        };
        let pinion = gear("pinion", &self.pinion)?;
        let wheel = gear("wheel", &self.wheel)?;
        GearPair::new(pinion, wheel, self.pair.centre_distance_mm).map_err(|e| self.geometry_fault("pair", e))
    }
}

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
