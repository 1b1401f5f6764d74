//! What was asked of a gear so far.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError},
};

use geometry::Side;

use super::Summary;
use crate::{LocalCompliance, ReducedGear, ReductionRecord};

type Windows = BTreeMap<u32, Arc<ReducedGear>>;
type Halves = BTreeMap<(u32, Side), Arc<LocalCompliance>>;

/// Results that were found when first asked for, or came from a record.
#[derive(Debug, Default)]
pub(super) struct Asked {
    /// Lowest frequency with the bore held and the flanks free, Hz.
    pub(super) lowest_hz: OnceLock<f64>,
    others: Mutex<Windows>,
    halves: Mutex<Halves>,
    /// Further windows, half teeth and frequencies that came from a record, so many.
    recorded: Option<[usize; 3]>,
}

impl Asked {
    /// All that a record has; the windows but the first one by their first teeth.
    pub(super) fn recorded(
        others: Windows,
        halves: Vec<((u32, Side), Arc<LocalCompliance>)>,
        lowest_hz: Option<f64>,
    ) -> Self {
        let asked = Self {
            lowest_hz: lowest_hz.map_or_else(OnceLock::new, OnceLock::from),
            others: Mutex::new(others),
            halves: Mutex::new(halves.into_iter().collect()),
            recorded: None,
        };
        let recorded = Some(asked.counts());
        Self { recorded, ..asked }
    }

    /// Whether the gear came from a record.
    pub(super) fn is_from_record(&self) -> bool {
        self.recorded.is_some()
    }

    /// Windows but the first one, by their first teeth.
    pub(super) fn others(&self) -> MutexGuard<'_, Windows> {
        self.others.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Half teeth by tooth and side.
    pub(super) fn halves(&self) -> MutexGuard<'_, Halves> {
        self.halves.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A record of all this and of the first window; `None` when one has it all already.
    pub(super) fn record(&self, summary: Summary, base: &Arc<ReducedGear>) -> Option<ReductionRecord> {
        (self.recorded != Some(self.counts())).then(|| ReductionRecord {
            summary,
            lowest_hz: self.lowest_hz.get().copied(),
            windows: std::iter::once(base).chain(self.others().values()).cloned().collect(),
            halves: self.halves().iter().map(|(&flank, half)| (flank, half.clone())).collect(),
        })
    }

    fn counts(&self) -> [usize; 3] {
        [self.others().len(), self.halves().len(), usize::from(self.lowest_hz.get().is_some())]
    }
}
