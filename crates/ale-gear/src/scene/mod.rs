//! The scene: what a user wrote, read and checked before any work starts.
//!
//! Two steps, so that every complaint can name file, line, key, value and allowed range:
//! typed words as they stand in the file (`raw`), then the checked [`Scene`] with every default filled in.
//! Values keep the units of their keys; the methods hand them on in mm, N, MPa, t, s, rad.

mod check;
mod error;
mod excerpt;
mod hints;
mod keys;
mod ladder;
mod micro;
mod motion;
mod raw;
mod schema;
mod setting;
mod source;
mod written;

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use geometry::Side;
use mesh::GroupNames;
use serde::Serialize;

pub use error::{Line, Place, SceneError};
pub(crate) use keys::nearest;
pub use ladder::{
    DiscScene, ImpactScene, Kept, Law, Lumped8Scene, Lumped12Scene, MeshScene, Shaft18Scene, ShaftScene, Sharing,
    StiffnessFrom, SupportScene,
};
pub use micro::{FlankScene, MisalignmentScene, ModificationScene, Shape};
pub use motion::{
    Axis, BearingScene, BodyScene, Boundary, DriveBy, DriveScene, Integration, ModesScene, MotionScene, RampScene, Run,
    SteadyBy, SweepScene, SweepWay, TorqueScene,
};
pub(crate) use raw::{Number, Whole, Word};
pub use schema::{all_keys, json_schema};
pub use setting::Setting;
pub(crate) use source::Source;
pub use written::Written;

/// A checked scene. Serialised it is the scene file again, with every default written out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scene {
    /// Name of the case, for titles.
    pub name: String,
    /// Where the scene stands; paths in it are relative to its folder.
    #[serde(skip)]
    pub file: PathBuf,
    /// What was written.
    #[serde(skip)]
    pub written: Written,
    /// Words of a command line that set keys beside the file.
    #[serde(skip)]
    pub set: Vec<String>,
    /// Gear 1.
    pub pinion: GearScene,
    /// Gear 2.
    pub wheel: GearScene,
    /// What both share.
    pub pair: PairScene,
    /// Load and motion.
    pub operation: Operation,
    /// How flanks press on each other.
    pub contact: ContactScene,
    /// What drives the driver; set exactly when the analysis is dynamic, as the next two.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drive: Option<DriveScene>,
    /// What the torque on the driven gear is beside its mean.
    #[serde(skip_serializing_if = "load_is_steady")]
    pub load: Option<TorqueScene>,
    /// What is computed.
    pub analysis: Analysis,
    /// Normal modes; set exactly with the model that keeps them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modes: Option<ModesScene>,
    /// Motion in time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionScene>,
    /// Mesh of a model that has a stiffness instead of flanks; set exactly for these.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<MeshScene>,
    /// The model with eight coordinates; set exactly for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lumped8: Option<Lumped8Scene>,
    /// The model with twelve; likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lumped12: Option<Lumped12Scene>,
    /// Rigid gears on their true flanks; likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impact: Option<ImpactScene>,
    /// Lumped shafts; likewise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaft18: Option<Shaft18Scene>,
    /// Which files are written beside the three that always are.
    pub output: OutputScene,
}

fn is_false(value: &bool) -> bool {
    !value
}

fn is_zero(value: &u32) -> bool {
    *value == 0
}

fn load_is_steady(load: &Option<TorqueScene>) -> bool {
    load.as_ref().is_none_or(TorqueScene::is_none)
}

/// One gear.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GearScene {
    /// Number of teeth.
    pub teeth: u32,
    /// Helix angle at the reference cylinder, right hand positive, degrees.
    pub helix_angle_deg: f64,
    /// Diameter of the rigid bore, mm.
    pub bore_diameter_mm: f64,
    /// Profile shift coefficient.
    pub profile_shift: f64,
    /// Tip diameter, mm; `None`: from addendum and profile shift.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_diameter_mm: Option<f64>,
    /// Radius of the arc that rounds the tip edges, mm; 0: sharp.
    pub tip_edge_radius_mm: f64,
    /// Thinning of the tooth in the normal section, mm.
    pub thickness_allowance_mm: f64,
    /// Cumulative pitch deviation of each tooth, um; empty: none, or in a file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pitch_errors_um: Vec<f64>,
    /// File of them, as written in the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch_errors_file: Option<PathBuf>,
    /// Mesh file as written in the scene; [`Scene::resolve`] makes it a path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<PathBuf>,
    /// The built-in mesher; set exactly when `mesh` is not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesher: Option<MesherScene>,
    /// The mesh's own names for the parts of the gear.
    pub groups: GroupNames,
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
    /// 0: whole gear; 1: periodic sector, which stands for the whole gear where it is run; k: open sector of k teeth, cut faces free.
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
    /// Face width of both gears, mm.
    pub face_width_mm: f64,
    /// Working centre distance, mm; `None`: the nominal one that follows from the profile shifts.
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

/// Load and motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Operation {
    /// The gear that drives.
    pub driver: Driver,
    /// Sense of rotation of the pinion, seen from +z.
    pub rotation: Rotation,
    /// Torque on the driven gear, N m.
    pub torque_nm: f64,
    /// Speed of the driver, 1/min.
    pub speed_rpm: f64,
}

/// The gear that drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Driver {
    /// Gear 1.
    Pinion,
    /// Gear 2.
    Wheel,
}

/// Sense of rotation seen from +z.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Rotation {
    /// Counter-clockwise.
    Ccw,
    /// Clockwise.
    Cw,
}

/// How flanks press on each other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactScene {
    /// Where the contact unknowns sit.
    pub method: Method,
    /// Slices over the face width; `None` for the method nodal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slices: Option<u32>,
    /// Whether tip edges may press off the line of action; `None` for the method nodal, where they always may.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner_contact: Option<bool>,
    /// Coefficient of friction.
    pub friction: f64,
    /// Pressure a mm of penetration, MPa/mm; `None`: exact complementarity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub penalty_mpa_per_mm: Option<f64>,
    /// Which surface gives the gaps; `None` for slices.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap: Option<Gap>,
    /// Contact points along each edge of a flank face; `None` for slices.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points_per_face_edge: Option<u32>,
    /// Which flanks may touch.
    pub flanks: Flanks,
}

/// Where the contact unknowns sit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// One line load an axial slice.
    Slice,
    /// Quadrature points of the flank mesh.
    Nodal,
}

/// Which surface gives the gaps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Gap {
    /// The exact involute helicoid.
    Smooth,
    /// The faces of the mesh: for showing what facets do to the transmission error, not for engineering.
    Facet,
}

/// Which flanks may touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Flanks {
    /// Those that the torque presses together.
    Driving,
    /// Both sides.
    Both,
}

/// What is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Analysis {
    /// Quasi-static or in time.
    pub kind: Kind,
    /// Which rung of the ladder of models.
    pub model: Model,
    /// Which way gears are condensed; only the reduced model has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reduction: Option<Reduction>,
    /// Positions in one mesh cycle, the end point left out.
    pub positions_per_cycle: u32,
    /// Mesh cycles; 0 where they follow from a duration or a ramp.
    #[serde(skip_serializing_if = "is_zero")]
    pub cycles: u32,
    /// Teeth in the window; `None`: floor(eps_gamma) + 1, at least 3.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub window_teeth: Option<u32>,
}

/// Which way gears are condensed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Reduction {
    /// One sector where the gear is cyclic, else the whole gear.
    Auto,
    /// The whole gear in one factor.
    General,
}

/// Quasi-static or in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Equilibrium at every position.
    Static,
    /// Motion in time.
    Dynamic,
}

/// A model of the pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Model {
    /// ISO 6336-1 stiffness and analytic contact lines; no mesh.
    Iso,
    /// Flanks of the tooth window.
    Reduced,
    /// The same with normal modes of both gears, in time.
    #[serde(rename = "reduced+modes")]
    ReducedModes,
    /// Every degree of freedom of both meshes.
    Full,
    /// Eight coordinates, mesh stiffness, backlash and friction.
    Lumped8,
    /// Twelve coordinates.
    Lumped12,
    /// Two lumped shafts with the mesh between them.
    Shaft18,
    /// Rigid gears, force by overlap of their true flanks.
    Impact,
}

impl Model {
    /// Whether gears are known from their flanks.
    pub fn is_reduced(self) -> bool {
        matches!(self, Self::Reduced | Self::ReducedModes)
    }
}

/// What is computed on request, and which files are written beside `summary.json`, `history.csv` and `report.html`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OutputScene {
    /// Stress in the root fillets at every position.
    pub root_stress: bool,
    /// The contact lines slice by slice.
    pub contact_lines: bool,
    /// The history column by column as well, in `history.parquet`.
    #[serde(skip_serializing_if = "is_false")]
    pub parquet: bool,
    /// ParaView files.
    pub vtu: bool,
    /// Fields in them.
    pub fields: Vec<FieldName>,
    /// One ParaView file every so many positions.
    pub vtu_every: u32,
}

/// A field of the ParaView files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum FieldName {
    /// Displacement of every node, mm.
    Displacement,
    /// Contact pressure at flank nodes, MPa.
    Pressure,
    /// Stress tensor and von Mises stress, MPa.
    Stress,
}

impl Scene {
    /// Reads and checks a scene file.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the file.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        Self::read_with(file, &[])
    }

    /// Reads and checks a scene file with some of its keys set otherwise; of two settings of a key the last one holds.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the file or the setting.
    pub fn read_with(file: &Path, settings: &[Setting]) -> Result<Self, SceneError> {
        let text =
            std::fs::read_to_string(file).map_err(|source| SceneError::Read { file: file.to_owned(), source })?;
        Self::parse_with(&text, file, settings)
    }

    /// Checks the text of a scene; `file` is what messages name and what paths are relative to.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the file.
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        Self::parse_with(text, file, &[])
    }

    /// The same with some of its keys set otherwise.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the file or the setting.
    pub fn parse_with(text: &str, file: &Path, settings: &[Setting]) -> Result<Self, SceneError> {
        let (all, ranges) = setting::below(text, settings);
        let source = source::Source::scene(file, &all, settings, &ranges);
        let scene = check::scene(&source, raw::read(&source)?)?;
        Ok(Self { set: settings.iter().map(Setting::word).collect(), ..scene })
    }

    /// The scene file that says the same with every default written out.
    pub fn to_toml(&self) -> String {
        // A struct of numbers, strings and tables: there is nothing that TOML could refuse.
        toml::to_string(self).unwrap_or_default()
    }

    /// The path that a path written in the scene stands for.
    pub fn resolve(&self, path: &Path) -> PathBuf {
        match self.file.parent() {
            Some(folder) => folder.join(path),
            None => path.to_owned(),
        }
    }

    /// Pinion and wheel.
    pub fn gears(&self) -> [&GearScene; 2] {
        [&self.pinion, &self.wheel]
    }

    /// The side of the pinion's teeth that the torque presses: its left flanks when it drives counter-clockwise.
    pub fn side(&self) -> Side {
        match (self.operation.driver, self.operation.rotation) {
            (Driver::Pinion, Rotation::Ccw) | (Driver::Wheel, Rotation::Cw) => Side::Left,
            (Driver::Pinion, Rotation::Cw) | (Driver::Wheel, Rotation::Ccw) => Side::Right,
        }
    }

    /// Gear ratio z2/z1.
    pub fn ratio(&self) -> f64 {
        f64::from(self.wheel.teeth) / f64::from(self.pinion.teeth)
    }

    /// Angular speed of the pinion, rad/s, positive in the sense of rotation.
    pub fn pinion_speed(&self) -> f64 {
        let driver = self.operation.speed_rpm * PI / 30.0;
        match self.operation.driver {
            Driver::Pinion => driver,
            Driver::Wheel => driver * self.ratio(),
        }
    }
}

impl Rotation {
    /// +1 counter-clockwise, -1 clockwise.
    pub fn sign(self) -> f64 {
        match self {
            Self::Ccw => 1.0,
            Self::Cw => -1.0,
        }
    }
}

impl Operation {
    /// Torque on the driven gear, N mm.
    pub fn torque(&self) -> f64 {
        self.torque_nm * 1e3
    }
}

impl Material {
    /// Density, t/mm^3.
    pub fn density(&self) -> f64 {
        self.density_kg_m3 * 1e-12
    }
}

impl GearScene {
    /// Helix angle, rad.
    pub fn helix_angle(&self) -> f64 {
        self.helix_angle_deg.to_radians()
    }
}

impl PairScene {
    /// Normal pressure angle, rad.
    pub fn normal_pressure_angle(&self) -> f64 {
        self.normal_pressure_angle_deg.to_radians()
    }
}
