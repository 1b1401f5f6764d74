//! Meshes whose errors are calibrated on random pairs.

use mesh::StructuredOptions;
use scene::{GearScene, MesherScene, Scene};
use serde::{Deserialize, Serialize};

use super::Rung;

/// A mesh of the built-in mesher for which the calibration has measurements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CalibratedMesh {
    /// A rung of the ladder, given by its elements along the profile.
    Rung(u32),
    /// The mesher's default.
    Default,
}

impl CalibratedMesh {
    /// The calibrated mesh of both gears of a scene. `None` for any other mesh, and for open sectors, which are
    /// different bodies.
    pub fn of(scene: &Scene) -> Option<Self> {
        if scene.gears().iter().any(|g| g.mesher.is_none_or(|m| m.sector_teeth > 1)) {
            return None;
        }
        let d = StructuredOptions::default();
        let default = |gear: &GearScene, m: &MesherScene| {
            let counts = [m.elements_profile, m.elements_fillet, m.elements_thickness, m.elements_face, m.elements_rim];
            let face = scene.face_elements(gear, m.order);
            m.order == d.order
                && counts == [d.elements_profile, d.elements_fillet, d.elements_thickness, face, d.elements_rim]
        };
        let rung = Rung::of(scene).map(|rung| Self::Rung(rung.elements_profile));
        let is_default = scene.gears().iter().all(|g| g.mesher.as_ref().is_some_and(|m| default(g, m)));
        rung.or(is_default.then_some(Self::Default))
    }

    /// Text for messages.
    pub fn words(self) -> String {
        match self {
            Self::Rung(n) => format!("meshes of {n} elements along the profile"),
            Self::Default => "meshes of the mesher's own choice".into(),
        }
    }
}
