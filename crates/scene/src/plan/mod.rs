//! Plans: the varied keys of a pair or a gearbox, the sampling, and the values wanted of each case.
//!
//! | module | what it does |
//! |---|---|
//! | `file` | a checked plan |
//! | `read` | from a file, or from words of a command line, to that |
//! | `start`, `started` | how the next value starts, and plans whose values do not each start alone |
//! | `schema`, `check` | its words, and what they mean: every complaint is made here |
//! | `tolerance` | what a tolerance class of ISO 1328-1 allows |
//! | `word` | one varied key in one word: `key=0:40:9`, `key~normal:0:5` |

mod check;
mod file;
mod read;
mod schema;
mod start;
mod started;
mod tolerance;
mod word;

pub(crate) use check::{DESIGNS, axes, setting, unfit};
pub use file::{Plan, PlanAxis, PlanOutput, PlanTake};
pub use read::PlanWords;
pub(crate) use schema::{PLAN, SEED, VARY};
pub use start::{SectionEvery, Start};
pub use started::StartedPlan;
pub use tolerance::PitchTolerance;
pub(crate) use tolerance::classed;
pub use word::{AxisValues, AxisWord};
