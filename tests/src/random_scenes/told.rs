//! A scene told in another way, and which scenes can be.

use std::path::Path;

use super::{Draft, RandomScene};

/// What is wrong in two folders of results that ought to agree.
type Compare = Box<dyn Fn(&Path, &Path) -> Vec<String>>;

/// A scene told again.
pub struct Told {
    /// What is solved in place of the scene itself, where that is no half of the comparison.
    pub first: Option<Draft>,
    /// The same problem in another way.
    pub other: Draft,
    /// What differs between both results, in words.
    pub compare: Compare,
}

/// Whether a scene is of numbers alone, as drawn: files, and keys of the whole schema, are not told again.
pub fn is_plain(scene: &RandomScene) -> bool {
    let d = &scene.draft;
    let plain = !scene.anything && !scene.foreign && d.files.is_empty();
    plain && ["accuracy", "rating", "output.derivatives"].iter().all(|key| d.get(key).is_none())
}

/// Whether a scene stands still.
pub fn is_at_rest(scene: &RandomScene) -> bool {
    let kind = scene.draft.get("analysis.kind").and_then(|kind| kind.as_str());
    matches!(scene.model, "reduced" | "full" | "iso") && kind != Some("dynamic")
}
