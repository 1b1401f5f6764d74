//! Studies: the same figures of several scenes, side by side.
//!
//! | module | what it does |
//! |---|---|
//! | `file` | the study file |
//! | `raw`, `check` | its words, and what they mean: every complaint is made here |
//! | `columns` | which columns a scene's rows will have, told before anything is run |
//! | `cases` | runs the scenes, in parallel, each into a folder of its own |
//! | `findings` | what is read off the rows: quantities, correlations |

mod cases;
mod check;
mod columns;
mod file;
mod findings;
mod raw;

pub(crate) use cases::{CaseOutcome, CaseRun, run_cases};
pub use file::{Case, Follow, FullRun, OverTime, Quantity, Study, Take};
pub(crate) use findings::{Findings, findings, last_cycles};
