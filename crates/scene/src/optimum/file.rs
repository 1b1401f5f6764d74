//! A checked optimisation, and the scenes of its designs.

use std::path::{Path, PathBuf};

use cases::{Cases, Sampling};
use design::Goal;

use crate::{Document, Scene, SceneError, Setting, plan::PlanAxis};

/// A scene, what of it may change, and what shall be small.
#[derive(Debug, Clone)]
pub struct Optimisation {
    /// Title.
    pub name: String,
    /// Where it stands; the path of the scene is relative to its folder.
    pub file: PathBuf,
    /// The scene.
    pub document: Document,
    /// The scene without any design.
    pub drawn: Scene,
    /// Keys that all designs have otherwise.
    pub settings: Vec<Setting>,
    /// What may change.
    pub parameters: Vec<DesignParameter>,
    /// Torques at which it counts; at least one.
    pub torques: Vec<TorqueWeight>,
    /// What shall be small.
    pub goal: Goal,
    /// Limit of the contact pressure, MPa.
    pub max_pressure_mpa: Option<f64>,
    /// Limit of it at end faces and tip edges, MPa.
    pub max_edge_pressure_mpa: Option<f64>,
    /// Evaluations at the most.
    pub evaluations: u32,
    /// Points of the trade-off between the goal and the largest pressure; 0: none.
    pub front: u32,
    /// Slices of all designs; `None`: each chooses its own.
    pub slices: Option<u32>,
    /// Keys that scatter, and how samples of them are drawn; deviations from what the design says.
    pub tolerances: Vec<PlanAxis>,
    /// How they are spread.
    pub sampling: Sampling,
    /// Samples of the deviations; one without deviations where nothing scatters.
    pub samples: Cases,
}

/// Keys of one value that may change.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignParameter {
    /// At least one; the first one names it.
    pub keys: Vec<String>,
    /// Lowest and highest value.
    pub bounds: [f64; 2],
    /// Where the search begins.
    pub start: f64,
    /// Value of the document, where that lies outside of the bounds and the search begins at the nearer one.
    pub outside: Option<f64>,
    /// What values are whole multiples of in the end; 0: any.
    pub grain: f64,
}

/// A torque on the driven gear and what it counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueWeight {
    /// Torque, N m.
    pub torque_nm: f64,
    /// Weight, above 0.
    pub weight: f64,
}

impl DesignParameter {
    /// The key that it is named by.
    pub fn name(&self) -> &str {
        self.keys.first().map_or("", String::as_str)
    }

    /// Checks that the search does not begin at the value of the document.
    pub fn begins_elsewhere(&self) -> Option<String> {
        let Self { bounds: [low, high], start, .. } = self;
        let own = self.outside?;
        Some(format!("`{}` is {own}, outside of {low} .. {high}: the search begins at {start}", self.name()))
    }

    /// A step that moves flanks by some 1e-5 mm, for differences.
    pub fn step(&self) -> f64 {
        let unit = |ending: &str| self.name().ends_with(ending);
        if unit("_um") {
            0.01
        } else if unit("_deg") || unit("_mm") {
            1e-3
        } else {
            1e-5 * (self.bounds[1] - self.bounds[0]).max(f64::MIN_POSITIVE)
        }
    }
}

/// Key of the torque.
pub(super) const TORQUE: &str = "operation.torque_nm";

/// The value of a key that a search changes, named in messages as the word that asks for it.
///
/// # Errors
/// As of [`Setting::number`].
pub(super) fn varied(key: &str, value: f64) -> Result<Setting, SceneError> {
    Setting::number(key, value).map(|own| own.called(&format!("--vary {key}")))
}

impl Optimisation {
    /// Number of samples.
    pub fn samples(&self) -> usize {
        if self.tolerances.is_empty() { 1 } else { self.samples.count() }
    }

    /// Settings of a design at a torque, in a sample.
    fn settings_of(&self, values: &[f64], torque_nm: f64, sample: Option<usize>) -> Result<Vec<Setting>, SceneError> {
        let mut all = self.settings.clone();
        for (parameter, value) in self.parameters.iter().zip(values) {
            for key in &parameter.keys {
                all.push(varied(key, *value)?);
            }
        }
        let deviations = sample.filter(|_| !self.tolerances.is_empty()).map(|s| self.samples.values(s));
        for (axis, deviation) in self.tolerances.iter().zip(deviations.unwrap_or_default()) {
            if let Some(pitch) = &axis.pitch {
                all.push(pitch.setting(deviation)?);
                continue;
            }
            for key in &axis.keys {
                let of_design = self.parameters.iter().position(|p| p.keys.contains(key)).map(|k| values[k]);
                let own = match of_design {
                    Some(value) => value,
                    None => self.drawn(key)?,
                };
                all.push(Setting::number(key, own + deviation)?);
            }
        }
        all.push(Setting::number(TORQUE, torque_nm)?);
        if let Some(slices) = self.slices {
            all.push(Setting::number("contact.slices", f64::from(slices))?);
        }
        Ok(all)
    }

    /// The scene file.
    pub fn scene_file(&self) -> &Path {
        self.document.file()
    }

    /// What the scene without any design says of a key.
    fn drawn(&self, key: &str) -> Result<f64, SceneError> {
        self.drawn.number_at(key).ok_or_else(|| SceneError::NoKey { key: key.to_owned() })
    }

    /// The scene of a design at a torque: of a sample, or as it is drawn.
    ///
    /// # Errors
    /// [`SceneError`]: what the scene does not allow.
    pub fn scene(&self, values: &[f64], torque_nm: f64, sample: Option<usize>) -> Result<Scene, SceneError> {
        self.document.scene(&self.settings_of(values, torque_nm, sample)?)
    }

    /// The scene of a design as the file has it: at its own torque.
    ///
    /// # Errors
    /// As [`Optimisation::scene`].
    pub fn own_scene(&self, values: &[f64]) -> Result<Scene, SceneError> {
        self.scene(values, self.drawn.operation.torque_nm, None)
    }

    /// The values at which the search begins.
    pub fn start(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.start).collect()
    }
}
