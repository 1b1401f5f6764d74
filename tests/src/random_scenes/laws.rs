//! Laws that no model may break: a scene told in another way is the same problem, and has the same answer.
//!
//! | law | how the scene is told again |
//! |---|---|
//! | mirror | seen in a mirror: the other hand, or the other hand and sense |
//! | size | every number with a unit as of a pair of another size |
//! | exchange | the gears called by each other's name |
//! | driver | the other gear drives the other way round: the same flanks press |
//! | lead | a misalignment of a spur pair ground as a lead slope |

use super::{RandomScene, driver, exchange, lead, mirror, size, told::Told};

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
