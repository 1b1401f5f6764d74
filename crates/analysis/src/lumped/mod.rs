//! Models with few coordinates in time: `lumped8`, `lumped12`, `shaft18`, `impact`, `mapped`; and `reduced` for many
//! motions.
//!
//! | module | what it does |
//! |---|---|
//! | `analysis` | [`LumpedAnalysis`]: a motion with its headline, spectra and certificate |
//! | `sweep` | [`KeySweep`]: a motion at each value of a key: bifurcation diagrams, resonance curves |
//! | `branch` | [`ContinuationAnalysis`]: periodic motions along a key, stable and unstable |
//! | `basins` | [`BasinAnalysis`]: to which motion each state of a plane leads |
//! | `row` | [`LumpedRow`]: what a model tells of an instant |
//! | `mechanism` | what a model must answer to be run and read |
//! | `inputs` | all that a model is made of |
//! | `excitation` | stiffness over the mesh cycle: given, of the reduced model, of ISO |
//! | `bodies` | bodies, supports and torques of the scene |
//! | `lumped_pair`, `shafts`, `impact`, `elastic_pair`, `elastic_frame`, `mapped`, `reduced` | the models |
//! | `free_turn` | the motion that nothing holds |
//! | `exponent` | the largest Lyapunov exponent of a motion |
//! | `integration`, `run_loop` | a run of any of them |
//! | `campbell` | natural frequencies over speed |
//! | `survey`, `headline`, `remarks` | what is read off the rows |

mod analysis;
mod basins;
mod bodies;
mod branch;
mod campbell;
mod elastic_frame;
mod elastic_pair;
mod excitation;
mod exponent;
mod flank_pair;
mod free_turn;
mod headline;
mod impact;
mod inputs;
mod integration;
mod lumped_pair;
mod mechanism;
mod remarks;
mod row;
mod run_loop;
mod shafts;
mod survey;
mod sweep;

pub use analysis::{LumpedAnalysis, LumpedResult, LumpedSink, NoLumpedSink, is_lumped};
pub use basins::{Attractor, BasinAnalysis, BasinHeadline, BasinResult, BasinStart};
pub use branch::{ContinuationAnalysis, ContinuationHeadline, ContinuationResult};
pub use campbell::LumpedCampbell;
pub(crate) use campbell::{FrequencyFacts, Meeting};
pub use headline::{LumpedCertificate, LumpedHeadline};
pub use mechanism::{LumpedMemory, StaticPoint};
pub use row::{CoordinateAxis, GearCoordinate, LumpedRow, gear_coordinates};
pub use run_loop::{LumpedCheckpoint, LumpedResume, LumpedSoFar};
pub use sweep::{BifurcationAnalysis, KeySweep, LumpedQuantity, SweepHeadline, SweepOptions, SweepPoint};

pub(crate) use analysis::steady_rows;
pub(crate) use excitation::{ExcitationSource, static_scene};
pub(crate) use inputs::LumpedInputs;
