//! Files and the closing table: what a user gets. What needs no type of this crate's results stands in [`::report`], and is named here
//! for the modules that write it.

mod columnar;
mod directory;
mod error;
mod headline;
mod lumped_report;
mod lumped_sweep;
mod lumped_table;
mod motion_charts;
mod motion_precision;
mod motion_report;
mod motion_table;
mod page;
mod report;
mod study_charts;
mod study_report;
mod study_tables;
mod summary;
mod table;

pub use analysis::results::{GearRootStress, Place, PressurePlace, RootStressHeadline};
pub(crate) use columnar::write_columnar;
pub(crate) use directory::CASES;
pub use directory::ResultDirectory;
pub use headline::{Headline, headline};
pub(crate) use lumped_report::{LumpedPictures, write_lumped_report};
pub(crate) use lumped_sweep::{bifurcation_picture, lumped_sweep_table, write_lumped_sweep_report};
pub(crate) use lumped_table::lumped_table;
pub(crate) use motion_charts::{MotionPictures, SweepPictures};
pub(crate) use motion_precision::{motion_precision_csv, motion_precision_svg, motion_precision_table};
pub(crate) use motion_report::{write_motion_report, write_sweep_report};
pub(crate) use motion_table::{motion_table, sweep_table};
pub use report::write_report;
pub(crate) use study_report::{StudyResult, write_study_report, write_study_summary};
pub(crate) use study_tables::{study_csv, study_table};
pub use summary::write_summary;
pub use table::closing_table;

pub use ::report::{
    charts::{contact_pattern_svg, svg_to_png},
    columns::write_history,
    contact_files::{write_contact, write_contact_lines, write_contact_pattern},
    page::{Rendered, report_again},
};
pub(crate) use ::report::{
    columns::history_columns,
    contact_files::write_patterns,
    csv::{push_row, quoted},
};
pub(crate) use analysis::results::{root_stress_headline, root_stress_warnings};
