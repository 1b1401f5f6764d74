//! A run at each value of a key: bifurcation diagrams and resonance curves.
//!
//! | module | what it does |
//! |---|---|
//! | `options` | what is asked for |
//! | `point` | one value: settle, section |
//! | `ways` | value after value, upwards, downwards or each by itself |
//! | `headline` | what is read off the points |

mod headline;
mod options;
mod point;
mod ways;

use answer::Remark;
use std::sync::Arc;

use scene::Scene;

pub use headline::SweepHeadline;
pub use options::{LumpedQuantity, SweepOptions};
pub use point::SweepPoint;

use super::{ExcitationSource, LumpedInputs, analysis, inputs::LumpedSystem, remarks::no_backlash};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, Observer, PhaseWork, certificate::Checks, facts::RunInfo,
    refused::Refusal, resolution::with_slices, run_phase,
};
use ways::{SweepValue, all_ways};

/// A scene with a cheaper model at many values of one of its keys.
#[derive(Clone, Copy)]
pub struct KeySweep<'a> {
    scenes: &'a [(f64, Scene)],
    options: &'a SweepOptions,
    cache: &'a dyn GearCache,
}

impl std::fmt::Debug for KeySweep<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("KeySweep").field("values", &self.scenes.len()).field("options", self.options).finish()
    }
}

/// Result of a sweep over a key.
#[derive(Debug)]
pub struct BifurcationAnalysis {
    /// The scene of the first value with a model, which stands for the common part of all scenes.
    pub scene: Scene,
    /// Facts about its model.
    pub facts: RunInfo,
    /// Points, direction by direction, in ascending order of the value.
    pub points: Vec<SweepPoint>,
    /// Headline values of the points.
    pub headline: SweepHeadline,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
}

impl<'a> KeySweep<'a> {
    /// Sweep over scenes with ascending values of a key. For each the motion to the steady state is run, whatever its
    /// `run`.
    pub fn new(scenes: &'a [(f64, Scene)], options: &'a SweepOptions) -> Self {
        Self { scenes, options, cache: &NoCache }
    }

    /// Uses reduced gears from a cache, if the reduced model provides the mesh cycle.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Runs all values without progress reports.
    ///
    /// # Errors
    /// The errors of [`KeySweep::solve_with`].
    pub fn solve(&self) -> Result<BifurcationAnalysis, AnalysisError> {
        self.solve_with(&mut NoObserver)
    }

    /// Runs the model of a scene at each value, direction by direction. Directions, and the values of `apart`, run in
    /// parallel.
    ///
    /// # Errors
    /// [`AnalysisError`] if no value gives a motion. A single value without a motion has the reason in its point.
    pub fn solve_with(&self, observer: &mut dyn Observer) -> Result<BifurcationAnalysis, AnalysisError> {
        let options = self.options;
        let values = self.gather(observer);
        let (first, system) = first_of(&values)?;
        let (mut facts, mut remarks) = (analysis::facts(first, system.coordinates()), system.remarks);
        let count = (values.len() * options.ways.len()) as u64;
        let points: Vec<SweepPoint> = run_phase(observer, "sweep", PhaseWork::Steps(count), |progress| {
            let at = |value: &SweepValue, from: Option<&_>| match &value.inputs {
                Ok(_) if progress.is_cancelled() => Err(Arc::new(AnalysisError::Cancelled)),
                Ok(inputs) => point::run(inputs, value.value, options, from).map_err(Arc::new),
                Err(e) => Err(Arc::clone(e)),
            };
            all_ways(&options.ways, &values, at, &|| progress.tick()).into_iter().flatten().collect()
        });
        let failed = points.first().and_then(|p| p.failed.clone());
        if let (Some(error), true) = (failed, points.iter().all(|p| p.failed.is_some())) {
            return Err(AnalysisError::Shared(error));
        }
        facts.certificate = Checks::worst(points.iter().map(|p| &p.checks));
        let headline = headline::headline(&first.scene, options, &points);
        remarks.extend(headline.remarks());
        remarks.extend(first.left_out_of_sweeps());
        // Who sweeps the backlash knows.
        let swept = options.key.contains("backlash") || options.key.contains("thickness");
        remarks.extend(no_backlash(first).filter(|_| !swept));
        Ok(BifurcationAnalysis { scene: first.scene.clone(), facts, points, headline, remarks })
    }

    /// All values with what their models are made of.
    fn gather(&self, observer: &mut dyn Observer) -> Vec<SweepValue> {
        let mut source = ExcitationSource::new(observer, self.cache);
        let mut of = |scene: &Scene| {
            let settled = self.options.settled(&with_slices(scene.clone()))?;
            LumpedInputs::gather(&settled, &mut source)
        };
        self.scenes
            .iter()
            .map(|(value, scene)| SweepValue { value: *value, inputs: of(scene).map_err(Arc::new) })
            .collect()
    }
}

/// The first value with a model.
///
/// # Errors
/// The error of the first value, if no value has a model.
fn first_of(values: &[SweepValue]) -> Result<(&LumpedInputs, LumpedSystem), AnalysisError> {
    let mut error = None;
    for value in values {
        let built = match &value.inputs {
            Ok(inputs) => inputs.build().map(|system| (inputs, system)).map_err(Arc::new),
            Err(e) => Err(Arc::clone(e)),
        };
        match built {
            Ok(first) => return Ok(first),
            Err(e) => error = error.or(Some(e)),
        }
    }
    Err(error.map_or_else(|| Refusal::no_values().into(), AnalysisError::Shared))
}
