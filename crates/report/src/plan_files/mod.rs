//! Files of a plan: a row a case.
//!
//! | module | what it does |
//! |---|---|
//! | `values` | the numbers that a plan wants of a case |
//! | `outputs` | whether those can be there, before any case is solved |
//! | `rows` | a case as a row; the rows that are done |
//! | `known` | the rows of a plan as columns of numbers |
//! | `page` | the report: spread, curves, maps, correlation, cases to sort |
//! | `curves`, `maps` | an output over one axis, and over two |
//! | `spread` | quantiles and what else is told of a number |
//! | `part` | some cases in a file of their own, and all of them together again |
//! | `solve` | all cases, side by side |
//! | `write` | the files and the closing table |

mod curves;
mod known;
mod maps;
mod outputs;
mod page;
mod part;
mod rows;
mod solve;
mod spread;
mod values;
mod write;

pub use known::{Column, KnownCases};
pub use outputs::{OutputError, check_outputs};
pub use page::{PageWords, report_folder};
pub use part::{Part, PartError, merged};
pub use rows::{CaseLines, CaseRow, DoneCases};
pub use solve::{CaseObserver, solve_cases};
pub use values::case_values;
pub use write::{plan_digest, write_cases};
