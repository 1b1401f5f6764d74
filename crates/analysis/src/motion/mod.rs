//! The pair in motion: from a checked scene to rows, spectra and certificate.
//!
//! | module | what it does |
//! |---|---|
//! | `analysis` | [`MotionAnalysis`]: one motion of a scene |
//! | `setup` | the scene in the solvers' units, gears, quasi-static cycle, mechanism |
//! | `course` | settle, then rows; checkpoints on the way |
//! | `row`, `sink` | what a row is, and who gets it |
//! | `orders` | spectra, waterfall, what is largest over speed, Campbell diagram |
//! | `pattern` | what the flanks are pressed by |
//! | `headline` | the few numbers that a motion is made for |
//! | `certificate`, `dropped` | what must hold of one; forces that tooth changes drop |
//! | `motion_remarks`, `step_estimate` | what a user should hear; how many steps the fastest motion and a longer analysis take |
//! | `sweep` | [`SweepAnalysis`]: steady states over speed |
//! | `precision` | step sizes against errors of every method |

mod analysis;
mod certificate;
mod course;
mod dropped;
mod headline;
mod motion_remarks;
mod orders;
mod pattern;
mod precision;
mod row;
mod setup;
mod sink;
mod step_estimate;
mod sweep;

pub use crate::unstable_steps::Steps;
pub use analysis::{MotionAnalysis, MotionOutcome, MotionResult, RampResult};
pub use headline::{MotionCertificate, MotionHeadline};
pub(crate) use motion_remarks::parting;
pub(crate) use orders::{CAMPBELL_BEYOND, window};
pub use orders::{
    CampbellDiagram, CriticalSpeed, MotionSeries, MotionSpectrum, OrderCut, PeakOverSpeed, RunUp, RunUpCycle,
    RunUpHeadline, Stretches, Waterfall, WaterfallLine, waterfall,
};
pub use precision::{MotionPrecision, MotionPrecisionPoint, motion_precision};
pub use row::{BearingRow, EnergyRow, MotionLayout, MotionRow, RootStressRow};
pub use setup::{
    ElasticHeadline, InertiaHeadline, KeptModes, QuasiStatic, RPM, bearing, drive, motion_options, refuse_unstable,
    scheme, speed, stated_body, steady_by, torque,
};
pub(crate) use setup::{
    Elasticity, MotionInputs, OF_GEARBOX, PreparedMotion, Vibration, body, kept_modes, mesh_range_hz, motion_length,
    pair_drive, prepare,
};
pub use sink::{MotionCheckpoint, MotionSink, NoMotionSink};
pub(crate) use step_estimate::{Pace, StepDemand};
pub(crate) use sweep::direction;
pub use sweep::{FailedSpeed, SWEEP_ORDERS, SweepAnalysis, SweepHeadline, SweepResult, SweepRow, SweepStatus};
