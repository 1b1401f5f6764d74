//! Observer of an analysis and its phases.

use std::sync::Arc;

use answer::Cost;

use crate::AnalysisError;

/// Amount of work of a phase, as far as it is known in advance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PhaseWork {
    /// Unknown amount.
    Unknown,
    /// About this number of seconds.
    Seconds(f64),
    /// This number of steps, each reported by [`Progress::tick`].
    Steps(u64),
    /// At most this number of steps: a search that ends when it has succeeded.
    AtMost(u64),
}

/// Progress of a running phase; threads share it.
pub trait Progress: Send + Sync {
    /// Called when one more step is done.
    fn tick(&self);

    /// Shows a message beside the progress bar.
    fn say(&self, message: String);

    /// Whether the work is cancelled. It then ends at the next check, with [`AnalysisError::Cancelled`].
    fn is_cancelled(&self) -> bool {
        false
    }
}

/// Returns an error if the work is cancelled.
///
/// # Errors
/// [`AnalysisError::Cancelled`] if it is.
pub fn unless_cancelled(progress: &dyn Progress) -> Result<(), AnalysisError> {
    if progress.is_cancelled() { Err(AnalysisError::Cancelled) } else { Ok(()) }
}

/// Receives the phases of an analysis, one after the other.
pub trait Observer {
    /// Called when a phase begins.
    fn begin(&mut self, phase: &str, work: PhaseWork) -> Arc<dyn Progress + '_>;

    /// Called when the last phase ends.
    fn end(&mut self);

    /// Called with messages that should be shown before the end.
    fn note(&mut self, _message: String) {}
}

/// An observer that also records the cost of the phases.
pub trait Recorder: Observer {
    /// Cost of all phases so far.
    fn cost(&self) -> Cost;
}

/// Observer that does nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoObserver;

impl Observer for NoObserver {
    fn begin(&mut self, _: &str, _: PhaseWork) -> Arc<dyn Progress> {
        Arc::new(Self)
    }

    fn end(&mut self) {}
}

impl Progress for NoObserver {
    fn tick(&self) {}

    fn say(&self, _: String) {}
}

/// Runs the work of a phase between its beginning and its end.
pub fn run_phase<T>(
    observer: &mut dyn Observer,
    phase: &str,
    work: PhaseWork,
    task: impl FnOnce(&dyn Progress) -> T,
) -> T {
    let done = task(&*observer.begin(phase, work));
    observer.end();
    done
}
