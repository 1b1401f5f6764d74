//! Why a scene has no answer.

use std::sync::Arc;

use ltca::StaticError;
use lumped::LumpedError;
use mesh::MeshError;
use scene::{Scene, SceneError};
use study::calculix::CalculixError;

use crate::{plausible::Implausible, unstable_steps::UnstableSteps};

/// Why a scene has no answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// The scene itself.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A mesh file cannot be read, or what was read is no gear.
    #[error("{}", with_place(place, source))]
    Mesh {
        /// The file.
        place: String,
        /// What happened.
        source: Box<MeshError>,
    },
    /// The built-in mesher cannot make a gear with these numbers of elements.
    #[error("{file}: [{gear}.mesher]: {source}")]
    Mesher {
        /// The scene.
        file: String,
        /// `pinion` or `wheel`.
        gear: String,
        /// What happened.
        source: Box<mesh::StructuredError>,
    },
    /// What the built-in mesher made is no gear.
    #[error("built-in mesher, {gear}: {source}")]
    MadeMesh {
        /// `pinion` or `wheel`.
        gear: String,
        /// What happened.
        source: Box<MeshError>,
    },
    /// A mesh and its gear disagree.
    #[error("{0}")]
    Mismatch(Box<MeshMismatch>),
    /// A gear cannot be reduced.
    #[error("{place}: {gear}: {source}")]
    Reduction {
        /// File of the mesh, or the scene.
        place: String,
        /// `pinion` or `wheel`.
        gear: &'static str,
        /// What happened.
        source: Box<reduction::ReductionError>,
    },
    /// A material is none.
    #[error("{file}: {gear}'s material: {source}")]
    Material {
        /// The scene.
        file: String,
        /// `pinion` or `wheel`.
        gear: &'static str,
        /// What happened.
        source: Box<fem::FemError>,
    },
    /// A model without reduced gears is to be reduced.
    #[error("{at}: this model reduces nothing")]
    NothingToReduce {
        /// The scene, with the line of the model where it is known.
        at: String,
        /// That line, with a mark below what is meant.
        excerpt: Option<String>,
    },
    /// A window that a mesh has not the teeth for.
    #[error("{mesh}: a window of {window} teeth of {teeth}")]
    WindowOfMesh {
        /// The mesh.
        mesh: String,
        /// Teeth asked for.
        window: usize,
        /// Teeth of the mesh.
        teeth: usize,
    },
    /// The gear of a mesh cannot be reduced.
    #[error("{mesh}: {source}")]
    ReductionOfMesh {
        /// The mesh.
        mesh: String,
        /// What happened.
        source: Box<reduction::ReductionError>,
    },
    /// A gear as a rigid body has no mass or inertia.
    #[error("{place}: {source}")]
    Body {
        /// The mesh.
        place: String,
        /// What happened.
        source: Box<fem::FemError>,
    },
    /// Steps of given length are too long for an explicit method.
    #[error("{0}")]
    UnstableSteps(Box<UnstableSteps>),
    /// The pair does not move as it is asked to.
    #[error("{file}: {source}")]
    Motion {
        /// The scene.
        file: String,
        /// What happened.
        source: Box<dynamics::PairMotionError>,
    },
    /// Modes of a gear are not found, or its mesh cannot have them.
    #[error("{file}: modes of the {gear}: {source}")]
    Modes {
        /// The scene.
        file: String,
        /// `pinion` or `wheel`.
        gear: &'static str,
        /// What happened.
        source: Box<reduction::ReductionError>,
    },
    /// Not one speed of a sweep has a motion that holds.
    #[error("{file}: no speed has a result, at {speed_rpm:.0}/min: {reason}")]
    NoSpeed {
        /// The scene.
        file: String,
        /// The first speed of the sweep, 1/min.
        speed_rpm: f64,
        /// Why it has no motion.
        reason: String,
        /// What to do.
        hint: &'static str,
    },
    /// A record that no statistics can be made of.
    #[error(transparent)]
    Statistics(#[from] study::StudyError),
    /// The scene asks for something else.
    #[error("{file}: no {wanted}")]
    OtherAnalysis {
        /// The scene.
        file: String,
        /// What it does not ask for.
        wanted: &'static str,
    },
    /// The scene asks for bounds, which another analysis gives.
    #[error("{file}: an accuracy is asked for")]
    WithAccuracy {
        /// The scene.
        file: String,
    },
    /// An accuracy is asked of a number that has no bound.
    #[error("{file}: there is no bound of `{quantity}` in this run")]
    NoBound {
        /// The scene.
        file: String,
        /// Its key in `[accuracy]`.
        quantity: &'static str,
    },
    /// The result is there, less exact than was asked.
    #[error("{file}: the accuracy asked for is not kept: {missed}")]
    Inexact {
        /// The scene.
        file: String,
        /// What is not kept, with its bounds.
        missed: String,
    },
    /// The rows that a motion is to be resumed with are not those before its checkpoint.
    #[error("{file}: {found} rows are given, {wanted} came before the checkpoint")]
    ResumedRows {
        /// The scene.
        file: String,
        /// Rows given.
        found: usize,
        /// Rows before the checkpoint.
        wanted: usize,
    },
    /// ISO 6336-1 does not hold for the pair.
    #[error("{file}: model \"iso\": {source}")]
    Iso {
        /// The scene.
        file: String,
        /// What happened.
        source: Box<lumped::LumpedError>,
    },
    /// The solver found no answer, or refused the question.
    #[error("{0}")]
    Solver(Box<SolverFailure>),
    /// A scene that cannot be meant as it is written.
    #[error("{0}")]
    Implausible(Box<Implausible>),
    /// A certificate does not hold.
    #[error("{file}: the result does not hold: {missed}")]
    Certificate {
        /// The scene.
        file: String,
        /// The first check that is missed, and how many more.
        missed: String,
        /// What to do.
        hint: &'static str,
    },
    /// A cheaper model cannot be made of the scene, or finds no motion.
    #[error("{file}: {source}")]
    Lumped {
        /// The scene.
        file: String,
        /// What happened.
        source: Box<LumpedError>,
    },
    /// A gearbox cannot be put together, or has no equilibrium.
    #[error("{file}: {source}")]
    Gearbox {
        /// The gearbox file.
        file: String,
        /// What happened.
        source: Box<gearbox::GearboxError>,
    },
    /// No periodic motion was found.
    #[error("{file}: {source}")]
    Periodic {
        /// The scene.
        file: String,
        /// What happened.
        source: Box<periodic::PeriodicError<AnalysisError>>,
    },
    /// A motion has left all bounds.
    #[error("history.csv: holds what is no number")]
    OutOfBounds,
    /// A sweep without values.
    #[error("a sweep over no values")]
    NoValues,
    /// What happened at a value of a key.
    #[error("{key} = {value}: {source}")]
    AtValue {
        /// The key.
        key: String,
        /// Its value.
        value: f64,
        /// What happened.
        source: Box<AnalysisError>,
    },
    /// What keeps every value of a sweep from a result.
    #[error("{0}")]
    Shared(Arc<AnalysisError>),
    /// The loaded pair of a cheaper model finds nothing to rest on.
    #[error("{file}: nothing holds the loaded pair")]
    NothingHolds {
        /// The scene.
        file: String,
    },
    /// A window has more teeth than a gear.
    #[error(transparent)]
    Window(#[from] ale::AleError),
    /// CalculiX is not there, or has no result.
    #[error(transparent)]
    Calculix(#[from] CalculixError),
    /// Something of a scene that decks for CalculiX do not carry.
    #[error("the deck for CalculiX has no {what}")]
    BeyondCalculix {
        /// What.
        what: &'static str,
    },
    /// CalculiX has nowhere to write to.
    #[error("no folder for the files of CalculiX")]
    NoScratch,
    /// A chart has nothing to compare with.
    #[error("no reference: {why}")]
    NoReference {
        /// Why, on the coarsest mesh.
        why: String,
    },
    /// Who waits has given up, as `Progress::is_cancelled` says.
    #[error("stopped before the end")]
    Cancelled,
    /// The caller's sink has ended the analysis.
    #[error("{0}")]
    Sink(Box<dyn std::error::Error + Send + Sync>),
}

/// What the solver says of a scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{at}: {source}")]
pub struct SolverFailure {
    /// Scene, with the line that is meant where one is.
    pub at: String,
    /// That line, with a mark below it.
    pub excerpt: Option<String>,
    /// What happened.
    pub source: StaticError,
}

/// A mesh that disagrees with its gear.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshMismatch {
    /// What is wrong, with the file.
    pub said: String,
    /// What to do.
    pub hint: String,
    /// The line of the scene that is meant, with a mark below it.
    pub excerpt: Option<String>,
}

impl std::fmt::Display for MeshMismatch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.said)
    }
}

/// A mesh that disagrees with its gear, and what to do.
pub(crate) fn mismatch(said: String, hint: impl Into<String>) -> AnalysisError {
    AnalysisError::Mismatch(Box::new(MeshMismatch { said, hint: hint.into(), excerpt: None }))
}

/// Errors of reading name the file themselves, errors about what was read do not.
fn with_place(place: &str, source: &MeshError) -> String {
    let said = source.to_string();
    if said.starts_with(place) { said } else { format!("{place}: {said}") }
}

impl AnalysisError {
    /// That a scene does not ask for what is wanted of it.
    pub(crate) fn other_analysis(scene: &Scene, wanted: &'static str) -> Self {
        Self::OtherAnalysis { file: scene.file.display().to_string(), wanted }
    }

    /// That the model of a scene reduces no gears.
    pub(crate) fn nothing_to_reduce(scene: &Scene) -> Self {
        let place = scene.place_of(&["analysis.model"]);
        let at = place.as_ref().map_or_else(|| scene.file.display().to_string(), ToString::to_string);
        let excerpt = place.as_ref().and_then(scene::Place::excerpt).map(str::to_owned);
        Self::NothingToReduce { at, excerpt }
    }

    /// What a cheaper model says of a scene.
    pub(crate) fn lumped(scene: &Scene, source: LumpedError) -> Self {
        Self::Lumped { file: scene.file.display().to_string(), source: Box::new(source) }
    }

    /// No periodic motion of a scene.
    pub(crate) fn periodic(scene: &Scene, source: periodic::PeriodicError<Self>) -> Self {
        Self::Periodic { file: scene.file.display().to_string(), source: Box::new(source) }
    }

    /// Whether the result is there, less exact than was asked.
    pub fn is_inexact(&self) -> bool {
        matches!(self, Self::Inexact { .. })
    }

    /// Whether the input is fine and yet no result came out.
    pub fn is_without_result(&self) -> bool {
        match self {
            // Which part of the bore is held is the scene's word.
            Self::MadeMesh { source, .. } => !matches!(**source, mesh::MeshError::NotHeld { .. }),
            Self::Certificate { .. }
            | Self::Sink(_)
            | Self::Cancelled
            | Self::UnstableSteps(_)
            | Self::OutOfBounds
            | Self::NothingHolds { .. }
            | Self::Calculix(_)
            | Self::BeyondCalculix { .. }
            | Self::NoScratch
            | Self::NoReference { .. } => true,
            Self::Lumped { source, .. } => matches!(**source, LumpedError::Motion(_) | LumpedError::NoEquilibrium),
            Self::Gearbox { source, .. } => source.is_without_result(),
            Self::AtValue { source, .. } => source.is_without_result(),
            Self::Shared(source) => source.is_without_result(),
            Self::Motion { .. } | Self::Periodic { .. } | Self::NoSpeed { .. } | Self::Statistics(_) => true,
            Self::Modes { source, .. } => !matches!(**source, reduction::ReductionError::LargeBoundary { .. }),
            Self::Solver(failure) => {
                matches!(failure.source, StaticError::Contact { .. } | StaticError::NoEquilibrium { .. })
            }
            _ => false,
        }
    }

    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Scene(e) => e.hint(),
            Self::Mesh { source, .. } | Self::MadeMesh { source, .. } => source.hint(),
            Self::Mesher { source, .. } => source.hint(),
            Self::Mismatch(mismatch) => Some(mismatch.hint.clone()),
            Self::Reduction { source, .. } | Self::ReductionOfMesh { source, .. } => source.hint(),
            Self::NothingToReduce { .. } => {
                Some("use `model = \"reduced\"` in [analysis], or `--set analysis.model=reduced`".to_owned())
            }
            Self::WindowOfMesh { .. } => Some("give `--window-teeth` up to the number of teeth of the mesh".to_owned()),
            Self::Material { source, .. } | Self::Body { source, .. } => source.hint(),
            Self::UnstableSteps(steps) => Some(steps.hint()),
            Self::Iso { source, .. } | Self::Lumped { source, .. } => source.hint(),
            Self::Gearbox { source, .. } => source.hint(),
            Self::OutOfBounds => {
                Some("the motion has left all bounds: take smaller steps, or look at supports and damping".to_owned())
            }
            Self::Periodic { .. } => Some(
                "begin where the motion is small, far from a resonance (`from`), with more `most_harmonics` or a larger `tail`; `run = \"steady\"` shows whether the motion repeats itself there".to_owned(),
            ),
            Self::NoValues => Some("give `--points 2` or more".to_owned()),
            Self::AtValue { source, .. } => source.hint(),
            Self::Shared(source) => source.hint(),
            Self::Motion { source, .. } => Some(source.hint()),
            Self::Modes { source, .. } => source.hint(),
            Self::NoSpeed { hint, .. } => Some((*hint).to_owned()),
            Self::Statistics(e) => e.hint(),
            Self::OtherAnalysis { .. } => {
                Some("`[motion]` and its `run` say what the scene asks for, `model` in [analysis] by what".into())
            }
            Self::WithAccuracy { .. } => {
                Some("`accuracy::AccurateAnalysis` (in motion `accuracy::motion::AccurateMotion`) solves it with bounds; without `[accuracy]` this one does".into())
            }
            Self::NoBound { quantity, .. } => Some(format!(
                "leave `{quantity}` out of [accuracy]; harmonics need more positions a cycle, root stress a model with meshes"
            )),
            Self::Inexact { .. } => {
                Some("ask for less, or see `accuracy` in summary.json for what the bounds are made of".into())
            }
            Self::ResumedRows { .. } => Some("give all rows that the run before handed out, and no more".into()),
            Self::Solver(failure) => failure.source.hint(),
            Self::Implausible(found) => Some(found.hint.clone()),
            Self::Certificate { hint, .. } => Some((*hint).to_owned()),
            Self::Calculix(e) => e.hint(),
            Self::NothingHolds { .. }
            | Self::Window(_)
            | Self::BeyondCalculix { .. }
            | Self::NoScratch
            | Self::NoReference { .. }
            | Self::Cancelled
            | Self::Sink(_) => None,
        }
    }

    /// The line of the scene that is meant, with a mark below it.
    pub fn excerpt(&self) -> Option<&str> {
        match self {
            Self::Scene(e) => e.excerpt(),
            Self::Mismatch(mismatch) => mismatch.excerpt.as_deref(),
            Self::Solver(failure) => failure.excerpt.as_deref(),
            Self::Implausible(found) => found.excerpt.as_deref(),
            Self::UnstableSteps(steps) => steps.excerpt.as_deref(),
            Self::NothingToReduce { excerpt, .. } => excerpt.as_deref(),
            Self::AtValue { source, .. } => source.excerpt(),
            Self::Shared(source) => source.excerpt(),
            _ => None,
        }
    }
}

/// The solver's error with the place in the scene that it is about.
pub fn solver_error(scene: &Scene, source: StaticError) -> AnalysisError {
    let keys: &[&str] = match &source {
        StaticError::Overloaded { .. } => &["operation.torque_nm"],
        error if error.is_starved() => &["analysis.window_teeth"],
        _ => &[],
    };
    let place = scene.place_of(keys);
    let at = place.as_ref().map_or_else(|| scene.file.display().to_string(), ToString::to_string);
    let excerpt = place.as_ref().and_then(|p| p.excerpt()).map(str::to_owned);
    AnalysisError::Solver(Box::new(SolverFailure { at, excerpt, source }))
}
