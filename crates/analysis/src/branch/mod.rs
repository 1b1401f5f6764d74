//! Branches of periodic motions, of pairs and of gearboxes: what is asked, what must hold, what is read off.

mod outcome;
mod plan;
mod point;

pub(crate) use outcome::Outcome;
pub(crate) use plan::{BranchWords, broken, checks, stable_ones};
pub use point::{BranchPoint, BranchTurn, LossName, TimePoint};
pub(crate) use point::{ROWS, state};
