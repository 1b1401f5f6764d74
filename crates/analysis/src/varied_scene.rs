//! Neighbouring scenes of a scene, for derivatives.

use geometry::GearPair;
use ltca::{StaticOptions, Variation};
use scene::{ContactScene, Scene};

use crate::{AnalysisError, failure::Failure, options::options, refused::Refusal};

/// A scene with slightly smaller and slightly larger values of a parameter on which meshes and matrices do not depend.
#[derive(Debug, Clone)]
pub struct VariedScene {
    /// Scenes with the smaller and with the larger value.
    pub sides: [Scene; 2],
    /// Amount of the change, in the unit of the parameter.
    pub steps: [f64; 2],
}

impl VariedScene {
    /// The neighbours of a scene along a key.
    ///
    /// # Errors
    /// [`AnalysisError`] if a neighbouring value is not valid.
    pub fn by_key(scene: &Scene, key: &str) -> Result<Self, AnalysisError> {
        let value = scene.number_at(key).ok_or_else(Refusal::no_values)?;
        let step = Scene::design_step(key);
        let at = |by: f64| scene.with_number(key, value + by);
        Ok(Self { sides: [at(-step)?, at(step)?], steps: [step; 2] })
    }

    /// Scenes varied by some keys.
    ///
    /// # Errors
    /// The errors of [`VariedScene::by_key`].
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
