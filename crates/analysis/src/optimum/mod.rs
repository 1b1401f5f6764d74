//! Optimisation of micro-geometry for low noise: evaluation of designs with their derivatives.
//!
//! | module | what it does |
//! |---|---|
//! | `evaluate` | all torques and samples of a design |
//! | `run` | the search, whole values of a machine, the trade-off against pressure |
//! | `summary` | what is reported of an optimum: before and after, over torques, what each parameter does |

mod evaluate;
mod run;
mod summary;

pub use design::Evaluated;
pub use run::{FrontPoint, Optimum, optimise};
pub use summary::{HarrisPoint, Influence, Optimised, TorqueLine, summarise};
