//! Errors of the analysis.

use std::{path::Path, sync::Arc};

use answer::{FailedCheck, TableError};
use files::{Located, Place};
use gearbox::GearboxError;
use integrate::MotionError;
use ltca::StaticError;
use lumped::LumpedError;
use mesh::MeshError;
use periodic::PeriodicError;
use rating::RatingError;
use reduction::ReductionError;
use scene::{Scene, SceneError};
use study::{StudyError, calculix::CalculixError};

use crate::refused::{Blame, Refusal};

/// A scene has no result: the cause, with the nested places where it occurred.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// A cause at a place; places are nested, the outermost first.
    #[error(transparent)]
    At(Box<Located<AnalysisError>>),
    /// The common cause for which no value of a sweep has a result.
    #[error("{0}")]
    Shared(Arc<AnalysisError>),
    /// Error of the scene itself, with its own places.
    #[error("{0}")]
    Scene(Box<SceneError>),
    /// A mesh file cannot be read, or its content is not a gear.
    #[error("{0}")]
    Mesh(Box<MeshError>),
    /// A gear cannot be reduced, has no modes or no mass, or a material is invalid.
    #[error("{0}")]
    Reduction(Box<ReductionError>),
    /// The contact has no solution, or its options are invalid.
    #[error("{0}")]
    Solver(Box<StaticError>),
    /// A cheaper model cannot be made from the scene, or finds no motion.
    #[error("{0}")]
    Lumped(Box<LumpedError>),
    /// A standard does not cover the rating of the pair.
    #[error("{0}")]
    Rating(Box<RatingError>),
    /// A gearbox or a pair cannot be assembled, has no equilibrium, or cannot move as requested.
    #[error("{0}")]
    Gearbox(Box<GearboxError>),
    /// No periodic motion was found.
    #[error("{0}")]
    Periodic(Box<PeriodicError<AnalysisError>>),
    /// No statistics can be computed from a record.
    #[error(transparent)]
    Statistics(#[from] StudyError),
    /// Rows of a motion cannot be stored, or cannot be read back.
    #[error(transparent)]
    Rows(#[from] TableError),
    /// A request without a result, in words.
    #[error("{0}")]
    Refused(Box<Refusal>),
    /// A check of the result failed.
    #[error("check failed: {}", .0.missed)]
    Certificate(FailedCheck),
    /// The solution was cancelled, as `Progress::is_cancelled` tells.
    #[error("stopped before the end")]
    Cancelled,
    /// A sink returned an error.
    #[error("{0}")]
    Sink(Box<dyn std::error::Error + Send + Sync>),
}

/// Errors of the crates below, boxed: each has one variant.
macro_rules! boxed {
    ($($of:ty => $variant:ident),+ $(,)?) => {
        $(impl From<$of> for AnalysisError {
            fn from(source: $of) -> Self {
                Self::$variant(Box::new(source))
            }
        })+
    };
}

boxed! {
    Located<AnalysisError> => At,
    SceneError => Scene,
    MeshError => Mesh,
    ReductionError => Reduction,
    StaticError => Solver,
    LumpedError => Lumped,
    RatingError => Rating,
    GearboxError => Gearbox,
    PeriodicError<AnalysisError> => Periodic,
    Refusal => Refused,
}

impl From<MotionError<GearboxError>> for AnalysisError {
    fn from(source: MotionError<GearboxError>) -> Self {
        GearboxError::from(source).into()
    }
}

impl From<fem::FemError> for AnalysisError {
    fn from(source: fem::FemError) -> Self {
        ReductionError::from(source).into()
    }
}

impl From<ale::AleError> for AnalysisError {
    fn from(source: ale::AleError) -> Self {
        StaticError::from(source).into()
    }
}

impl From<CalculixError> for AnalysisError {
    fn from(source: CalculixError) -> Self {
        Refusal::no_result(source.to_string(), source.hint()).into()
    }
}

impl AnalysisError {
    /// This error at a place. Cancellation, errors of sinks and lack of space for rows have no place.
    #[must_use]
    pub fn at(self, place: Place) -> Self {
        match self {
            Self::Cancelled | Self::Sink(_) | Self::Rows(_) => self,
            source => Located { place, source }.into(),
        }
    }

    /// This error in a file.
    #[must_use]
    pub(crate) fn in_file(self, file: &Path) -> Self {
        self.at(Place::File(file.into()))
    }

    /// This error of a part of what was asked about: a gear, a mesh, a table.
    #[must_use]
    pub(crate) fn of_part(self, name: impl Into<Box<str>>) -> Self {
        self.at(Place::part(name))
    }

    /// Where it happened, the outermost place first; includes the places of [`AnalysisError::Scene`].
    pub fn places(&self) -> impl Iterator<Item = &Place> {
        let mut next = Some(self);
        std::iter::from_fn(move || {
            while let Some(error) = next {
                next = error.inner();
                match error {
                    Self::At(located) => return Some(&located.place),
                    Self::Scene(scene) => return scene.place(),
                    _ => {}
                }
            }
            None
        })
    }

    /// The error that there is no bound for a quantity that a scene requests.
    pub fn without_bound(scene: &Scene, quantity: scene::Quantity) -> Self {
        in_scene(scene)(Refusal::no_bound(quantity))
    }

    /// The cause, without the places around it.
    pub fn what(&self) -> &Self {
        self.inner().map_or(self, Self::what)
    }

    fn inner(&self) -> Option<&Self> {
        match self {
            Self::At(located) => Some(&located.source),
            Self::Shared(source) => Some(source),
            _ => None,
        }
    }

    /// Who must act on the error.
    pub fn blame(&self) -> Blame {
        let without_result = match self.what() {
            Self::Refused(refusal) => return refusal.blame,
            Self::Periodic(_) | Self::Statistics(_) | Self::Certificate(_) => true,
            Self::Rows(_) | Self::Sink(_) | Self::Cancelled => true,
            Self::Lumped(source) => matches!(**source, LumpedError::NoEquilibrium),
            Self::Gearbox(source) => source.is_without_result(),
            Self::Reduction(source) => source.is_without_result(),
            Self::Solver(source) => matches!(**source, StaticError::Contact { .. } | StaticError::NoEquilibrium { .. }),
            Self::At(_) | Self::Shared(_) | Self::Scene(_) | Self::Mesh(_) | Self::Rating(_) => false,
        };
        if without_result { Blame::NoResult } else { Blame::Input }
    }

    /// Hint for the user: what to do next.
    pub fn hint(&self) -> Option<String> {
        match self.what() {
            Self::Scene(e) => e.hint(),
            Self::Mesh(source) => source.hint(),
            Self::Reduction(source) => source.hint(),
            Self::Solver(source) => source.hint(),
            Self::Lumped(source) => source.hint(),
            Self::Rating(_) => Some("`[rating]` asks for it: without the table the pair is solved as it is".to_owned()),
            Self::Gearbox(source) => source.hint(),
            Self::Periodic(_) => Some(
                "begin where the motion is small, far from a resonance (`from`), with more `most_harmonics` or a larger `tail`; `run = \"steady\"` shows whether the motion repeats itself there".to_owned(),
            ),
            Self::Statistics(e) => e.hint(),
            Self::Rows(e) => Some(e.hint().to_owned()),
            Self::Refused(refusal) => refusal.hint.clone(),
            Self::Certificate(failed) => Some(failed.hint.to_owned()),
            Self::At(_) | Self::Shared(_) | Self::Cancelled | Self::Sink(_) => None,
        }
    }

    /// The line of the scene that is meant, with a mark below it.
    pub fn excerpt(&self) -> Option<&str> {
        self.places().filter_map(Place::excerpt).last()
    }
}

/// The place of the first of these keys that the scene states, else its file.
pub(crate) fn place_in(scene: &Scene, keys: &[&str]) -> Place {
    scene.place_of(keys).unwrap_or_else(|| Place::File(scene.file.as_path().into()))
}

/// For `map_err`: what happened, in the scene's file.
pub(crate) fn in_scene<E: Into<AnalysisError>>(scene: &Scene) -> impl Fn(E) -> AnalysisError + Copy + '_ {
    |source| source.into().in_file(&scene.file)
}

/// A mesh that disagrees with its gear, and what to do; `file` names it, which may be in memory.
pub(crate) fn mismatch(file: &str, what: impl Into<String>, hint: impl Into<String>) -> AnalysisError {
    AnalysisError::from(Refusal::input(what, hint)).of_part(file)
}

/// What is wrong with the modes of a gear.
pub(crate) fn failed_modes(scene: &Scene, i: usize, source: ReductionError) -> AnalysisError {
    let gear = ["pinion", "wheel"][i];
    AnalysisError::from(source).of_part(format!("modes of the {gear}")).in_file(&scene.file)
}

/// The error that a scene does not ask for what is wanted of it.
pub(crate) fn unasked(scene: &Scene, wanted: &str) -> AnalysisError {
    in_scene(scene)(Refusal::unasked(wanted))
}

/// The error that the model of a scene reduces no gears.
pub(crate) fn nothing_to_reduce(scene: &Scene) -> AnalysisError {
    let hint = "use `model = \"reduced\"` in [analysis], or `--set analysis.model=reduced`";
    AnalysisError::from(Refusal::input("this model reduces nothing", hint)).at(place_in(scene, &["analysis.model"]))
}

/// The solver's error with the place in the scene that it concerns.
pub fn solver_error(scene: &Scene, source: StaticError) -> AnalysisError {
    let keys: &[&str] = match &source {
        StaticError::Overloaded { .. } => &["operation.torque_nm"],
        error if error.is_starved() => &["analysis.window_teeth"],
        _ => &[],
    };
    AnalysisError::from(source).at(place_in(scene, keys))
}
