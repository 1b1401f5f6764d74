//! What a document is solved with, and how that ended.

use mesh::Mesh;
use scene::{Scene, gearbox::Gearbox};

use crate::{AnalysisError, GearCache, NoCache, Observer, RemarksAtRest, SharedModels};

/// A document that `solve` answers: a scene of one pair, or a gearbox.
pub trait Question {
    /// What comes out.
    type Answer;
    /// Who gets rows of a motion as they come.
    type Sink<'s>: ?Sized + 's;
    /// A state that a motion goes on from, with the rows before it.
    type State;

    /// Solves it.
    ///
    /// # Errors
    /// [`AnalysisError`].
    fn answer(&self, context: Context<'_, Self>) -> Result<Ending<Self::Answer>, AnalysisError>;
}

/// What a document is solved with: who waits, gears that are reduced already, who gets rows, and which part of a motion
/// is wanted.
pub struct Context<'a, Q: Question + ?Sized> {
    pub(crate) observer: &'a mut dyn Observer,
    pub(crate) cache: &'a dyn GearCache,
    pub(crate) models: Option<&'a SharedModels<'a>>,
    pub(crate) meshes: Option<[&'a Mesh; 2]>,
    pub(crate) remarks: RemarksAtRest,
    pub(crate) line_lengths: bool,
    pub(crate) sink: Option<&'a mut Q::Sink<'a>>,
    pub(crate) from: Option<Q::State>,
    pub(crate) stop_after: Option<u64>,
}

impl<'a, Q: Question + ?Sized> Context<'a, Q> {
    /// Context of who waits, without a cache, to the end, all rows in memory.
    pub fn new(observer: &'a mut dyn Observer) -> Self {
        let (models, meshes, sink, from, stop_after) = (None, None, None, None, None);
        let remarks = RemarksAtRest::Collected;
        Self { observer, cache: &NoCache, models, meshes, remarks, line_lengths: true, sink, from, stop_after }
    }

    /// With reduced gears from a cache, and into it.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// With someone who gets rows and checkpoints of a motion as they come.
    #[must_use]
    pub fn with_sink(self, sink: &'a mut Q::Sink<'a>) -> Self {
        Self { sink: Some(sink), ..self }
    }

    /// From a state of a motion on, with the rows before it.
    #[must_use]
    pub fn resume(self, from: Q::State) -> Self {
        Self { from: Some(from), ..self }
    }

    /// Stops a motion when so many mesh cycles are done (of a gearbox those of its fastest mesh), settling included, and
    /// hands out a checkpoint; `None`: at its end only.
    #[must_use]
    pub fn stop_after(self, cycles: Option<u64>) -> Self {
        Self { stop_after: cycles, ..self }
    }
}

impl<'a> Context<'a, Gearbox> {
    /// On what earlier gearboxes have left of their gears, with their cache.
    #[must_use]
    pub fn with_models(self, models: &'a SharedModels<'a>) -> Self {
        Self { models: Some(models), cache: models.cache(), ..self }
    }
}

impl<'a> Context<'a, Scene> {
    /// On what earlier scenes of its kind have left of their gears at rest, with their cache and meshes.
    #[must_use]
    pub fn with_models(self, models: &'a SharedModels<'a>) -> Self {
        Self { models: Some(models), cache: models.cache(), meshes: models.meshes(), ..self }
    }

    /// With meshes of pinion and wheel in place of those of the scene, where they are given. They are checked as files
    /// are.
    #[must_use]
    pub fn with_meshes(self, meshes: Option<[&'a Mesh; 2]>) -> Self {
        Self { meshes, ..self }
    }

    /// Whether it is found out what a user should hear of a pair at rest.
    #[must_use]
    pub fn with_remarks(self, remarks: RemarksAtRest) -> Self {
        Self { remarks, ..self }
    }

    /// Whether positions at rest have the lengths of their contact lines under load, which nothing else follows from;
    /// those of others are no numbers.
    #[must_use]
    pub fn with_line_lengths(self, line_lengths: bool) -> Self {
        Self { line_lengths, ..self }
    }
}

/// How a solve ended.
#[derive(Debug)]
pub enum Ending<A> {
    /// With its answer.
    Finished(A),
    /// Where the context says; the sink has a checkpoint.
    Stopped {
        /// Mesh cycles done.
        cycles: u64,
    },
}

impl<A> Ending<A> {
    /// The answer of what was not to stop on its way.
    ///
    /// # Errors
    /// [`AnalysisError::Cancelled`] where it did.
    pub fn finished(self) -> Result<A, AnalysisError> {
        match self {
            Self::Finished(answer) => Ok(answer),
            Self::Stopped { .. } => Err(AnalysisError::Cancelled),
        }
    }

    pub(crate) fn map<B>(self, of: impl FnOnce(A) -> B) -> Ending<B> {
        match self {
            Self::Finished(answer) => Ending::Finished(of(answer)),
            Self::Stopped { cycles } => Ending::Stopped { cycles },
        }
    }
}
