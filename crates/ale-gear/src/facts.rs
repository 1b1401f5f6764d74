//! What the writers need to know of a run beside its scene and its history.

use analysis::Derivatives;
use ltca::StaticHistory;
use report::view::View;
use scene::Scene;

pub use ::report::{Cost, Phase};
pub use analysis::facts::*;

/// A solved scene.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The scene as it was solved.
    pub scene: Scene,
    /// Position by position.
    pub history: StaticHistory,
    /// What it took.
    pub facts: Facts,
    /// Derivatives by keys, where the scene asks for them.
    pub derivatives: Option<Derivatives>,
    /// The gears in space; `None` for a model without meshes, and where nobody asked.
    pub view: Option<View>,
}
