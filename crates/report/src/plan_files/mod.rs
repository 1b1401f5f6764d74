//! Files of a plan: a row a case.
//!
//! | module | what it does |
//! |---|---|
//! | `values` | the numbers that a plan wants of a case |
//! | `rows` | a case as a row; the rows that are done |
//! | `page` | the report: spread, scatter, correlation, cases to sort |
//! | `part` | some cases in a file of their own, and all of them together again |
//! | `solve` | all cases, side by side |
//! | `write` | the files and the closing table |

mod page;
mod part;
mod rows;
mod solve;
mod values;
mod write;

pub use part::{Part, PartError, merged};
pub use rows::{CaseRow, CaseTable, DoneCases};
pub use solve::{InTime, solve_cases};
pub use values::{case_values, static_case_values};
pub use write::{plan_digest, write_cases};
