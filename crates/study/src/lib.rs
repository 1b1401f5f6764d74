//! How good, how fast, how stable?
//!
//! Statistics of histories that are sampled evenly over whole mesh cycles, so that neither a window
//! function nor leakage stands between a mesh harmonic and its amplitude.

mod cycle;
mod error;
mod harmonics;

pub use cycle::{CycleStatistics, cycle_statistics};
pub use error::StudyError;
pub use harmonics::{Harmonic, mesh_harmonics};
