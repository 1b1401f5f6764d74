//! Keeps reduced gears in memory, from rung to rung of the ladder and for later requests.

use answer::Remark;
use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, PoisonError},
};

use contact_map::ContactMap;
use reduction::{PartStore, RecordKey, ReductionRecord};

use crate::{GearCache, Kept, MapKey, SoundKey};

/// Reduced gears in memory, in front of the caller's own store.
pub struct GearMemo<'a> {
    store: Arc<dyn GearCache + Send + 'a>,
    kept: Mutex<BTreeMap<String, ReductionRecord>>,
}

impl<'a> GearMemo<'a> {
    /// An empty memo in front of `store`.
    pub fn new(store: &'a dyn GearCache) -> Self {
        Self::holding(Arc::new(store))
    }

    /// A memo in front of a store that may be shared.
    pub fn holding(store: Arc<dyn GearCache + Send + 'a>) -> Self {
        Self { store, kept: Mutex::default() }
    }
}

impl std::fmt::Debug for GearMemo<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("GearMemo").finish_non_exhaustive()
    }
}

impl GearCache for GearMemo<'_> {
    fn is_on(&self) -> bool {
        true
    }

    fn load(&self, key: &RecordKey) -> (Option<Kept<RecordKey, ReductionRecord>>, Option<Remark>) {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner).get(&key.to_string()).cloned();
        match kept {
            Some(record) => (Some(Kept::new(*key, record)), None),
            None if self.store.is_on() => self.store.load(key),
            None => (None, None),
        }
    }

    fn save(&self, key: &RecordKey, record: &ReductionRecord) -> Option<Remark> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner).insert(key.to_string(), record.clone());
        if self.store.is_on() { self.store.save(key, record) } else { None }
    }

    fn parts(&self, key: &RecordKey) -> Option<Arc<dyn PartStore>> {
        self.store.parts(key)
    }

    fn is_sound(&self, key: &SoundKey) -> bool {
        self.store.is_sound(key)
    }

    fn keep_sound(&self, key: &SoundKey) {
        self.store.keep_sound(key);
    }

    fn load_maps(&self, key: &MapKey) -> (Option<Kept<MapKey, Vec<ContactMap>>>, Option<Remark>) {
        self.store.load_maps(key)
    }

    fn save_maps(&self, key: &MapKey, maps: &[&ContactMap]) -> Option<Remark> {
        self.store.save_maps(key, maps)
    }
}
