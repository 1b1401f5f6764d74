//! What are the answers to a scene?
//!
//! A checked [`scene::Scene`], and meshes in memory if the caller has them, go in; typed results come out, row by row
//! through a
//! sink. Who waits hears of the phases through an [`Observer`]; reduced gears are kept in a [`GearCache`]. Nothing here
//! reads a
//! command line, writes a file or prints.
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
//! [`StaticAnalysis`] solves the pair at rest, [`motion::MotionAnalysis`] in time, [`lumped::LumpedAnalysis`] by a
//! model with few coordinates, [`lumped::KeySweep`] such a model at many values of a key;
//! [`accuracy_chart::AccuracyChart`] compares them all.

pub mod accuracy;
pub mod accuracy_chart;
mod cache;
pub mod certificate;
mod coarse;
mod derivatives;
pub mod elastic_gears;
mod error;
pub mod facts;
mod failure;
mod flank_checks;
mod flank_reach;
mod foreseen;
pub mod gearbox_at_rest;
pub mod gears;
mod inputs;
pub mod iso_model;
pub mod iso_root;
mod light_load;
pub mod lumped;
pub mod meshes;
pub mod motion;
pub mod nominal_pressure;
mod observer;
pub mod optimum;
mod options;
pub mod parameter_study;
pub mod reduction_alone;
pub mod resolution;
pub mod results;
mod shared_models;
mod side_by_side;
mod static_certificate;
mod statics;
mod warnings;
mod waves;

pub use cache::{GearCache, MapKey, NoCache};
pub use derivatives::{DerivativeRecorder, Derivatives};
pub use error::{AnalysisError, MeshMismatch, SolverFailure, solver_error};
pub use foreseen::foreseen_s;
pub use observer::{NoObserver, Observer, PhaseWork, Progress, run_phase, unless_cancelled};
pub use options::options;
pub use shared_models::{SharedModels, SolvedWithRates, VariedScene};
pub use side_by_side::side_by_side;
pub use static_certificate::{static_certificate, worse};
pub use statics::{
    NoSink, SinkResult, StaticAnalysis, StaticResult, StaticSink, dof_after, free_dofs, reduced, time_again,
    wider_window,
};
pub use warnings::{body_warnings, locking_warning};
