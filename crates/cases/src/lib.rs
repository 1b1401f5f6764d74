//! Which cases does a plan have, and what is varied in each of them? No scene in it.
//!
//! An axis either goes through all of its values, or it is drawn from a distribution. Every sample of what is drawn is
//! taken with every combination of what is gone through: a case is a number, and its values follow from that number and
//! the plan alone, so that any part of the cases can be run anywhere and in any order.

mod axis;
mod cases;
mod circle;
mod distribution;
mod error;
mod sampling;

pub use axis::Axis;
pub use cases::Cases;
pub use circle::{around_a_circle, spread};
pub use distribution::Distribution;
pub use error::CasesError;
pub use sampling::{Design, Sampling};
