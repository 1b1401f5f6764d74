//! Which periodic motions does a driven mechanism have? Harmonic balance, continuation and stability; no gear in it.
//!
//! ```text
//! M q'' = f(t, q, q'),   f(t + T) = f(t):   q(t + T) = q(t)
//! ```
//! Waiting shows the motions that are stable, and of these the ones that the start leads to. Here periodic motions are
//! solutions of equations: all of a branch, stable or not, around its folds.

mod balance;
mod condensed;
mod continuation;
mod dense;
mod equations;
mod error;
mod family;
mod free_direction;
mod linear_machine;
mod modal_flow;
mod plan;
mod product;
mod series;
mod shooting;
mod solution;
mod stability;
mod turns;

pub use condensed::{Condensed, CondensedFamily, PeriodicMotionOf};
pub use continuation::{Branch, BranchOptions, Tracer};
pub use equations::PeriodicEquations;
pub use error::PeriodicError;
pub use family::PeriodicFamily;
pub use free_direction::FreeDirection;
pub use linear_machine::LinearMachine;
pub use plan::BranchPlan;
pub use series::FourierSeries;
pub use shooting::{Shooting, Shot};
pub use solution::{BalanceOptions, PeriodicMotion};
pub use stability::{Floquet, Loss, TangentFlow};
pub use turns::Bifurcation;
