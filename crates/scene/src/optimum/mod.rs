//! The file of an optimisation: which keys of a scene may change, what shall be small, over which torques and
//! tolerances.
//!
//! | module | what it does |
//! |---|---|
//! | `file` | a checked optimisation, and the scenes of its designs |
//! | `read` | from a file, or from words of a command line, to that |
//! | `raw`, `check` | its words, and what they mean: every complaint is made here |

mod check;
mod file;
mod raw;
mod read;

pub use file::{DesignParameter, Optimisation, TorqueWeight};
pub use read::OptimisationWords;
