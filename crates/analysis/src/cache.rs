//! Reduced gears, and maps of their contact, that are kept from run to run.

use answer::Remark;
use std::{fmt, sync::Arc};

use contact_map::ContactMap;
use reduction::{PartStore, RecordKey, ReductionRecord};

/// A store of reduced gears and of maps.
///
/// Losing it loses time, never a result.
pub trait GearCache: Sync {
    /// Whether anything is kept.
    fn is_on(&self) -> bool;

    /// The record of a key, with the key that it was made for; `None` when there is none. A warning says what is wrong
    /// with one that cannot be used.
    fn load(&self, key: &RecordKey) -> (Option<Kept<RecordKey, ReductionRecord>>, Option<Remark>);

    /// Keeps a record; a warning says why it could not be done.
    fn save(&self, key: &RecordKey, record: &ReductionRecord) -> Option<Remark>;

    /// Where parts of a gear are kept beside its record: columns of its teeth as soon as they are made, the factor of its
    /// sector. A store need not keep them.
    fn parts(&self, _: &RecordKey) -> Option<Arc<dyn PartStore>> {
        None
    }

    /// Whether an earlier run has found the mesh of a key sound. A store need not remember.
    fn is_sound(&self, _: &SoundKey) -> bool {
        false
    }

    /// Remembers that a mesh is sound; where that fails it is checked again.
    fn keep_sound(&self, _: &SoundKey) {}

    /// The maps of a key, as [`GearCache::load`]. A store need not keep maps.
    fn load_maps(&self, _: &MapKey) -> (Option<Kept<MapKey, Vec<ContactMap>>>, Option<Remark>) {
        (None, None)
    }

    /// Keeps maps, as [`GearCache::save`].
    fn save_maps(&self, _: &MapKey, _: &[&ContactMap]) -> Option<Remark> {
        None
    }
}

/// What a store hands out, with the key that it was made for: who asked takes it for no other.
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

/// Version of what the numbers of a map mean and of how they come about: raised with every change of the code by which
/// the same scene gets other maps (the test `maps_are_those_of_their_version` notices), so that nobody takes those of before.
pub const MAP_VERSION: u32 = 3;

/// Names maps: equal for equal gears in equal contact, in practice different for any others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MapKey([u8; 32]);

impl MapKey {
    /// Key of the reduced gears, of [`MAP_VERSION`], and of all else that their contact depends on, in words.
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

/// Version of the checks of a mesh: raised with every change of the code that finds another mesh sound (the test
/// `checks_of_meshes_are_those_of_their_version` notices), so that nobody passes by checks of before.
pub const SOUND_VERSION: u32 = 1;

/// Names the file of a mesh and how it is read: equal for equal ones, in practice different for any others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SoundKey([u8; 32]);

impl SoundKey {
    /// Key of a file with these bytes (BLAKE3 in words), of [`SOUND_VERSION`], and of how it is read, in words.
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

/// Keeps nothing.
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
