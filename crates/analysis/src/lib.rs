//! Solves a scene or a gearbox and returns typed results.
//!
//! The input is a checked [`scene::Scene`], and meshes in memory if the caller has them. The output are typed results,
//! passed row by row to a sink. An [`Observer`] receives the progress of the phases. Reduced gears are stored in a
//! [`GearCache`]. This crate does not read a command line, write files or print.
//!
//! ```
//! use analysis::StaticAnalysis;
//! use scene::Scene;
//!
//! let scene = Scene::builder()
//!     .pinion(24, 15.0)
//!     .wheel(31)
//!     .normal_module_mm(3.0)
//!     .face_width_mm(20.0)
//!     .torque_nm(100.0)
//!     .set("analysis.model", "iso")
//!     .build()?;
//! let result = StaticAnalysis::new(&scene).solve()?;
//! assert_eq!(result.history.positions.len(), 32);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`solve`] answers every document, a scene of any kind or a gearbox, with the settings of its [`Context`]. For a
//! known kind of scene there are types with more options: [`StaticAnalysis`] solves the pair in static equilibrium,
//! [`motion::MotionAnalysis`] its motion with all teeth, [`lumped::LumpedAnalysis`] its motion with a lumped model,
//! [`lumped::KeySweep`] such a model at many values of a key. [`accuracy_chart::AccuracyChart`] compares all models.

pub mod accuracy;
pub mod accuracy_chart;
mod alike;
pub mod branch;
mod cache;
pub mod certificate;
mod coarse;
mod contact_maps;
mod context;
mod derivatives;
pub mod elastic_gears;
mod error;
mod estimated_time;
pub mod facts;
mod failure;
mod flank_checks;
pub mod flank_orders;
mod flank_reach;
mod gear_dofs;
pub mod gearbox;
pub mod gears;
mod headline_keys;
pub mod in_motion;
pub mod in_time;
mod inputs;
mod interest;
pub mod iso_model;
pub mod iso_root;
mod layers;
mod light_load;
mod loaded_pair;
pub mod lumped;
pub mod meshes;
pub mod motion;
pub mod nominal_pressure;
mod objects;
mod observer;
pub mod optimum;
mod options;
pub mod pair_rating;
mod parallel_map;
pub mod parameter_study;
mod plausible;
mod reduced_pairs;
pub mod reduction_alone;
mod refused;
pub mod remark;
pub mod resolution;
pub mod results;
mod run_up;
mod running;
mod shared_models;
mod shared_solutions;
mod sink;
mod solution_remarks;
mod solved;
mod solved_load;
mod solved_mesh;
mod static_certificate;
mod static_cycle;
mod statics;
mod unstable_steps;
mod varied_scene;
mod waves;
mod window;

pub use accuracy::StaticAnalysis;
pub use alike::SharedGears;
pub use cache::{GearCache, Kept, MAP_VERSION, MapKey, NoCache, SOUND_VERSION, SoundKey};
pub use context::{Context, Ending, Question};
pub use derivatives::{DerivativeRecorder, Derivatives};
pub use error::AnalysisError;
pub(crate) use error::solver_error;
pub use gear_dofs::reduced;
pub use headline_keys::headline_keys;
pub use interest::Interest;
pub use objects::objects;
pub use observer::{NoObserver, Observer, PhaseWork, Progress, Recorder, run_phase, unless_cancelled};
pub use options::options;
pub use parallel_map::parallel_map;
pub use plausible::LoadEstimate;
pub use refused::{Blame, Refusal};
pub use shared_models::SharedModels;
pub use shared_solutions::{RemarksAtRest, RestRequest};
pub use sink::{NoSink, SinkResult, StaticSink};
pub(crate) use solution_remarks::body_remarks;
pub use solution_remarks::locking_remark;
pub use solved::{Solved, SolvedAtRest, solve, solve_at_rest};
pub use static_certificate::{static_certificate, worse};
pub use statics::StaticResult;
pub use varied_scene::VariedScene;
