//! A scene of any kind, solved without a file.

use std::{borrow::Cow, sync::Arc};

use answer::RowStore;
use ltca::StaticHistory;
use scene::Scene;
use serde_json::Value;

use crate::{
    AnalysisError, Derivatives, PhaseWork, SharedModels, VariedScene,
    certificate::Checks,
    context::{Context, Ending, Question},
    error::unasked,
    facts::RunInfo,
    gears,
    in_time::{InTime, SolvedInTime},
    motion::{MotionCheckpoint, MotionRow, MotionSink, NoMotionSink},
    results::{StaticHeadline, static_headline},
    run_phase,
    shared_solutions::{Rates, RestRequest, SolvedWithRates},
    static_certificate,
};

/// A scene with its result.
#[derive(Debug)]
pub enum Solved {
    /// Static positions.
    AtRest(Box<SolvedAtRest>),
    /// One motion, or several.
    InTime(Box<SolvedInTime>),
}

/// A static scene with its result.
#[derive(Debug)]
pub struct SolvedAtRest {
    /// The scene as it was solved.
    pub scene: Scene,
    /// Results, position by position.
    pub history: StaticHistory,
    /// Derivatives by keys, if the scene requests them.
    pub derivatives: Option<Derivatives>,
}

/// Solves a document: the only function that does so.
///
/// For a static scene [`Context::with_models`] provides existing gears, and a result that fails its checks is an error.
/// For a scene in time [`Solved::verdict`] tells; a gearbox has its own verdict.
///
/// # Errors
/// [`AnalysisError`].
pub fn solve<Q: Question + ?Sized>(question: &Q, context: Context<'_, Q>) -> Result<Ending<Q::Answer>, AnalysisError> {
    question.answer(context)
}

impl Question for Scene {
    type Answer = Solved;
    type Sink<'s> = dyn MotionSink + 's;
    type State = (MotionCheckpoint, Arc<RowStore<MotionRow>>);

    fn answer(&self, context: Context<'_, Self>) -> Result<Ending<Solved>, AnalysisError> {
        let Context { observer, cache, models, meshes, remarks, line_lengths, sink, from, stop_after } = context;
        if self.motion.is_some() {
            let analysis = InTime { meshes, cache, from, stop_after };
            let solved = match sink {
                Some(sink) => analysis.solve(self, observer, sink),
                None => analysis.solve(self, observer, &mut NoMotionSink),
            };
            return Ok(solved?.map(|solved| Solved::InTime(Box::new(solved))));
        }
        if sink.is_some() || from.is_some() || stop_after.is_some() {
            return Err(unasked(self, "motion"));
        }
        let request = RestRequest { line_lengths, ..RestRequest::to_the_end(remarks) };
        let solved = run_phase(observer, "solve", PhaseWork::Unknown, |_| match models {
            Some(models) => solve_at_rest(self, models, request),
            None => {
                let own = SharedModels::new(cache);
                let own = meshes.into_iter().fold(own, |own, meshes| own.with_meshes(meshes.map(Clone::clone)));
                solve_at_rest(self, &own, request)
            }
        })?;
        Ok(Ending::Finished(Solved::AtRest(Box::new(solved))))
    }
}

/// Solves a static scene with the gears available in `models`, with the derivatives requested in `output.derivatives`.
///
/// # Errors
/// [`AnalysisError`]; [`AnalysisError::Certificate`] for a result that fails its checks, [`AnalysisError::Cancelled`]
/// if it was cancelled.
pub fn solve_at_rest(
    scene: &Scene,
    models: &SharedModels<'_>,
    request: RestRequest<'_>,
) -> Result<SolvedAtRest, AnalysisError> {
    let keys = scene.output.derivatives.clone();
    let varied = VariedScene::by_keys(scene, &keys)?;
    let asked = Rates { of: &varied, of_unloaded: true };
    let SolvedWithRates { scene, history, rates } = models.solve(scene, asked, request)?;
    let derivatives = (!keys.is_empty()).then_some(Derivatives { keys, rates });
    Ok(SolvedAtRest { scene, history, derivatives })
}

impl SolvedAtRest {
    /// The headline of `summary.json`.
    ///
    /// # Errors
    /// [`AnalysisError::Statistics`] if no statistics can be computed from the positions.
    pub fn headline(&self) -> Result<StaticHeadline, AnalysisError> {
        Ok(static_headline(&self.scene, &self.history)?)
    }

    /// Geometry and certificate. Facts about meshes and reduction come from [`crate::StaticAnalysis`], which solves a
    /// scene separately.
    ///
    /// # Errors
    /// An error if the scene is not a valid pair.
    pub fn facts(&self) -> Result<RunInfo, AnalysisError> {
        let pair = self.scene.gear_pair()?;
        Ok(RunInfo {
            geometry: gears::geometry_facts(&pair),
            geometry_sheet: Some(pair.sheet()),
            certificate: self.certificate(),
            ..RunInfo::default()
        })
    }

    fn certificate(&self) -> Checks {
        static_certificate(&self.scene, &self.history.positions)
    }
}

impl Solved {
    /// The result in time.
    ///
    /// # Errors
    /// [`AnalysisError::Refused`] for a static scene.
    pub fn in_time(self) -> Result<Box<SolvedInTime>, AnalysisError> {
        match self {
            Self::InTime(solved) => Ok(solved),
            Self::AtRest(solved) => Err(unasked(&solved.scene, "motion")),
        }
    }

    /// The scene as it was solved.
    pub fn scene(&self) -> &Scene {
        match self {
            Self::AtRest(solved) => &solved.scene,
            Self::InTime(solved) => &solved.scene,
        }
    }

    /// The headline of `summary.json`; numbers without a value (NaN) are null.
    ///
    /// # Errors
    /// The errors of [`SolvedAtRest::headline`].
    pub fn headline(&self) -> Result<Value, AnalysisError> {
        match self {
            // Strings and numbers only, all keys are strings: there is nothing that JSON could refuse.
            Self::AtRest(solved) => Ok(serde_json::to_value(solved.headline()?).unwrap_or_default()),
            Self::InTime(solved) => Ok(solved.headline()),
        }
    }

    /// Facts about the result, with its certificate; for a static scene as in [`SolvedAtRest::facts`].
    ///
    /// # Errors
    /// An error if a static scene is not a valid pair.
    pub fn facts(&self) -> Result<Cow<'_, RunInfo>, AnalysisError> {
        match self {
            Self::AtRest(solved) => solved.facts().map(Cow::Owned),
            Self::InTime(solved) => Ok(Cow::Borrowed(solved.facts())),
        }
    }

    /// Remarks for the user.
    pub fn remarks(&self) -> &[answer::Remark] {
        match self {
            Self::AtRest(solved) => &solved.history.remarks,
            Self::InTime(solved) => solved.remarks(),
        }
    }

    /// Whether the result passes its checks and meets the requested accuracy.
    ///
    /// # Errors
    /// Those of [`SolvedInTime::verdict`]; for a static scene [`AnalysisError::Certificate`].
    pub fn verdict(&self) -> Result<(), AnalysisError> {
        match self {
            Self::AtRest(solved) => crate::certificate::verdict(&solved.certificate(), &solved.scene),
            Self::InTime(solved) => solved.verdict(),
        }
    }
}
