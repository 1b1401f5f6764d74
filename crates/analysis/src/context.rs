//! Settings with which a document is solved, and how the solution ended.

use mesh::Mesh;
use scene::{Scene, gearbox::Gearbox};

use crate::{AnalysisError, GearCache, NoCache, Observer, RemarksAtRest, SharedModels};

/// A document that `solve` answers: a scene of one pair, or a gearbox.
pub trait Question {
    /// Type of the result.
    type Answer;
    /// Type that receives rows of a motion as they are computed.
    type Sink<'s>: ?Sized + 's;
    /// State from which a motion continues, with the preceding rows.
    type State;

    /// Solves the document.
    ///
    /// # Errors
    /// [`AnalysisError`].
    fn answer(&self, context: Context<'_, Self>) -> Result<Ending<Self::Answer>, AnalysisError>;
}

/// Settings of a solution: observer, cache of reduced gears, sink for rows, and the part of a motion that is requested.
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
    /// Context with an observer, without a cache, to the end, with all rows in memory.
    pub fn new(observer: &'a mut dyn Observer) -> Self {
        let (models, meshes, sink, from, stop_after) = (None, None, None, None, None);
        let remarks = RemarksAtRest::Collected;
        Self { observer, cache: &NoCache, models, meshes, remarks, line_lengths: true, sink, from, stop_after }
    }

    /// Takes reduced gears from a cache and stores new ones there.
    #[must_use]
    pub fn with_cache(self, cache: &'a dyn GearCache) -> Self {
        Self { cache, ..self }
    }

    /// Passes rows and checkpoints of a motion to a sink as they are computed.
    #[must_use]
    pub fn with_sink(self, sink: &'a mut Q::Sink<'a>) -> Self {
        Self { sink: Some(sink), ..self }
    }

    /// Continues from a state of a motion, with the preceding rows.
    #[must_use]
    pub fn resume(self, from: Q::State) -> Self {
        Self { from: Some(from), ..self }
    }

    /// Stops a motion after a number of mesh cycles (for a gearbox those of its fastest mesh), settling included, and
    /// returns a checkpoint; `None`: only at its end.
    #[must_use]
    pub fn stop_after(self, cycles: Option<u64>) -> Self {
        Self { stop_after: cycles, ..self }
    }
}

impl<'a> Context<'a, Gearbox> {
    /// Shares gears with earlier gearboxes, with their cache.
    #[must_use]
    pub fn with_models(self, models: &'a SharedModels<'a>) -> Self {
        Self { models: Some(models), cache: models.cache(), ..self }
    }
}

impl<'a> Context<'a, Scene> {
    /// Shares static gears with earlier scenes of its kind, with their cache and meshes.
    #[must_use]
    pub fn with_models(self, models: &'a SharedModels<'a>) -> Self {
        Self { models: Some(models), cache: models.cache(), meshes: models.meshes(), ..self }
    }

    /// Uses meshes of pinion and wheel instead of those of the scene, if given. They are checked like mesh files.
    #[must_use]
    pub fn with_meshes(self, meshes: Option<[&'a Mesh; 2]>) -> Self {
        Self { meshes, ..self }
    }

    /// Whether remarks about a static pair are collected.
    #[must_use]
    pub fn with_remarks(self, remarks: RemarksAtRest) -> Self {
        Self { remarks, ..self }
    }

    /// Whether static positions have the lengths of their contact lines under load, on which nothing else depends.
    /// Otherwise they are NaN.
    #[must_use]
    pub fn with_line_lengths(self, line_lengths: bool) -> Self {
        Self { line_lengths, ..self }
    }
}

/// How a solution ended.
#[derive(Debug)]
pub enum Ending<A> {
    /// It was completed with a result.
    Finished(A),
    /// It stopped where the context requested; the sink has a checkpoint.
    Stopped {
        /// Number of completed mesh cycles.
        cycles: u64,
    },
}

impl<A> Ending<A> {
    /// The result of a solution that was to be completed.
    ///
    /// # Errors
    /// [`AnalysisError::Cancelled`] if it was not.
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
