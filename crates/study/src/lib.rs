//! How good, how fast, how stable?
//!
//! Statistics of histories that are sampled evenly over whole mesh cycles, so that neither a window
//! function nor leakage stands between a mesh harmonic and its amplitude; what contact leaves on a flank over such cycles;
//! accuracy against cost of the ways to compute one, CalculiX among them ([`calculix`]).

pub mod calculix;
mod cycle;
mod error;
mod flank_pattern;
mod harmonics;
mod power_law;
mod work_precision;

pub use cycle::{CycleStatistics, cycle_statistics};
pub use error::StudyError;
pub use flank_pattern::{FlankPattern, Touch};
pub use harmonics::{Harmonic, mesh_harmonics};
pub use power_law::{PowerLaw, power_law};
pub use work_precision::{Answer, AnswerError, Work};
