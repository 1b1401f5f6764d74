//! Which cases of a plan are solved, and what is kept of each?
//!
//! | module | what it does |
//! |---|---|
//! | `solve` | all cases, side by side |
//! | `optimum` | the design whose numbers are smallest within limits |
//! | `values` | the numbers that a plan wants of a case |
//! | `outputs` | whether those can be there, before any case is solved |
//! | `rows` | a case as a row; the rows that are done |
//! | `known` | the rows of a plan as columns of numbers |
//! | `part` | some cases in a file of their own, and all of them together again |
//! | `digest` | what says that two plans have the same cases |
//! | `layout` | columns that a scene's `history.csv` will have |

mod digest;
mod known;
mod layout;
mod optimum;
mod outputs;
mod part;
mod rows;
mod solve;
mod values;

pub use digest::{numbers_digest, plan_digest, study_digest};
pub use known::{Column, KnownCases};
pub use layout::{columns_of, columns_of_scene};
pub use optimum::{NumberOptimum, OptimumError, goal_of, goal_unit, optimise_numbers};
pub use outputs::{OutputError, check_numbers, check_outputs, rows_file};
pub use part::{Part, PartError, merged};
pub use rows::{CaseLines, CaseRow, DoneCases};
pub use solve::{CaseObserver, solve_cases};
pub use values::{case_values, gearbox_values};
