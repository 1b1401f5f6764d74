//! Optimisation files: keys of a scene that may change, the goal, and the torques and tolerances over which it is
//! evaluated.
//!
//! | module | what it does |
//! |---|---|
//! | `file` | a checked optimisation, and the scenes of its designs |
//! | `numbers` | one of any numbers, of a pair or a gearbox, by differences |
//! | `read` | from a file, or from words of a command line, to that |
//! | `schema`, `check` | its words, and what they mean: every complaint is made here |

mod check;
mod file;
mod numbers;
mod read;
mod schema;
mod words;

pub use file::{DesignParameter, Optimisation, TorqueWeight};
pub use numbers::{NumberLimit, NumberLoad, NumberOptimisation};
pub(crate) use schema::{OPTIMISATION, OPTIMISE};
pub use words::OptimisationWords;
