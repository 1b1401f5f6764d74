//! Derivatives of a run at rest by keys of its scene.

use ltca::{Sensitivities, Sensitivity, StaticModel};
use scene::Scene;

use crate::{AnalysisError, error::solver_error, varied_scene::VariedScene};

/// Derivatives of positions by keys.
#[derive(Debug, Clone, Default)]
pub struct Derivatives {
    /// The keys.
    pub keys: Vec<String>,
    /// Position by position, key by key.
    pub rates: Vec<Vec<Sensitivity>>,
}

/// Differentiates positions by the keys that a scene names in `output.derivatives`, as they are solved.
#[derive(Debug)]
pub struct DerivativeRecorder {
    scene: Scene,
    varied: Vec<VariedScene>,
    sensitivities: Option<Sensitivities>,
    found: Derivatives,
}

impl DerivativeRecorder {
    /// Recorder of a scene as it is solved; `None` where it asks for nothing.
    ///
    /// # Errors
    /// As of [`VariedScene::by_key`].
    pub fn new(scene: &Scene) -> Result<Option<Self>, AnalysisError> {
        let keys = scene.output.derivatives.clone();
        if keys.is_empty() {
            return Ok(None);
        }
        let varied = VariedScene::by_keys(scene, &keys)?;
        let found = Derivatives { keys, rates: Vec::new() };
        Ok(Some(Self { scene: scene.clone(), varied, sensitivities: None, found }))
    }

    /// Takes those of a position, which the model has just found.
    ///
    /// # Errors
    /// [`AnalysisError`] where there are none.
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

    /// All of them.
    pub fn into_derivatives(self) -> Derivatives {
        self.found
    }
}
