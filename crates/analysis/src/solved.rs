//! A scene of any kind, solved without a file.

use std::borrow::Cow;

use ltca::StaticHistory;
use scene::Scene;
use serde_json::Value;

use crate::{
    AnalysisError, Derivatives, Observer, PhaseWork, SharedModels, VariedScene,
    certificate::Checks,
    facts::Facts,
    gears,
    in_time::{SolvedInTime, TimeAnalysis},
    resolution::with_slices,
    results::{StaticHeadline, static_headline},
    run_phase,
    shared_solutions::{Rates, RestRequest, SolvedWithRates, WarningsAtRest},
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

/// Solves a scene of any kind in memory: at rest on what `models` have of its gears, in time with their cache and meshes.
///
/// At rest `warnings` says what is found out for [`Solved::warnings`], and a result that does not hold is an error; in
/// time [`Solved::verdict`] tells.
///
/// # Errors
/// [`AnalysisError`].
pub fn solve(
    scene: &Scene,
    models: &SharedModels<'_>,
    warnings: WarningsAtRest,
    observer: &mut dyn Observer,
) -> Result<Solved, AnalysisError> {
    if scene.motion.is_none() {
        let work = || solve_at_rest(scene, models, RestRequest::to_the_end(warnings));
        let solved = run_phase(observer, "solve", PhaseWork::Unknown, |_| work())?;
        return Ok(Solved::AtRest(Box::new(solved)));
    }
    let scene = with_slices(scene.clone());
    let analysis = TimeAnalysis::new(&scene).with_meshes(models.meshes()).with_cache(models.cache());
    Ok(Solved::InTime(Box::new(analysis.solve(observer)?)))
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
    pub fn facts(&self) -> Result<Facts, AnalysisError> {
        let pair = self.scene.gear_pair()?;
        Ok(Facts {
            geometry: gears::geometry_facts(&pair),
            geometry_sheet: Some(pair.sheet()),
            certificate: self.certificate(),
            ..Facts::default()
        })
    }

    fn certificate(&self) -> Checks {
        static_certificate(&self.scene, &self.history.positions)
    }
}

impl Solved {
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
    pub fn facts(&self) -> Result<Cow<'_, Facts>, AnalysisError> {
        match self {
            Self::AtRest(solved) => solved.facts().map(Cow::Owned),
            Self::InTime(solved) => Ok(Cow::Borrowed(solved.facts())),
        }
    }

    /// What a user should hear.
    pub fn warnings(&self) -> &[answer::Remark] {
        match self {
            Self::AtRest(solved) => &solved.history.warnings,
            Self::InTime(solved) => solved.warnings(),
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
