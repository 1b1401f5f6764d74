//! Scene files: reading and checking of the input before any work starts.
//!
//! Reading has two steps, so that every error can name file, line, key, value and allowed range. The first step gives
//! typed values as they are in the file (`raw`), the second the checked [`Scene`] with all defaults. Values keep the
//! units of their keys; methods return them in mm, N, MPa, t, s, rad.
//!
//! Each group of files depends only on its own row and on the rows above:
//!
//! | layer | files |
//! |---|---|
//! | words | `units`, `hints`, `keys`, `spanned`, `excerpt`, `error`, `table` (what a row of keys is) |
//! | text | `tree` (tables and values with their places), `setting`, `document` (a file, read once), `places` (of keys), `source` and `source_values` (words, ranges, complaints), `data_file`, `inputs` (files that it names) |
//! | schema | `schema` (every key with its type, range, default and choices), `raw` (what is read) |
//! | checked tables | `gear`, `modification`, `motion`, `models`, `contact`, `accuracy`, `output`, ...; `solver_units` (their numbers in mm, N, t, s, rad) |
//! | scene | [`Scene`], `check`, `default_scene`, `builder`, and the readers of the other kinds of file |

#[macro_use]
mod checked_macros;
#[macro_use]
mod macros;

mod accuracy;
mod analysis;
mod builder;
mod check;
mod data_file;
mod default_scene;
mod design_key;
mod document;
mod document_kind;
mod error;
mod excerpt;
mod gear;
mod gear_pair;
pub mod gearbox;
mod geometry_fault;
mod hints;
mod input_text;
mod inputs;
mod key_tables;
mod keys;
mod machine;
mod models;
mod modification;
mod motion;
pub mod optimum;
mod origin;
mod output;
mod places;
pub mod plan;
mod rating;
mod raw;
mod rexs;
mod schema;
mod setting;
mod solver_units;
mod source;
mod source_values;
mod spanned;
mod starter;
pub mod study;
mod table;
mod tree;
pub mod units;
mod wrong_line;

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use geometry::Side;
use serde::Serialize;

pub use accuracy::{AccuracyScene, Tolerance, ToleranceError};
pub use builder::{SceneBuilder, Value};
pub use data_file::DataFile;
pub use document::Document;
pub use document_kind::DocumentKind;
pub use error::SceneError;
pub use files::{Line, Place};
pub use geometry::{Driver, Sense};
pub use input_text::read_text;
pub use key_tables::{KeyTable, key_tables};
pub use keys::{Tables, nearest};
pub use machine::Machine;
pub use motion::{DriveScene, TorqueScene};
pub use places::Written;
pub use rexs::{RexsError, RexsGearbox, RexsPair, RexsShaft, read_gearbox, read_pair, read_rexs, read_shaft, rexs_of};
pub use schema::{
    Analysis, Axis, BasinScene, BearingScene, BodyScene, BoltsScene, BoreScene, Boundary, ContactScene,
    ContinuationKey, ContinuationScene, Coupling, DiscScene, DriveBy, FieldName, FlankScene, Flanks, Gap, GearScene,
    ImpactScene, Integration, Kind, Law, LubricationScene, Lumped8Scene, Lumped12Scene, Material, MeshScene,
    MesherScene, Method, MisalignmentScene, Model, ModesScene, ModificationScene, MotionScene, Operation, OutputScene,
    PairScene, Quantity, RampScene, RatedGearScene, RatingEdition, RatingScene, Reduction, Run, Shaft18Scene,
    ShaftCoordinate, ShaftScene, ShaperScene, Sharing, SteadyBy, StiffnessFrom, SupportScene, SweepScene, SweepWay,
    Turn, all_keys, json_schema,
};
pub use setting::Setting;
pub use solver_units::RPM;
pub use source::Source;
pub use spanned::{Number, Whole, Word};
pub use starter::{Starter, Steel};

impl Document {
    /// The scene of the document, with some keys set to other values. If a key is set twice, the last setting counts.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the file or the setting.
    pub fn scene(&self, settings: &[Setting]) -> Result<Scene, SceneError> {
        checked(&raw::source(self, settings))
    }

    /// The scene that it is of a mesh of a gearbox.
    ///
    /// # Errors
    /// As [`Document::scene`].
    pub(crate) fn scene_of_mesh(&self, settings: &[Setting]) -> Result<Scene, SceneError> {
        checked(&raw::source(self, settings).of_mesh())
    }
}

fn checked(source: &Source<'_>) -> Result<Scene, SceneError> {
    let checked = raw::read(source).and_then(|raw| check::scene(source, raw));
    checked.map_err(|e| source.of_kind(e, DocumentKind::Scene))
}

/// A checked scene. Serialised, it is the scene file with all defaults written out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scene {
    /// Name of the case, for titles.
    pub name: String,
    /// Path of the scene; paths in it are relative to its folder.
    #[serde(skip)]
    pub file: PathBuf,
    /// Places of its keys, and the content of the files that it names.
    #[serde(skip)]
    pub written: Written,
    /// Words of a command line that set keys in addition to the file.
    #[serde(skip)]
    pub set: Vec<String>,
    /// Pinion (gear 1).
    pub pinion: GearScene,
    /// Wheel (gear 2).
    pub wheel: GearScene,
    /// Data common to both gears.
    pub pair: PairScene,
    /// Load and motion.
    pub operation: Operation,
    /// Contact of the flanks.
    pub contact: ContactScene,
    /// Drive of the driver. This and the next two fields are set exactly if the analysis is dynamic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drive: Option<DriveScene>,
    /// Variation of the torque on the driven gear about its mean.
    #[serde(skip_serializing_if = "load_is_steady")]
    pub load: Option<TorqueScene>,
    /// Analysis to be run.
    pub analysis: Analysis,
    /// Accuracy requested for the headline values.
    #[serde(skip_serializing_if = "AccuracyScene::is_none")]
    pub accuracy: AccuracyScene,
    /// Normal modes; set exactly for the model that keeps them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modes: Option<ModesScene>,
    /// Motion in time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionScene>,
    /// Mesh of a model with a given stiffness instead of flanks; set exactly for such models.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<MeshScene>,
    /// The model with eight coordinates; set exactly for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lumped8: Option<Lumped8Scene>,
    /// The model with twelve coordinates; set exactly for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lumped12: Option<Lumped12Scene>,
    /// Rigid gears with their true flanks; set exactly for this model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impact: Option<ImpactScene>,
    /// Lumped shafts; set exactly for this model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shaft18: Option<Shaft18Scene>,
    /// Rating of the pair, if requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rating: Option<RatingScene>,
    /// Optional output files, in addition to the three that are always written.
    pub output: OutputScene,
}

/// The path of a file of a scene as it is from anywhere.
fn absolute_path(scene: &Scene, path: &Path) -> PathBuf {
    let whole = scene.resolve(path);
    std::path::absolute(&whole).unwrap_or(whole)
}

fn load_is_steady(load: &Option<TorqueScene>) -> bool {
    load.as_ref().is_none_or(TorqueScene::is_none)
}

impl Scene {
    /// Reads and checks a scene file.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the file.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        Self::read_with(file, &[])
    }

    /// Reads and checks a scene file with some keys set to other values. If a key is set twice, the last setting
    /// counts.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the file or the setting.
    pub fn read_with(file: &Path, settings: &[Setting]) -> Result<Self, SceneError> {
        Document::read(file)?.scene(settings)
    }

    /// Checks the text of a scene. `file` is used in messages, and paths are relative to its folder.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the file.
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        Self::parse_with(text, file, &[])
    }

    /// Scene of a text with some keys set to other values.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the file or the setting.
    pub fn parse_with(text: &str, file: &Path, settings: &[Setting]) -> Result<Self, SceneError> {
        Document::new(text.to_owned(), file).scene(settings)
    }

    /// The equivalent scene file with all defaults written out.
    pub fn to_toml(&self) -> String {
        // A struct of numbers, strings and tables: there is nothing that TOML could refuse.
        toml::to_string(self).unwrap_or_default()
    }

    /// This scene with absolute paths, valid from any folder.
    pub fn standing_alone(&self) -> Self {
        let mut all = self.clone();
        for gear in [&mut all.pinion, &mut all.wheel] {
            let GearScene { modification, mesh, pitch_errors_file, .. } = gear;
            let absolute = |path: &Path| absolute_path(self, path);
            for file in [&mut modification.drive.topography, &mut modification.coast.topography].into_iter().flatten() {
                file.set_path(absolute(file.path()));
            }
            if let Some(file) = pitch_errors_file {
                file.set_path(absolute(file.path()));
            }
            if let Some(file) = mesh {
                file.set_path(absolute(file.path()));
            }
        }
        if let Some(rating) = &mut all.rating {
            if let Some(file) = &mut rating.materials {
                file.set_path(absolute_path(self, file.path()));
            }
            if let Some(file) = &mut rating.spectrum {
                file.set_path(absolute_path(self, file.path()));
            }
            if let Some(file) = &mut rating.lubricants {
                file.set_path(absolute_path(self, file.path()));
            }
        }
        all
    }

    /// The value of a numeric key in the scene, defaults included. For a modification of both flanks it is that of the
    /// driving ones. Micro-geometry or misalignment that is not given is 0; `None` if the key is not numeric.
    pub fn number_at(&self, key: &str) -> Option<f64> {
        let table: toml::Table = toml::from_str(&self.to_toml()).ok()?;
        let mut parts = setting::path(key)?;
        let of_flank = parts.get(1).is_some_and(|part| part == "modification");
        if of_flank && !parts.get(2).is_some_and(|part| part == "drive" || part == "coast") {
            parts.insert(2, "drive".into());
        }
        let no_amount = (of_flank && key.ends_with("_um")) || key.starts_with("pair.misalignment.");
        let mut value = Some(toml::Value::Table(table));
        for part in &parts {
            value = match value? {
                toml::Value::Table(mut table) => table.remove(part),
                toml::Value::Array(list) => list.into_iter().nth(part.parse().ok()?),
                _ => return None,
            };
            if value.is_none() && no_amount {
                return Some(0.0);
            }
        }
        let value = value?;
        value.as_float().or_else(|| value.as_integer().map(|n| n as f64))
    }

    /// The path to which a path in the scene refers.
    pub fn resolve(&self, path: &Path) -> PathBuf {
        origin::resolved(&self.file, path)
    }

    /// Pinion and wheel.
    pub fn gears(&self) -> [&GearScene; 2] {
        [&self.pinion, &self.wheel]
    }

    /// Young's modulus (MPa) and Poisson's ratio of pinion and wheel.
    pub fn elasticity(&self) -> [(f64, f64); 2] {
        self.gears().map(|gear| (gear.material.young_mpa, gear.material.poisson))
    }

    /// The side of the pinion's teeth that the torque loads: the left flanks if it drives counter-clockwise.
    pub fn side(&self) -> Side {
        self.operation.side()
    }

    /// Number of teeth of the driving gear.
    pub fn driver_teeth(&self) -> u32 {
        match self.operation.driver {
            Driver::Pinion => self.pinion.teeth,
            Driver::Wheel => self.wheel.teeth,
        }
    }

    /// Whether the contact of the scene has slices of its own, which a contact pattern needs.
    pub fn has_slices(&self) -> bool {
        matches!(self.analysis.model, Model::Reduced | Model::Auto | Model::Full)
            && self.contact.method == Method::Slice
    }

    /// Face widths of pinion and wheel, mm.
    pub fn face_widths_mm(&self) -> [f64; 2] {
        self.gears().map(|gear| gear.width_mm(&self.pair))
    }

    /// Width over which both gears have flanks, mm; 0 if they pass each other.
    pub fn common_face_width_mm(&self) -> f64 {
        let [from, to] = self.pair.common_face_mm(self.face_widths_mm());
        (to - from).max(0.0)
    }

    /// Elements along the face that a gear needs for elements of this order; the default of `elements_face`.
    pub fn face_elements(&self, gear: &GearScene, order: u32) -> u32 {
        self.pair.face_elements(gear.width_mm(&self.pair), order, self.output.root_stress)
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
