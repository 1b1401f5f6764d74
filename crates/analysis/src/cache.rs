//! Reduced gears that are kept from run to run.

use reduction::{RecordKey, ReductionRecord};

/// A store of reduced gears.
///
/// Losing it loses time, never a result.
pub trait GearCache: Sync {
    /// Whether anything is kept.
    fn is_on(&self) -> bool;

    /// The record of a key; `None` when there is none. A warning says what is wrong with one that cannot be used.
    fn load(&self, key: &RecordKey) -> (Option<ReductionRecord>, Option<String>);

    /// Keeps a record; a warning says why it could not be done.
    fn save(&self, key: &RecordKey, record: &ReductionRecord) -> Option<String>;
}

/// Keeps nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoCache;

impl GearCache for NoCache {
    fn is_on(&self) -> bool {
        false
    }

    fn load(&self, _: &RecordKey) -> (Option<ReductionRecord>, Option<String>) {
        (None, None)
    }

    fn save(&self, _: &RecordKey, _: &ReductionRecord) -> Option<String> {
        None
    }
}
