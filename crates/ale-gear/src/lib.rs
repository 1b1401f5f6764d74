//! The command line, the scene file, the output files and the report.
//!
//! | module | what it does |
//! |---|---|
//! | [`scene`] | reads and checks what the user wrote |
//! | [`resolution`] | how many slices a scene's contact is cut into |
//! | [`run`] | turns a checked scene into a call of the solvers |
//! | `motion` | analyses in time: preparation, course, checkpoints, sweeps |
//! | `lumped` | runs of cheaper models, and their files |
//! | [`talk`] | how much is said on stderr |
//! | [`phases`] | time and peak memory of each phase, progress bars |
//! | [`output`] | `summary.json`, pages and the closing table, of this crate's types of results; the rest is in the crate `report` |
//! | [`cache`] | reduced gears on disk |
//! | [`certificate`] | what must hold of a result before its numbers count |
//! | [`reduce`] | reduction of a scene's gears by itself |
//! | `study_cases` | runs the scenes of a study, each into a folder of its own |
//! | `chart` | what a chart takes from this process |
//! | [`command`] | the subcommands |

pub mod cache;
pub mod certificate;
mod chart;
pub mod command;
pub mod error;
pub mod facts;
pub mod memory;
mod motion;
pub mod output;
pub mod phases;
pub mod run;
pub use ::scene;
pub mod talk;

mod lumped;
mod study_cases;

pub(crate) use analysis::gears;
pub use analysis::{iso_root, meshes, resolution};
