//! Cheaper models of the same pair, in time: `lumped8`, `lumped12`, `shaft18`, `impact`.
//!
//! | module | what it does |
//! |---|---|
//! | `analysis` | [`LumpedAnalysis`]: a motion with its headline, spectra and certificate |
//! | `sweep` | [`KeySweep`]: a motion at each value of a key: bifurcation diagrams, resonance curves |
//! | `row` | [`LumpedRow`]: what a model tells of an instant |
//! | `mechanism` | what a model must answer to be run and read |
//! | `inputs` | all that a model is made of |
//! | `excitation` | stiffness over the mesh cycle: given, of the reduced model, of ISO |
//! | `bodies` | bodies, supports and torques of the scene |
//! | `lumped_pair`, `shafts`, `impact`, `mapped` | the models |
//! | `run_loop`, `periodicity` | a run of any of them |
//! | `campbell` | natural frequencies over speed |
//! | `headline`, `warnings` | what is read off the rows |

mod analysis;
mod bodies;
mod campbell;
mod excitation;
mod headline;
mod impact;
mod inputs;
mod lumped_pair;
mod mapped;
mod mechanism;
mod periodicity;
mod row;
mod run_loop;
mod shafts;
mod sweep;
mod warnings;

pub use analysis::{LumpedAnalysis, LumpedResult, LumpedSink, NoLumpedSink, is_lumped};
pub use campbell::LumpedCampbell;
pub use headline::{LumpedCertificate, LumpedHeadline};
pub use mechanism::StaticPoint;
pub use row::{CoordinateAxis, GearCoordinate, LumpedRow, gear_coordinates};
pub use sweep::{BifurcationAnalysis, KeySweep, LumpedQuantity, SectionEvery, SweepHeadline, SweepOptions, SweepPoint};

pub(crate) use analysis::steady_rows;
pub(crate) use excitation::{ExcitationSource, static_scene};
pub(crate) use inputs::LumpedInputs;
