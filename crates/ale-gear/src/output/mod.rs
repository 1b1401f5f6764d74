//! Files and the closing table: what a user gets. What needs no type of this crate's results stands in [`::report`], and is named here
//! for the modules that write it.

mod chart_csv;
mod chart_tables;
mod columnar;
mod error;
mod ladder_report;
mod ladder_sweep;
mod ladder_table;
mod study_charts;
mod study_report;
mod study_tables;
mod work_precision_chart;

pub use ::report::folder::{CASES, ResultDirectory};
pub use analysis::results::{
    GearRootStress, Place, PressurePlace, RootStressHeadline, StaticHeadline, static_headline,
};
pub use chart_csv::write_chart_csv;
pub use chart_tables::chart_tables;
pub(crate) use columnar::{close, write_columnar};
pub(crate) use ladder_report::{LadderPictures, write_ladder_report};
pub(crate) use ladder_sweep::{bifurcation_picture, ladder_sweep_table, write_ladder_sweep_report};
pub(crate) use ladder_table::ladder_table;
pub(crate) use study_report::{StudyResult, write_study_report, write_study_summary};
pub(crate) use study_tables::{study_csv, study_table};
pub use work_precision_chart::work_precision_svg;

pub use ::report::{
    charts::{contact_pattern_svg, svg_to_png},
    columns::write_history,
    contact_files::{write_contact, write_contact_lines, write_contact_pattern},
    page::{Rendered, report_again, write_report},
    tables::closing_table,
    write_summary,
};
pub(crate) use ::report::{
    columns::history_columns,
    csv::{push_row, quoted},
    motion_files::{
        MotionPictures, SHOWN_CYCLES, motion_charts, motion_precision_csv, motion_precision_svg, motion_precision_table,
    },
    page::render_run,
    tables::{Lines, fixed},
};
pub(crate) use analysis::results::{root_stress_headline, root_stress_warnings};
