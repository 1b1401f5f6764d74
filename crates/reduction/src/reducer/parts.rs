//! Parts of a gear stored beside its record: columns of its teeth, the factor of its sector, tables.

use std::{
    collections::BTreeSet,
    sync::{
        Arc, Mutex, OnceLock, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
};

use fem::BoundaryLastFactor;

use super::{GearReducer, Method, ReductionWay};
use crate::{PartFault, PartStore, TableKey};

/// Entries of a factor that is kept: 32 MB.
const MOST_ENTRIES: usize = 4 << 20;

/// The store, and what came of it.
#[derive(Debug, Default)]
pub(super) struct Parts {
    store: OnceLock<Arc<dyn PartStore>>,
    /// Whether it has the factor.
    has_factor: AtomicBool,
    /// Tables that it has.
    tables: Mutex<BTreeSet<TableKey>>,
    faults: Mutex<Vec<PartFault>>,
}

/// Store for the part of a table that is not for the normals.
#[derive(Debug, Clone)]
pub struct TablePart {
    parts: Arc<Parts>,
    key: TableKey,
    at_hand: Option<Arc<Vec<f64>>>,
}

impl TablePart {
    /// The stored values, if any.
    pub fn load(&self) -> Option<Arc<Vec<f64>>> {
        if let Some(at_hand) = &self.at_hand {
            return Some(at_hand.clone());
        }
        let store = self.parts.store()?;
        self.parts.heard(store.load_table(&self.key))?.map(Arc::new)
    }

    /// Stores the values.
    pub fn save(&self, values: &[f64]) {
        if let Some(store) = self.parts.store() {
            self.parts.heard(store.save_table(&self.key, values));
        }
    }
}

impl Parts {
    /// Parts of a gear whose record has these tables.
    pub(super) fn of_tables(tables: impl Iterator<Item = TableKey>) -> Self {
        Self { tables: Mutex::new(tables.collect()), ..Self::default() }
    }

    pub(super) fn store(&self) -> Option<&dyn PartStore> {
        self.store.get().map(|store| &**store)
    }

    /// What a store answers; a fault is told of later.
    fn heard<T>(&self, answer: Result<T, PartFault>) -> Option<T> {
        answer.map_err(|fault| self.faults.lock().unwrap_or_else(PoisonError::into_inner).push(fault)).ok()
    }
}

impl GearReducer {
    /// This gear with a store for its parts.
    #[must_use]
    pub fn with_parts(self, store: Arc<dyn PartStore>) -> Self {
        // One that it has already stays.
        let _ = self.asked.parts.store.set(store);
        self
    }

    /// Faults of stored files since the last call.
    pub fn part_faults(&self) -> Vec<PartFault> {
        let own = &mut *self.asked.parts.faults.lock().unwrap_or_else(PoisonError::into_inner);
        own.drain(..).chain(self.column_faults()).collect()
    }

    /// Stores what this run has computed beside the record, if there is a store: the factor of the sector (if it is not
    /// too large), with which a later run recovers fields, and tables.
    pub fn keep_parts(&self) {
        let parts = &self.asked.parts;
        let Some(store) = parts.store() else { return };
        let mut kept = parts.tables.lock().unwrap_or_else(PoisonError::into_inner);
        for (key, table) in self.asked.tables().iter() {
            if let Some(others) = table.others.as_ref().filter(|_| kept.insert(*key)) {
                parts.heard(store.save_table(key, others));
            }
        }
        if let Some(Ok(method)) = self.method.get() {
            self.keep_factor(method);
        }
    }

    /// Keeps the factor of a method, unless it is kept.
    pub(super) fn keep_factor(&self, method: &Method) {
        let parts = &self.asked.parts;
        let (Some(store), Method::Cyclic(cyclic)) = (parts.store(), method) else { return };
        let (factor, known) = (cyclic.factor(), parts.has_factor.load(Ordering::Relaxed));
        if known || !self.coordinates.are_nodes() || factor.nonzeros() > MOST_ENTRIES {
            return;
        }
        let kept = factor.to_kept().and_then(|kept| parts.heard(store.save_factor(&kept)));
        parts.has_factor.store(kept.is_some(), Ordering::Relaxed);
    }

    /// Store for the part of a table that is not for the normals; it may be `at_hand`, that is in memory.
    pub fn table_part(&self, key: &TableKey, at_hand: Option<Arc<Vec<f64>>>) -> TablePart {
        TablePart { parts: self.asked.parts.clone(), key: *key, at_hand }
    }

    /// The factor of the sector that a store has.
    pub(super) fn kept_factor(&self) -> Option<BoundaryLastFactor> {
        let parts = &self.asked.parts;
        let store = parts.store().filter(|_| self.summary.way == ReductionWay::CyclicSector)?;
        let factor = BoundaryLastFactor::from_kept(&parts.heard(store.load_factor())??)?;
        parts.has_factor.store(true, Ordering::Relaxed);
        Some(factor)
    }
}
