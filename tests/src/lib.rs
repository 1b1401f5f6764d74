//! Random documents, measured pairs, and programs that are run: what tests of the program share.
#![allow(missing_docs, reason = "for tests and benches alone")]

pub mod held_out;
pub mod judged;
pub mod killed;
#[allow(clippy::print_stdout, reason = "the figures of a fit are what commands call it for")]
pub mod law_fit;
pub mod measured_gearbox;
pub mod measured_motion;
pub mod measured_pair;
pub mod pair_bounds;
pub mod pair_law_fit;
pub mod pairs_done;
pub mod program;
pub mod random_gearbox;
pub mod random_motion;
pub mod random_scene;
pub mod random_scenes;
pub mod readers;
pub mod recorded;
pub mod rung_of;
