//! How exact is a motion, and which is the cheapest model that is exact enough?
//!
//! A pair at rest tells how the meshes do ([`PairAtRest`]); a run of a model is held against one with half the steps; how
//! far the cheaper models are from `reduced+modes` with fine steps was learnt from random pairs
//! ([`MotionCalibration`]). [`AccurateMotion`] climbs the models until the bounds keep what a scene asks for. Theory,
//! section 15.
//!
//! | file | question |
//! |---|---|
//! | `analysis` | which bounds does a motion get? |
//! | `ladder` | which model is exact enough? |
//! | `model`, `model_scene` | which models are there, and what do they want of a scene? |
//! | `at_rest` | what does the pair at rest say of its motion? |
//! | `run` | what does a model answer? |
//! | `response` | what do errors of the pair at rest become in motion? |
//! | `calibration` | how far are models and steps off? |
//! | `estimate` | what are the bounds of a run? |

mod analysis;
mod at_rest;
mod calibration;
mod estimate;
mod ladder;
mod model;
mod model_scene;
mod response;
mod run;

pub use super::exactness::TriedModel;
pub use analysis::{AccurateMotion, AccurateMotionResult};
pub use at_rest::PairAtRest;
pub use calibration::{MotionCalibration, MotionLaws, SpeedLaw, UsualBound};
pub use model::MotionModel;
pub use response::mesh_bound;
pub use run::{MotionAnswer, MotionSample, MotionTold};
