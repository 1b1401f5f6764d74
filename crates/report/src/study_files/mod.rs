//! Files of a study: the same figures of several scenes, side by side.

mod cases;
mod charts;
mod outcome;
mod report;
mod tables;

pub use cases::study_warnings;
pub use outcome::{CaseMiss, CaseResult, CaseRun, StudyResult, with_result};
pub use report::{study_answer, study_page};
