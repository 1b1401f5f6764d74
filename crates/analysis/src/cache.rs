//! Stores for reduced gears, and for maps of their contact, across runs.

use answer::Remark;
use std::{fmt, sync::Arc};

use contact_map::ContactMap;
use reduction::{PartStore, RecordKey, ReductionRecord};

/// A store of reduced gears and of contact maps.
///
/// If its content is lost, runs take longer, but results stay the same.
pub trait GearCache: Sync {
    /// Whether the store keeps anything.
    fn is_on(&self) -> bool;

    /// The record of a key, with the key for which it was made; `None` if there is none. A warning explains why a
    /// record cannot be used.
    fn load(&self, key: &RecordKey) -> (Option<Kept<RecordKey, ReductionRecord>>, Option<Remark>);

    /// Stores a record; a warning explains why it could not be stored.
    fn save(&self, key: &RecordKey, record: &ReductionRecord) -> Option<Remark>;

    /// Store for parts of a gear beside its record: columns of its teeth as soon as they are computed, and the factor
    /// of its sector. A store need not keep them.
    fn parts(&self, _: &RecordKey) -> Option<Arc<dyn PartStore>> {
        None
    }

    /// Whether an earlier run found the mesh of a key to be valid. A store need not remember this.
    fn is_sound(&self, _: &SoundKey) -> bool {
        false
    }

    /// Remembers that a mesh is valid. If this fails, the mesh is checked again.
    fn keep_sound(&self, _: &SoundKey) {}

    /// The maps of a key, as in [`GearCache::load`]. A store need not keep maps.
    fn load_maps(&self, _: &MapKey) -> (Option<Kept<MapKey, Vec<ContactMap>>>, Option<Remark>) {
        (None, None)
    }

    /// Stores maps, as in [`GearCache::save`].
    fn save_maps(&self, _: &MapKey, _: &[&ContactMap]) -> Option<Remark> {
        None
    }
}

/// An item of a store, with the key for which it was made, so that it cannot be used for another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Kept<K, T> {
    key: K,
    content: T,
}

impl<K: PartialEq, T> Kept<K, T> {
    /// Content that was made for a key.
    pub fn new(key: K, content: T) -> Self {
        Self { key, content }
    }

    /// The content, if it was made for this key.
    pub fn of(self, key: &K) -> Option<T> {
        (self.key == *key).then_some(self.content)
    }
}

/// Version of the meaning of a map's numbers and of their computation. It is raised with every change of the code that
/// gives the same scene other maps, so that older maps are not used. The test `maps_are_those_of_their_version` detects
/// such a change.
pub const MAP_VERSION: u32 = 3;

/// Name of maps: equal for equal gears in equal contact, in practice different for any others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MapKey([u8; 32]);

impl MapKey {
    /// Key from the keys of the reduced gears, [`MAP_VERSION`], and a text of everything else on which their contact
    /// depends.
    pub fn new(gears: &[RecordKey], contact: &str) -> Self {
        let gears = gears.iter().map(ToString::to_string);
        let versions = format!("{} {MAP_VERSION}", env!("CARGO_PKG_VERSION"));
        Self(of_words(gears.chain([versions, contact.to_owned()])))
    }
}

impl fmt::Display for MapKey {
    /// 64 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// Version of the checks of a mesh. It is raised with every change of the code that changes which meshes are valid, so
/// that older checks are not used. The test `checks_of_meshes_are_those_of_their_version` detects such a change.
pub const SOUND_VERSION: u32 = 1;

/// Name of a mesh file and of the way in which it is read: equal for equal ones, in practice different for any others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SoundKey([u8; 32]);

impl SoundKey {
    /// Key from the content of a file (BLAKE3 as text), [`SOUND_VERSION`], and a text of how it is read.
    pub fn new(file: &str, read_as: &str) -> Self {
        let versions = format!("{} {SOUND_VERSION}", env!("CARGO_PKG_VERSION"));
        Self(of_words([versions, file.to_owned(), read_as.to_owned()]))
    }
}

impl fmt::Display for SoundKey {
    /// 64 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// BLAKE3 of words, each with its length before it.
fn of_words(words: impl IntoIterator<Item = String>) -> [u8; 32] {
    let mut hasher = blake3::Hasher::new();
    for word in words {
        hasher.update(&(word.len() as u64).to_le_bytes());
        hasher.update(word.as_bytes());
    }
    *hasher.finalize().as_bytes()
}

impl<T: GearCache + ?Sized> GearCache for &T {
    fn is_on(&self) -> bool {
        (**self).is_on()
    }

    fn load(&self, key: &RecordKey) -> (Option<Kept<RecordKey, ReductionRecord>>, Option<Remark>) {
        (**self).load(key)
    }

    fn save(&self, key: &RecordKey, record: &ReductionRecord) -> Option<Remark> {
        (**self).save(key, record)
    }

    fn parts(&self, key: &RecordKey) -> Option<Arc<dyn PartStore>> {
        (**self).parts(key)
    }

    fn is_sound(&self, key: &SoundKey) -> bool {
        (**self).is_sound(key)
    }

    fn keep_sound(&self, key: &SoundKey) {
        (**self).keep_sound(key);
    }

    fn load_maps(&self, key: &MapKey) -> (Option<Kept<MapKey, Vec<ContactMap>>>, Option<Remark>) {
        (**self).load_maps(key)
    }

    fn save_maps(&self, key: &MapKey, maps: &[&ContactMap]) -> Option<Remark> {
        (**self).save_maps(key, maps)
    }
}

/// Cache that stores nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoCache;

impl GearCache for NoCache {
    fn is_on(&self) -> bool {
        false
    }

    fn load(&self, _: &RecordKey) -> (Option<Kept<RecordKey, ReductionRecord>>, Option<Remark>) {
        (None, None)
    }

    fn save(&self, _: &RecordKey, _: &ReductionRecord) -> Option<Remark> {
        None
    }
}
