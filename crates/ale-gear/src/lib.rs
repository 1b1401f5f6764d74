//! The command: arguments, progress, messages, exit status. What is computed stands in `analysis`, what is written in
//! `report`, what was asked in `scene`.
//!
//! | module | what it does |
//! |---|---|
//! | [`command`] | the subcommands |
//! | [`run`], `motion`, `lumped`, `gearbox` | a scene at rest, in time, of a cheaper model, and a gearbox, into a result folder |
//! | `progression` | motions that run in parts, from checkpoint to checkpoint |
//! | `study_cases`, `kept_cases` | runs the scenes of a study; those that are done before the study is |
//! | `chart` | what a chart takes from this process |
//! | [`output`] | what of `analysis` and `report` the command names |
//! | `stop` | what happens on Ctrl-C |
//! | [`printed`] | what of a text may go to a terminal |
//! | [`talk`] | how much is said on stderr |
//! | [`phases`], `pace` | time and peak memory of each phase, progress bars, remaining time |
//! | [`certificate`] | a result whose files stand, and whether it holds |
//! | [`error`] | one message, one hint, one exit status |

pub mod certificate;
mod chart;
pub mod command;
pub mod error;
pub mod facts;
mod gearbox;
pub mod memory;
mod motion;
pub mod output;
mod pace;
pub mod phases;
pub mod printed;
mod progression;
pub mod run;
pub use ::scene;
pub mod stop;
pub mod talk;

mod lumped;
mod study_cases;

pub(crate) use analysis::gears;
pub use analysis::{iso_root, meshes, resolution};
