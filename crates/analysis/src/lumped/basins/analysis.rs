//! Runs a scene from all initial states of a plane.

use answer::Remark;
use std::sync::Arc;

use integrate::LONGEST_PERIOD;
use rayon::prelude::*;
use scene::{MotionScene, Run, Scene};

use super::{
    super::{
        LumpedInputs,
        analysis::{self, checked_run},
        excitation::ExcitationSource,
        remarks::no_backlash,
    },
    Attractor, BasinHeadline, BasinStart,
    attractor::told_apart,
    plane::StatePlane,
};
use crate::{
    AnalysisError, GearCache, NoCache, NoObserver, Observer, PhaseWork, certificate::Checks, error::in_scene,
    facts::RunInfo, gears, inputs::motion_of, resolution::with_slices, run_phase, unless_cancelled,
};

/// A scene with `run = "basins"`.
#[derive(Clone, Copy)]
pub struct BasinAnalysis<'a> {
    scene: &'a Scene,
    cache: &'a dyn GearCache,
}

impl std::fmt::Debug for BasinAnalysis<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BasinAnalysis").field("scene", &self.scene.name).finish_non_exhaustive()
    }
}

/// Result of a search for basins of attraction.
#[derive(Debug)]
pub struct BasinResult {
    /// Facts about the run, with its certificate.
    pub facts: RunInfo,
    /// Starts in ascending order of the rate and, for each rate, of the error.
    pub starts: Vec<BasinStart>,
    /// Motions in which they end.
    pub attractors: Vec<Attractor>,
    /// Headline values.
    pub headline: BasinHeadline,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
}

impl<'a> BasinAnalysis<'a> {
    /// Analysis of a scene with the model `mapped`, `reduced`, `lumped8`, `lumped12` or `shaft18`.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, cache: &NoCache }
    }

    /// Uses reduced gears from a cache.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Runs all starts without progress reports.
    ///
    /// # Errors
    /// The errors of [`BasinAnalysis::solve_with`].
    pub fn solve(&self) -> Result<BasinResult, AnalysisError> {
        self.solve_with(&mut NoObserver)
    }

    /// Runs all starts of the plane in parallel, each until it is periodic or for as long as the scene permits.
    ///
    /// # Errors
    /// The errors of the model; the error of the first start if none leads to a motion.
    pub fn solve_with(&self, observer: &mut dyn Observer) -> Result<BasinResult, AnalysisError> {
        let asked = with_slices(self.scene.clone());
        let words = asked.motion.as_ref().and_then(|m| m.basins);
        let words = words.ok_or_else(|| crate::error::unasked(&asked, "search for basins"))?;
        let scene = &steady(&asked)?;
        let inputs = LumpedInputs::gather(scene, &mut ExcitationSource::new(observer, self.cache))?;
        let mut system = inputs.build()?;
        let (coordinates, resonance_hz) = (system.coordinates(), system.resonance_hz);
        let mut facts = analysis::facts(&inputs, coordinates);
        let plane = StatePlane::new(&mut system.model).map_err(in_scene(scene))?;
        let tolerance = motion_of(scene)?.periodic_tolerance.unwrap_or(0.0);
        let places = words.places();
        let runs = run_phase(observer, "basins", PhaseWork::Steps(places.len() as u64), |progress| {
            let one = |&[error, rate]: &[f64; 2]| {
                let found = unless_cancelled(progress).and_then(|()| inputs.build()).and_then(|mut own| {
                    let from = plane.state(error, rate);
                    checked_run(&inputs, &mut own.model, resonance_hz, Some(&from))
                });
                progress.tick();
                let of = |(run, checks)| Ok((Attractor::of(&run, tolerance)?, checks));
                found.and_then(of).map_err(Arc::new)
            };
            places.par_iter().map(one).collect::<Vec<_>>()
        });
        if let (Some(Err(first)), true) = (runs.first(), runs.iter().all(Result::is_err)) {
            return Err(AnalysisError::Shared(Arc::clone(first)));
        }
        facts.certificate = Checks::worst(runs.iter().flatten().map(|(_, checks)| checks));
        let runs: Vec<_> = runs.into_iter().map(|run| run.map(|(attractor, _)| attractor)).collect();
        let of_starts: Vec<Option<Attractor>> = runs.iter().map(|run| run.as_ref().ok().cloned()).collect();
        let (attractors, belongs) = told_apart(&of_starts);
        let starts: Vec<BasinStart> = places
            .iter()
            .zip(runs)
            .zip(belongs)
            .map(|((&[error, rate], run), attractor)| BasinStart {
                initial_dte_um: error,
                initial_dte_rate_mm_s: rate,
                attractor,
                warm_up_cycles: run.as_ref().map_or(0, |run| run.most_warm_up_cycles),
                failed: run.err(),
            })
            .collect();
        let headline = BasinHeadline::new(&words, (coordinates, resonance_hz), &starts, &attractors);
        let mut remarks = system.remarks;
        remarks.extend(gears::remarks(&inputs.pair));
        remarks.extend(no_backlash(&inputs));
        remarks.extend(headline.remarks(&starts));
        remarks.extend(inputs.left_out_of_sweeps());
        Ok(BasinResult { facts, starts, attractors, headline, remarks })
    }
}

/// The scene of one start: to the periodic state, and the longest period of it.
fn steady(scene: &Scene) -> Result<Scene, AnalysisError> {
    let mut own = scene.clone();
    own.analysis.cycles = own.analysis.cycles.max(LONGEST_PERIOD as u32);
    own.motion = Some(MotionScene { run: Run::Steady, basins: None, ..motion_of(scene)?.clone() });
    Ok(own)
}
