//! A checked optimisation, and the scenes of its designs.

use std::path::{Path, PathBuf};

use cases::{Cases, Sampling};
use design::Goal;

use crate::{Document, Scene, SceneError, Setting, plan::PlanAxis};

/// A scene, the keys that may change, and the goal to be minimised.
#[derive(Debug, Clone)]
pub struct Optimisation {
    /// Title.
    pub name: String,
    /// Path of the file; the path of the scene is relative to its folder.
    pub file: PathBuf,
    /// The scene.
    pub document: Document,
    /// The scene of the drawing, without any design.
    pub drawn: Scene,
    /// Keys that are set to other values in all designs.
    pub settings: Vec<Setting>,
    /// Parameters of the design.
    pub parameters: Vec<DesignParameter>,
    /// Torques at which the goal is evaluated; at least one.
    pub torques: Vec<TorqueWeight>,
    /// Goal to be minimised.
    pub goal: Goal,
    /// Limit of the contact pressure, MPa.
    pub max_pressure_mpa: Option<f64>,
    /// Limit of the contact pressure at end faces and tip edges, MPa.
    pub max_edge_pressure_mpa: Option<f64>,
    /// Largest number of evaluations.
    pub evaluations: u32,
    /// Number of points of the trade-off between the goal and the largest pressure; 0: none.
    pub front: u32,
    /// Slices of all designs; `None`: each design chooses its own number.
    pub slices: Option<u32>,
    /// Keys with tolerances, as deviations from the design, and how their samples are drawn.
    pub tolerances: Vec<PlanAxis>,
    /// Sampling method.
    pub sampling: Sampling,
    /// Samples of the deviations; one sample without deviations if nothing varies.
    pub samples: Cases,
}

/// Keys that always have the same value, which may change.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignParameter {
    /// The keys, at least one; the first one is the name.
    pub keys: Vec<String>,
    /// Lowest and highest value.
    pub bounds: [f64; 2],
    /// Initial value of the search.
    pub start: f64,
    /// Value in the document, if it is outside the bounds and the search begins at the nearer bound.
    pub outside: Option<f64>,
    /// Step of the final values, which are whole multiples of it; 0: no rounding.
    pub grain: f64,
}

/// A torque on the driven gear and its weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueWeight {
    /// Torque, N m.
    pub torque_nm: f64,
    /// Weight, above 0.
    pub weight: f64,
}

impl DesignParameter {
    /// The key that is its name.
    pub fn name(&self) -> &str {
        self.keys.first().map_or("", String::as_str)
    }

    /// Message if the search does not begin at the value in the document.
    pub fn begins_elsewhere(&self) -> Option<String> {
        let Self { bounds: [low, high], start, .. } = self;
        let own = self.outside?;
        Some(format!("`{}` is {own}, outside of {low} .. {high}: the search begins at {start}", self.name()))
    }

    /// A step that moves flanks by about 1e-5 mm, for differences.
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
                if let Some(word) = axis.word(key, deviation) {
                    all.push(word?);
                    continue;
                }
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

    /// The scene of a design at a torque: with the deviations of a sample, or nominal.
    ///
    /// # Errors
    /// [`SceneError`] if the scene does not permit the values.
    pub fn scene(&self, values: &[f64], torque_nm: f64, sample: Option<usize>) -> Result<Scene, SceneError> {
        self.document.scene(&self.settings_of(values, torque_nm, sample)?)
    }

    /// The scene of a design at the torque of the file.
    ///
    /// # Errors
    /// The errors of [`Optimisation::scene`].
    pub fn own_scene(&self, values: &[f64]) -> Result<Scene, SceneError> {
        self.scene(values, self.drawn.operation.torque_nm, None)
    }

    /// Initial values of the search.
    pub fn start(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.start).collect()
    }
}
