//! What the writers need to know of a run at rest beside its answer.

use analysis::SolvedAtRest;
use export::view::View;

pub use ::report::{Cost, Phase};
pub use analysis::facts::*;

/// A solved scene at rest with what its files are made of.
#[derive(Debug)]
pub struct ForFiles {
    /// The answer.
    pub solved: SolvedAtRest,
    /// Cost of the run.
    pub facts: RunInfo,
    /// The gears in space; `None` for a model without meshes, and where nobody asked.
    pub view: Option<View>,
}
