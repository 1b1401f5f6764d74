//! Who hears what an analysis is doing.

use std::sync::Arc;

use answer::Cost;

use crate::AnalysisError;

/// How much work a phase has, as far as that is known beforehand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PhaseWork {
    /// Not known.
    Unknown,
    /// About so many seconds.
    Seconds(f64),
    /// So many steps, each told by [`Progress::tick`].
    Steps(u64),
    /// So many steps at the most: a search that ends when it has found what it looks for.
    AtMost(u64),
}

/// The progress of a running phase; threads share it.
pub trait Progress: Send + Sync {
    /// One more step is done.
    fn tick(&self);

    /// A word beside the bar.
    fn say(&self, message: String);

    /// Whether who waits has given up: the work ends where it is asked next, with [`AnalysisError::Cancelled`].
    fn is_cancelled(&self) -> bool {
        false
    }
}

/// Ends work that nobody waits for any more.
///
/// # Errors
/// [`AnalysisError::Cancelled`].
pub fn unless_cancelled(progress: &dyn Progress) -> Result<(), AnalysisError> {
    if progress.is_cancelled() { Err(AnalysisError::Cancelled) } else { Ok(()) }
}

/// Hears of the phases of an analysis, one after the other.
pub trait Observer {
    /// A phase begins.
    fn begin(&mut self, phase: &str, work: PhaseWork) -> Arc<dyn Progress>;

    /// The phase that began last is over.
    fn end(&mut self);

    /// What those who wait should hear before the end.
    fn note(&mut self, _message: String) {}
}

/// Hears of the phases, and knows what they cost.
pub trait Recorder: Observer {
    /// Cost of all phases so far.
    fn cost(&self) -> Cost;
}

/// Hears nothing.
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

/// Does the work of a phase between its beginning and its end.
pub fn run_phase<T>(
    observer: &mut dyn Observer,
    phase: &str,
    work: PhaseWork,
    task: impl FnOnce(&dyn Progress) -> T,
) -> T {
    let progress = observer.begin(phase, work);
    let done = task(&*progress);
    observer.end();
    done
}
