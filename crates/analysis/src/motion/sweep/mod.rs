//! Sweeps over speed.

mod analysis;
mod headline;
mod rows;
mod run;

pub use analysis::{SweepAnalysis, SweepResult};
pub use headline::{FailedSpeed, SweepHeadline};
pub use rows::{SWEEP_ORDERS, SweepRow, SweepStatus};
pub(crate) use run::direction;
