//! Files of a study: the same figures of several scenes, side by side.

mod cases;
mod charts;
mod outcome;
mod report;
mod tables;

pub use cases::study_remarks;
pub use outcome::{CaseMiss, CaseResult, CaseRun, StudyResult, with_result};
pub(crate) use report::OBJECTS;
pub use report::{study_answer, study_page};
pub(crate) use tables::study as documented;
