//! Results that have been requested from a gear so far.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError},
};

use geometry::Side;

use super::{Summary, parts::Parts, tooth_windows::ToothWindows};
use crate::{KeptTable, LocalCompliance, ReducedGear, ReductionRecord, TableKey};

type Halves = BTreeMap<(u32, Side), Arc<LocalCompliance>>;
type Tables = BTreeMap<TableKey, KeptTable>;

/// Results that were found when first asked for, or came from a record.
#[derive(Debug, Default)]
pub(super) struct Asked {
    /// Lowest frequency with the bore held and the flanks free, Hz.
    pub(super) lowest_hz: OnceLock<f64>,
    /// Windows but the first one, of a gear that is not cyclic.
    pub(super) others: ToothWindows,
    /// What is kept beside the record.
    pub(super) parts: Arc<Parts>,
    halves: Mutex<Halves>,
    tables: Mutex<Tables>,
    /// Half teeth, frequencies and tables that came from a record, so many.
    recorded: Option<[usize; 3]>,
}

impl Asked {
    /// All that a record has beside the first window.
    pub(super) fn recorded(
        halves: Vec<((u32, Side), Arc<LocalCompliance>)>,
        lowest_hz: Option<f64>,
        tables: Vec<(TableKey, KeptTable)>,
    ) -> Self {
        let asked = Self {
            lowest_hz: lowest_hz.map_or_else(OnceLock::new, OnceLock::from),
            others: ToothWindows::default(),
            parts: Arc::new(Parts::of_tables(tables.iter().map(|(key, _)| *key))),
            halves: Mutex::new(halves.into_iter().collect()),
            tables: Mutex::new(tables.into_iter().collect()),
            recorded: None,
        };
        let recorded = Some(asked.counts());
        Self { recorded, ..asked }
    }

    /// Whether the gear came from a record.
    pub(super) fn is_from_record(&self) -> bool {
        self.recorded.is_some()
    }

    /// Half teeth by tooth and side.
    pub(super) fn halves(&self) -> MutexGuard<'_, Halves> {
        self.halves.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Tables by key.
    pub(super) fn tables(&self) -> MutexGuard<'_, Tables> {
        self.tables.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A record of all this and of the first window; `None` when one has it all already.
    pub(super) fn record(&self, summary: Summary, base: &Arc<ReducedGear>) -> Option<ReductionRecord> {
        (self.recorded != Some(self.counts())).then(|| ReductionRecord {
            summary,
            lowest_hz: self.lowest_hz.get().copied(),
            window: base.clone(),
            halves: self.halves().iter().map(|(&flank, half)| (flank, half.clone())).collect(),
            tables: self.tables().iter().map(|(&key, table)| (key, table.clone())).collect(),
        })
    }

    fn counts(&self) -> [usize; 3] {
        [self.halves().len(), usize::from(self.lowest_hz.get().is_some()), self.tables().len()]
    }
}
