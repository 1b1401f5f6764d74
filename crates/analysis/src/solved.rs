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

/// A scene with its answer.
#[derive(Debug)]
pub enum Solved {
    /// Positions at rest.
    AtRest(Box<SolvedAtRest>),
    /// A motion, or many.
    InTime(Box<SolvedInTime>),
}

/// A scene at rest with its answer.
#[derive(Debug)]
pub struct SolvedAtRest {
    /// The scene as it was solved.
    pub scene: Scene,
    /// Position by position.
    pub history: StaticHistory,
    /// Derivatives by keys, where the scene asks for them.
    pub derivatives: Option<Derivatives>,
}

/// Solves a document: the one way from what is asked to its answer.
///
/// For a scene at rest [`Context::with_models`] says what is known of its gears, and a result that does not hold is an
/// error; in time [`Solved::verdict`] tells, and of a gearbox its own.
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

/// Solves a scene at rest on what `models` have of its gears, with the derivatives that it asks for in
/// `output.derivatives`.
///
/// # Errors
/// [`AnalysisError`]; [`AnalysisError::Certificate`] of a result that does not hold, [`AnalysisError::Cancelled`] where
/// interest was lost.
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
    /// [`AnalysisError::Statistics`] where the positions give no statistics.
    pub fn headline(&self) -> Result<StaticHeadline, AnalysisError> {
        Ok(static_headline(&self.scene, &self.history)?)
    }

    /// Geometry and certificate. Meshes and reduction are what [`crate::StaticAnalysis`] tells of, which solves a scene by
    /// itself.
    ///
    /// # Errors
    /// Where the scene is no pair.
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
    /// The answer in time.
    ///
    /// # Errors
    /// [`AnalysisError::Refused`] of a scene at rest.
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
    /// As [`SolvedAtRest::headline`].
    pub fn headline(&self) -> Result<Value, AnalysisError> {
        match self {
            // Strings and numbers only, all keys are strings: there is nothing that JSON could refuse.
            Self::AtRest(solved) => Ok(serde_json::to_value(solved.headline()?).unwrap_or_default()),
            Self::InTime(solved) => Ok(solved.headline()),
        }
    }

    /// What the result was made of, with its certificate; at rest as [`SolvedAtRest::facts`].
    ///
    /// # Errors
    /// Where a scene at rest is no pair.
    pub fn facts(&self) -> Result<Cow<'_, RunInfo>, AnalysisError> {
        match self {
            Self::AtRest(solved) => solved.facts().map(Cow::Owned),
            Self::InTime(solved) => Ok(Cow::Borrowed(solved.facts())),
        }
    }

    /// What a user should hear.
    pub fn remarks(&self) -> &[answer::Remark] {
        match self {
            Self::AtRest(solved) => &solved.history.remarks,
            Self::InTime(solved) => solved.remarks(),
        }
    }

    /// Whether the result holds and is as exact as was asked.
    ///
    /// # Errors
    /// As [`SolvedInTime::verdict`]; at rest [`AnalysisError::Certificate`].
    pub fn verdict(&self) -> Result<(), AnalysisError> {
        match self {
            Self::AtRest(solved) => crate::certificate::verdict(&solved.certificate(), &solved.scene),
            Self::InTime(solved) => solved.verdict(),
        }
    }
}
