//! Scenes beside a scene, for derivatives.

use geometry::GearPair;
use ltca::{StaticOptions, Variation};
use scene::{ContactScene, Scene};

use crate::{AnalysisError, failure::Failure, options::options, refused::Refusal};

/// A scene with a little less and a little more of a parameter that meshes and matrices do not know.
#[derive(Debug, Clone)]
pub struct VariedScene {
    /// With less, and with more.
    pub sides: [Scene; 2],
    /// Amount of the change, in the unit of the parameter.
    pub steps: [f64; 2],
}

impl VariedScene {
    /// The neighbours of a scene along a key.
    ///
    /// # Errors
    /// [`AnalysisError`]: a value beside that of the scene is none.
    pub fn by_key(scene: &Scene, key: &str) -> Result<Self, AnalysisError> {
        let value = scene.number_at(key).ok_or_else(Refusal::no_values)?;
        let step = Scene::design_step(key);
        let at = |by: f64| scene.with_number(key, value + by);
        Ok(Self { sides: [at(-step)?, at(step)?], steps: [step; 2] })
    }

    /// Scenes varied by some keys.
    ///
    /// # Errors
    /// As of [`VariedScene::by_key`].
    pub fn by_keys(scene: &Scene, keys: &[String]) -> Result<Vec<Self>, AnalysisError> {
        keys.iter().map(|key| Self::by_key(scene, key)).collect()
    }

    /// The pairs beside the one of `scene`, which is solved with `options`.
    pub(crate) fn variation(&self, scene: &Scene, solved: &StaticOptions) -> Result<Variation, Failure> {
        let side = |own: &Scene| -> Result<(GearPair, StaticOptions), Failure> {
            let own = Scene { contact: ContactScene { slices: scene.contact.slices, ..own.contact }, ..own.clone() };
            let pair = own.gear_pair().map_err(AnalysisError::from)?;
            let options = StaticOptions { window: solved.window, ..options(&own, &pair) };
            Ok((pair, options))
        };
        let [down, up] = &self.sides;
        Ok(Variation::new([side(down)?, side(up)?], self.steps))
    }
}
