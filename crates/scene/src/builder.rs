//! Scenes made in code, without a file.

use std::path::{Path, PathBuf};

use crate::{Scene, SceneError, Setting};

/// Value of a key: number, word, switch, list or table.
pub use toml::Value;

/// A scene that is built key by key and then checked like the text of a file.
///
/// Six keys have no default; each has its own method. Every key of [`all_keys`](crate::all_keys) is set by
/// [`set`](Self::set). If a key is set twice, the last value counts.
///
/// ```
/// let scene = scene::Scene::builder()
///     .pinion(30, 20.0)
///     .wheel(30)
///     .normal_module_mm(3.0)
///     .face_width_mm(20.0)
///     .torque_nm(150.0)
///     .set("pinion.modification.tip_relief_um", 15.0)
///     .set("pinion.modification.tip_relief_start_roll_deg", 25.0)
///     .set("analysis.positions_per_cycle", 16)
///     .build()?;
/// assert_eq!(scene.wheel.helix_angle_deg, -20.0);
/// assert_eq!(scene.gear_pair()?.pinion.data().teeth, 30);
///
/// let wrong = scene::Scene::builder().set("pair.face_widht_mm", 20.0).build().unwrap_err();
/// assert_eq!(wrong.to_string(), "pair.face_widht_mm: unknown key `face_widht_mm`");
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SceneBuilder {
    folder: PathBuf,
    values: Vec<(String, Value)>,
}

/// What messages call a scene that no file has.
const NAME: &str = "scene";

impl Scene {
    /// A scene made in code.
    pub fn builder() -> SceneBuilder {
        SceneBuilder::default()
    }
}

impl SceneBuilder {
    /// Number of teeth, and helix angle at the reference cylinder in degrees, right hand positive. The hand of the
    /// wheel follows from it.
    #[must_use]
    pub fn pinion(self, teeth: u32, helix_angle_deg: f64) -> Self {
        self.set("pinion.teeth", teeth).set("pinion.helix_angle_deg", helix_angle_deg)
    }

    /// Number of teeth of gear 2.
    #[must_use]
    pub fn wheel(self, teeth: u32) -> Self {
        self.set("wheel.teeth", teeth)
    }

    /// Normal module, mm.
    #[must_use]
    pub fn normal_module_mm(self, module: f64) -> Self {
        self.set("pair.normal_module_mm", module)
    }

    /// Face width of both gears, mm.
    #[must_use]
    pub fn face_width_mm(self, width: f64) -> Self {
        self.set("pair.face_width_mm", width)
    }

    /// Torque on the driven gear, N m.
    #[must_use]
    pub fn torque_nm(self, torque: f64) -> Self {
        self.set("operation.torque_nm", torque)
    }

    /// Sets any key, in the unit in which its name ends. Keys are dotted paths (`motion.sweep.from_rpm`). A number in
    /// the path is the index, from 0, of an entry of a list that has been set before.
    #[must_use]
    pub fn set(mut self, key: &str, value: impl Into<Value>) -> Self {
        self.values.push((key.to_owned(), value.into()));
        self
    }

    /// Sets the folder to which paths in the scene are relative; by default the current folder of the process.
    #[must_use]
    pub fn relative_to(self, folder: &Path) -> Self {
        Self { folder: folder.to_owned(), ..self }
    }

    /// The checked scene with all defaults.
    ///
    /// # Errors
    /// [`SceneError`], as for a file; instead of a line it names the key.
    pub fn build(&self) -> Result<Scene, SceneError> {
        let settings: Vec<Setting> =
            self.values.iter().map(|(key, value)| Setting::of(key, value)).collect::<Result<_, _>>()?;
        let scene = Scene::parse_with("", &self.folder.join(NAME), &settings)?;
        // Nothing was set beside it: these are the scene.
        Ok(Scene { set: Vec::new(), ..scene })
    }
}
