//! Error bounds of a motion, and the cheapest model that is accurate enough.
//!
//! The static pair shows the errors of the meshes ([`PairAtRest`]). A run of a model is compared with one with half the
//! steps. The difference of the cheaper models from `reduced+modes` with fine steps was calibrated on random pairs
//! ([`MotionCalibration`]). [`AccurateMotion`] climbs the models until the bounds meet the accuracy that a scene
//! requests. Theory, section 15.
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
