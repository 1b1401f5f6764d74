//! How good, how fast, how stable?
//!
//! Statistics of histories that are sampled evenly over whole mesh cycles, so that neither a window
//! function nor leakage stands between a mesh harmonic and its amplitude; and what contact leaves on a flank over such cycles.

mod cycle;
mod error;
mod flank_pattern;
mod harmonics;

pub use cycle::{CycleStatistics, cycle_statistics};
pub use error::StudyError;
pub use flank_pattern::{FlankPattern, Touch};
pub use harmonics::{Harmonic, mesh_harmonics};
