//! What of `analysis` and `report` the command names.

mod error;

pub use ::report::page::report_again;
pub(crate) use ::store::CASES;
pub use ::store::folder::ResultDirectory;
pub(crate) use analysis::results::{root_stress_headline, root_stress_remarks};
