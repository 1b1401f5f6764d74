//! Derivatives of a static run by keys of its scene.

use ltca::{Sensitivities, Sensitivity, StaticModel};
use scene::Scene;

use crate::{AnalysisError, error::solver_error, varied_scene::VariedScene};

/// Derivatives of positions by keys.
#[derive(Debug, Clone, Default)]
pub struct Derivatives {
    /// Names of the keys.
    pub keys: Vec<String>,
    /// Derivatives, position by position, key by key.
    pub rates: Vec<Vec<Sensitivity>>,
}

/// Computes derivatives at each position by the keys in `output.derivatives`, as positions are solved.
#[derive(Debug)]
pub struct DerivativeRecorder {
    scene: Scene,
    varied: Vec<VariedScene>,
    sensitivities: Option<Sensitivities>,
    found: Derivatives,
}

impl DerivativeRecorder {
    /// Recorder of a scene as solved; `None` if the scene requests no derivatives.
    ///
    /// # Errors
    /// The errors of [`VariedScene::by_key`].
    pub fn new(scene: &Scene) -> Result<Option<Self>, AnalysisError> {
        let keys = scene.output.derivatives.clone();
        if keys.is_empty() {
            return Ok(None);
        }
        let varied = VariedScene::by_keys(scene, &keys)?;
        let found = Derivatives { keys, rates: Vec::new() };
        Ok(Some(Self { scene: scene.clone(), varied, sensitivities: None, found }))
    }

    /// Adds the derivatives at the position that the model has just solved.
    ///
    /// # Errors
    /// [`AnalysisError`] if they do not exist.
    pub fn position(&mut self, model: &StaticModel) -> Result<(), AnalysisError> {
        let sensitivities = match &mut self.sensitivities {
            Some(known) => known,
            None => {
                let of = |varied: &VariedScene| varied.variation(&self.scene, model.options());
                let variations = self.varied.iter().map(of).collect::<Result<_, _>>();
                let variations = variations.map_err(|failure| failure.into_error(&self.scene))?;
                self.sensitivities.insert(Sensitivities::new(variations))
            }
        };
        self.found.rates.push(sensitivities.of(model).map_err(|e| solver_error(&self.scene, e))?);
        Ok(())
    }

    /// Returns all derivatives.
    pub fn into_derivatives(self) -> Derivatives {
        self.found
    }
}
