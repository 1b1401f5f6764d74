//! What are the answers to a scene?
//!
//! A checked [`scene::Scene`], and meshes in memory if the caller has them, go in; typed results come out, row by row
//! through a sink. Who waits hears of the phases through an [`Observer`]; reduced gears are kept in a [`GearCache`].
//! Nothing here reads a command line, writes a file or prints.
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
//! [`solve`] answers every document, a scene of any kind or a gearbox, with what its [`Context`] says. Whoever knows the
//! kind asks for more of it: [`StaticAnalysis`] solves the pair at rest, [`motion::MotionAnalysis`] moves it with all of its teeth, [`lumped::LumpedAnalysis`] by a model with few coordinates,
//! [`lumped::KeySweep`] such a model at many values of a key. [`accuracy_chart::AccuracyChart`] compares them all.

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
