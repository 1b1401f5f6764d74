//! Study files: the scenes, and the figures to be drawn.
//!
//! | module | what it does |
//! |---|---|
//! | `file` | a checked study |
//! | `read` | from a file to that |
//! | `schema`, `check` | its words, and what they mean: every complaint is made here |
//! | `columns` | which columns a scene's rows will have, told before anything is run |

mod check;
mod columns;
mod file;
mod read;
mod schema;

pub(crate) use check::setting;
pub use columns::{ColumnsOf, column_advice};
pub use file::{Follow, FullRun, OverTime, RefusedCase, Study, StudyCase, StudyQuantity, Take};
pub(crate) use schema::STUDY;
