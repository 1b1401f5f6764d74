//! The gears, and what they share.

use mesh::{FaceResolution, GroupNames, Mesh};
use serde::Serialize;

use crate::data_file::DataFile;
use crate::ladder::ShaftScene;
use crate::modification::ModificationScene;
use crate::motion::{BearingScene, BodyScene};
use crate::schema::{Coupling, MisalignmentScene};

/// One gear.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GearScene {
    /// Number of teeth, without the sign of an internal gear.
    #[serde(skip)]
    pub teeth: u32,
    /// The same as a scene file states it: negative of an internal gear.
    #[serde(rename = "teeth")]
    pub signed_teeth: i64,
    /// The tool of an internal gear; `None`: an external one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaper: Option<ShaperScene>,
    /// Helix angle at the reference cylinder, right hand positive, degrees.
    pub helix_angle_deg: f64,
    /// Face width, mm; `None`: the pair's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face_width_mm: Option<f64>,
    /// Diameter of the rigid bore, of an internal gear of its outside, without sign, mm.
    pub bore_diameter_mm: f64,
    /// Profile shift coefficient.
    pub profile_shift: f64,
    /// Tip diameter, without sign, mm; `None`: from addendum and profile shift.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_diameter_mm: Option<f64>,
    /// Radius of the arc that rounds the tip edges, mm; 0: sharp.
    pub tip_edge_radius_mm: f64,
    /// Thinning of the tooth in the normal section, mm.
    pub thickness_allowance_mm: f64,
    /// Cumulative pitch deviation of each tooth, um; empty: none, or in a file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pitch_errors_um: Vec<f64>,
    /// File of them, with their values in mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch_errors_file: Option<DataFile<Vec<f64>>>,
    /// Its mesh, with the path as written in the scene; [`Scene::resolve`](super::Scene::resolve) makes it one from here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<DataFile<Mesh>>,
    /// The built-in mesher; set exactly when `mesh` is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesher: Option<MesherScene>,
    /// The mesh's own names for the parts of the gear.
    pub groups: GroupNames,
    /// How its shaft holds its bore.
    #[serde(skip_serializing_if = "BoreScene::is_default")]
    pub bore: BoreScene,
    /// What it is made of.
    pub material: Material,
    /// Micro-geometry of the flanks.
    #[serde(skip_serializing_if = "ModificationScene::is_none")]
    pub modification: ModificationScene,
    /// Rigid body; set exactly when the analysis is dynamic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<BodyScene>,
    /// What holds its free coordinates.
    #[serde(skip_serializing_if = "BearingScene::is_none")]
    pub bearing: BearingScene,
    /// The shaft it sits on; set exactly for the model of shafts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaft: Option<ShaftScene>,
}

/// Shaper cutter of an internal gear.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ShaperScene {
    /// Number of teeth.
    pub teeth: u32,
    /// Profile shift coefficient.
    pub profile_shift: f64,
    /// Radius of its rounded tip edges over the module.
    pub tip_rounding_coefficient: f64,
}

/// How a shaft holds a bore.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BoreScene {
    /// Part of it that is held, from and to, mm from mid-face; `None`: all of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub held_mm: Option<[f64; 2]>,
    /// How it follows.
    pub coupling: Coupling,
}

impl Default for BoreScene {
    fn default() -> Self {
        Self { held_mm: None, coupling: Coupling::Kinematic }
    }
}

impl BoreScene {
    /// Whether all of the bore is rigid.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Options of the structured mesher.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct MesherScene {
    /// 1: hex8, 2: hex20.
    pub order: u32,
    /// Elements along the active flank.
    pub elements_profile: u32,
    /// Elements along the root fillet.
    pub elements_fillet: u32,
    /// Elements across the tooth.
    pub elements_thickness: u32,
    /// Elements along the face width.
    pub elements_face: u32,
    /// Elements from the root circle to the bore.
    pub elements_rim: u32,
    /// 0: whole gear; 1: periodic sector, which stands for the whole gear where it is run; k: open sector of k teeth,
    /// cut faces free.
    pub sector_teeth: u32,
}

/// Linear elastic and isotropic.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Material {
    /// Young's modulus, MPa.
    pub young_mpa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density, kg/m^3.
    pub density_kg_m3: f64,
}

/// What both gears share.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PairScene {
    /// Normal module, mm.
    pub normal_module_mm: f64,
    /// Normal pressure angle, degrees.
    pub normal_pressure_angle_deg: f64,
    /// Face width of gears that state none of their own, mm; the narrower one where both do and this is left out.
    pub face_width_mm: f64,
    /// Height of the wheel's mid-face over the pinion's along +z, mm; `None`: 0, in a gearbox where the shafts have the
    /// gears.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mid_face_offset_mm: Option<f64>,
    /// Working centre distance, without the sign of an internal pair, mm; `None`: the nominal one that follows from the profile shifts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_distance_mm: Option<f64>,
    /// Addendum of the basic rack over the normal module.
    pub addendum_coefficient: f64,
    /// Dedendum of the basic rack over the normal module.
    pub dedendum_coefficient: f64,
    /// Tip radius of the basic rack over the normal module.
    pub root_radius_coefficient: f64,
    /// Deviation of the axes from each other.
    #[serde(skip_serializing_if = "MisalignmentScene::is_none")]
    pub misalignment: MisalignmentScene,
}

impl MisalignmentScene {
    /// Whether the axes are parallel.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

impl GearScene {
    /// Whether it is a ring.
    pub fn is_internal(&self) -> bool {
        self.shaper.is_some()
    }

    /// Helix angle, rad.
    pub fn helix_angle(&self) -> f64 {
        self.helix_angle_deg.to_radians()
    }

    /// Face width, mm: its own, or that of the pair.
    pub fn width_mm(&self, pair: &PairScene) -> f64 {
        self.face_width_mm.unwrap_or(pair.face_width_mm)
    }
}

impl PairScene {
    /// Heights between which gears of some face widths (mm) both have flanks, over the pinion's mid-face, mm; the first
    /// is above the second where they pass each other.
    pub fn common_face_mm(&self, [pinion, wheel]: [f64; 2]) -> [f64; 2] {
        let offset = self.mid_face_offset_mm.unwrap_or(0.0);
        [(-0.5 * pinion).max(offset - 0.5 * wheel), (0.5 * pinion).min(offset + 0.5 * wheel)]
    }

    /// Elements along the face that a mesh of this order asks for on a gear of a width (mm), with root stress or without.
    pub(crate) fn face_elements(&self, width_mm: f64, order: u32, root_stress: bool) -> u32 {
        let resolution = if root_stress { FaceResolution::RootStress } else { FaceResolution::Contact };
        mesh::face_elements(width_mm, self.normal_module_mm, order, resolution)
    }
}
