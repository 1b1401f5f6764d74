//! Places of a scene's keys, collected once for errors that are found after the checks.

use std::{collections::BTreeMap, ops::Range, sync::Arc};

use crate::{Place, Scene, Setting, data_file::DataFiles, origin::Origin, tree::Node};

/// Places by keys with dots; a table's own name stands for its heading.
#[derive(Debug, Clone, Default)]
pub(crate) struct Places(BTreeMap<String, Place>);

impl Places {
    /// Places of everything in a table except entries of lists.
    pub fn of(root: &Node, place: &dyn Fn(&Range<usize>) -> Place) -> Self {
        let mut all = Self::default();
        all.take(root, "", place);
        all
    }

    fn take(&mut self, table: &Node, before: &str, place: &dyn Fn(&Range<usize>) -> Place) {
        for (key, entry) in table.entries() {
            let key = if before.is_empty() { key.clone() } else { format!("{before}.{key}") };
            self.take(&entry.node, &key, place);
            self.0.insert(key, place(&entry.node.span));
        }
    }

    /// These places with the settings in addition to the file. If a key is set twice, the last setting counts.
    pub fn with(&self, settings: &[Setting]) -> Self {
        let mut all = self.clone();
        for setting in settings {
            let place = Place::Setting { label: setting.label().into() };
            let (key, parts) = (setting.path().join("."), setting.path());
            all.0.retain(|own, _| !own.strip_prefix(&key).is_some_and(|rest| rest.starts_with('.')));
            all.take(setting.value(), &key, &|_| place.clone());
            for n in 1..parts.len() {
                all.0.entry(parts[..n].join(".")).or_insert_with(|| place.clone());
            }
            all.0.insert(key, place);
        }
        all
    }
}

/// Origin of a scene: places of its keys, and the content of the files that it names. It holds no text and is equal to
/// any other, so scenes are compared by their meaning.
#[derive(Debug, Clone)]
pub struct Written(Arc<Provenance>);

#[derive(Debug)]
struct Provenance {
    places: Places,
    origin: Origin,
    files: Arc<DataFiles>,
}

impl PartialEq for Written {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Written {
    pub(super) fn new(places: Places, origin: Origin, files: Arc<DataFiles>) -> Self {
        Self(Arc::new(Provenance { places, origin, files }))
    }

    /// Whether the scene stands in files or in the program.
    pub(super) fn origin(&self) -> Origin {
        self.0.origin
    }

    /// What was read of the files that it names.
    pub(super) fn files(&self) -> &Arc<DataFiles> {
        &self.0.files
    }
}

impl Scene {
    /// Place of the first of these keys that is in the file. Keys are dotted paths (`pair.centre_distance_mm`); the
    /// name of a table stands for its heading. `None` if none is in the file.
    pub fn place_of(&self, keys: &[&str]) -> Option<Place> {
        keys.iter().find_map(|key| self.written.0.places.0.get(*key)).cloned()
    }
}
