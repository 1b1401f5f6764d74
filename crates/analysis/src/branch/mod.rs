//! Branches of periodic motions of pairs and gearboxes: plan, checks, results.

mod figures;
mod plan;
mod point;

pub use figures::BranchFigures;
pub(crate) use figures::ReadOff;
pub(crate) use plan::{BranchWords, checks, stable_ones};
pub use point::{BranchPoint, BranchTurn, LossName, TimePoint};
pub(crate) use point::{ROWS, state};
