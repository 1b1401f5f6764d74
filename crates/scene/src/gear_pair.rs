//! From a scene to the exact geometry of its pair: gear data, micro-geometry, pitch errors.

use geometry::{Gear, GearData, GearModifications, GearPair, Shaper, Side};

use crate::{GearScene, Scene, SceneError};

impl Scene {
    /// The exact pair of the scene, in mm and rad, with its micro-geometry and pitch errors.
    ///
    /// # Errors
    /// [`SceneError::Geometry`] if no running pair can be made from the data.
    pub fn gear_pair(&self) -> Result<GearPair, SceneError> {
        let gear = |whose: &'static str, of: &GearScene| {
            let nominal = Gear::new(data(self, of)).map_err(|e| self.geometry_fault(whose, e))?;
            nominal.with_modifications(modifications(self, of)).map_err(|e| self.geometry_fault(whose, e))
        };
        let pinion = gear("pinion", &self.pinion)?;
        let wheel = gear("wheel", &self.wheel)?;
        let sign = wheel.sign();
        let pair = GearPair::new(pinion, wheel, self.pair.centre_distance_mm.map(|a| sign * a));
        let placed = match self.pair.mid_face_offset_mm {
            Some(offset) => pair.and_then(|pair| pair.with_mid_face_offset(offset)),
            None => pair,
        };
        placed.map_err(|e| self.geometry_fault("pair", e))
    }
}

/// Gear data of pinion and wheel in the program's own units.
pub(crate) fn data(scene: &Scene, gear: &GearScene) -> GearData {
    let sign = if gear.is_internal() { -1.0 } else { 1.0 };
    let rounding = gear.shaper.map_or(scene.pair.root_radius_coefficient, |s| s.tip_rounding_coefficient);
    GearData {
        teeth: gear.teeth,
        normal_module: scene.pair.normal_module_mm,
        normal_pressure_angle: scene.pair.normal_pressure_angle(),
        helix_angle: gear.helix_angle(),
        face_width: gear.width_mm(&scene.pair),
        profile_shift: gear.profile_shift,
        thickness_allowance: gear.thickness_allowance_mm,
        addendum_coefficient: scene.pair.addendum_coefficient,
        dedendum_coefficient: scene.pair.dedendum_coefficient,
        root_radius_coefficient: rounding,
        tip_diameter: gear.tip_diameter_mm.map(|d| sign * d),
        tip_edge_radius: gear.tip_edge_radius_mm,
        bore_diameter: sign * gear.bore_diameter_mm,
        shaper: gear.shaper.map(|s| Shaper { teeth: s.teeth, profile_shift: s.profile_shift }),
    }
}

/// Micro-geometry of a gear: the driving flanks are on the same side of both gears.
fn modifications(scene: &Scene, gear: &GearScene) -> GearModifications {
    let (drive, coast) = (gear.modification.drive.in_geometry(), gear.modification.coast.in_geometry());
    let (left, right) = if scene.side() == Side::Left { (drive, coast) } else { (coast, drive) };
    let pitch_errors = match &gear.pitch_errors_file {
        Some(file) => file.values().clone(),
        None => gear.pitch_errors_um.iter().map(|e| 1e-3 * e).collect(),
    };
    GearModifications { left, right, pitch_errors }
}
