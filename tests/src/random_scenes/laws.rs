//! Laws that no model may break: a scene told in another way is the same problem, and has the same answer.
//!
//! | law | how the scene is told again |
//! |---|---|
//! | mirror | seen in a mirror: the other hand, or the other hand and sense |
//! | size | every number with a unit as of a pair of another size |
//! | exchange | the gears called by each other's name |
//! | driver | the other gear drives the other way round: the same flanks press |
//! | lead | a misalignment in the plane of action ground as a lead slope |

use std::path::Path;

use super::{Draft, RandomScene, driver, exchange, lead, mirror, size};

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

/// A law; `None` where it says nothing of a scene.
pub struct Law {
    /// In the table of all scenes.
    pub name: &'static str,
    /// The scene of a number told again.
    pub tell: fn(u64, &RandomScene) -> Option<Told>,
}

/// All laws.
static LAWS: [Law; 5] = [
    Law { name: "mirror", tell: mirror::tell },
    Law { name: "size", tell: size::tell },
    Law { name: "exchange", tell: exchange::tell },
    Law { name: "driver", tell: driver::tell },
    Law { name: "lead", tell: lead::tell },
];

/// The law that a scene is held against: each scene is solved twice at the most.
pub fn law_of(index: u64, scene: &RandomScene) -> Option<(&'static str, Told)> {
    let first = index as usize % LAWS.len();
    let mut in_turn = (0..LAWS.len()).map(|i| &LAWS[(first + i) % LAWS.len()]);
    in_turn.find_map(|law| Some((law.name, (law.tell)(index, scene)?)))
}

/// Names of all laws.
pub fn names() -> impl Iterator<Item = &'static str> {
    LAWS.iter().map(|law| law.name)
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
