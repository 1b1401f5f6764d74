//! What of `analysis` and `report` the command names.

mod error;

pub use ::report::folder::ResultDirectory;
pub use ::report::page::report_again;
pub(crate) use ::report::study_files::CASES;
pub(crate) use analysis::results::{root_stress_headline, root_stress_warnings};
