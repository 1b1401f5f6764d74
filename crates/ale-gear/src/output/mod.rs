//! Files and the closing table: what a user gets. What needs no type of this crate's results stands in [`::report`],
//! and is named here for the modules that write it.

mod error;

pub use ::report::folder::ResultDirectory;
pub use analysis::results::{
    GearRootStress, Place, PressurePlace, RootStressHeadline, StaticHeadline, static_headline,
};

pub(crate) use ::report::study_files::CASES;
pub use ::report::{
    charts::{contact_pattern_svg, svg_to_png},
    columns::write_history,
    contact_files::{write_contact, write_contact_lines, write_contact_pattern},
    page::{Rendered, report_again, write_report},
    tables::closing_table,
};
pub(crate) use analysis::results::{root_stress_headline, root_stress_warnings};
