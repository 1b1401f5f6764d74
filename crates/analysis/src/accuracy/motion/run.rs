//! A run of a model, and the values for which bounds are given.

use scene::{Quantity, Scene};

use crate::{
    AnalysisError, GearCache, Observer,
    lumped::{LumpedAnalysis, LumpedResult, LumpedSink, NoLumpedSink},
    motion::{MotionAnalysis, MotionOutcome, MotionResult, MotionSink, NoMotionSink},
};

/// Sinks for the rows of a run; each model has rows of its own.
pub struct MotionTold<'a> {
    /// Sink for the rows of reduced gears.
    pub motion: &'a mut dyn MotionSink,
    /// Sink for the rows of lumped gears.
    pub lumped: &'a mut dyn LumpedSink,
}

impl std::fmt::Debug for MotionTold<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MotionTold").finish_non_exhaustive()
    }
}

/// Result of a model.
#[derive(Debug)]
pub enum MotionAnswer {
    /// Result of the model with twelve coordinates.
    Lumped(Box<LumpedResult>),
    /// Result of reduced gears, with or without modes.
    Reduced(Box<MotionResult>),
}

/// Values of a motion for which bounds are given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionSample {
    /// Root mean square of the dynamic transmission error about its mean, um.
    pub rms_um: f64,
    /// Peak to peak of the dynamic transmission error, um.
    pub peak_to_peak_um: f64,
    /// Smallest sum of the normal forces divided by the mean; at zero and below the flanks lose contact.
    pub least_force: f64,
    /// Residual of the periodicity, relative to the peak to peak; `None` if it was not computed.
    pub periodicity: Option<f64>,
}

impl MotionSample {
    /// The value of a quantity of motion.
    pub fn get(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::RmsDte => self.rms_um,
            _ => self.peak_to_peak_um,
        }
    }
}

impl MotionAnswer {
    /// Runs the model of a scene.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn of(
        scene: &Scene,
        cache: &dyn GearCache,
        observer: &mut dyn Observer,
        told: &mut MotionTold<'_>,
    ) -> Result<Self, AnalysisError> {
        if !scene.analysis.model.is_reduced() {
            let result = LumpedAnalysis::new(scene).with_cache(cache).solve_into(observer, told.lumped)?;
            return Ok(Self::Lumped(Box::new(result)));
        }
        match MotionAnalysis::new(scene).with_cache(cache).solve_into(observer, told.motion)? {
            MotionOutcome::Finished(result) => Ok(Self::Reduced(result)),
            // Nobody asked it to.
            MotionOutcome::Stopped { .. } => Err(crate::error::unasked(scene, "motion to its end")),
        }
    }

    /// Runs a scene without passing its rows on.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn quietly(scene: &Scene, cache: &dyn GearCache, observer: &mut dyn Observer) -> Result<Self, AnalysisError> {
        Self::of(scene, cache, observer, &mut MotionTold { motion: &mut NoMotionSink, lumped: &mut NoLumpedSink })
    }

    /// Estimated change of the peak to peak by the steps, %; `None` if there is no estimate.
    pub fn step_error_percent(&self) -> Option<f64> {
        match self {
            Self::Lumped(result) => result.headline.certificate.step_error_percent,
            Self::Reduced(result) => result.headline.certificate.step_error_percent,
        }
    }

    /// Headline values of the motion.
    pub fn sample(&self) -> MotionSample {
        // Both headlines have the same names for them.
        macro_rules! sample {
            ($headline:expr) => {
                MotionSample {
                    rms_um: $headline.rms_dte_um,
                    peak_to_peak_um: $headline.peak_to_peak_dte_um,
                    least_force: $headline.min_normal_force_n / $headline.mean_normal_force_n,
                    periodicity: $headline.certificate.periodicity,
                }
            };
        }
        match self {
            Self::Lumped(result) => sample!(result.headline),
            Self::Reduced(result) => sample!(result.headline),
        }
    }
}
