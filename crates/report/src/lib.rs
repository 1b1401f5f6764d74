//! Results to tables, charts, pages and files for other programs.
//!
//! | module | what it does |
//! |---|---|
//! | [`csv`] | numbers and texts as fields of a file with commas |
//! | [`charts`] | curves, maps and diagrams as SVG with the points for a page's script |
//! | [`page`] | pages that need nothing beside themselves |
//! | [`view`] | both gears in space, for the page |
//! | [`contact_files`] | contact lines and contact pattern |
//! | [`accuracy_chart`] | table and picture of accuracy against cost |
//! | [`pair_files`] | the answer of every run of a pair |
//! | [`motion_files`] | spectra, passages over speed, Campbell diagrams |
//! | [`envelope_files`] | failure modes with their figures, maps of where methods fail |
//! | [`gearbox_files`] | a gearbox at rest: meshes, bearings, shaft lines |
//! | [`study_files`] | the same figures of several scenes, side by side |
//! | [`optimum_files`] | an optimisation: the scene of the optimum, tables, report |
//! | [`plan_files`] | many cases of one scene, a row a case |
//! | [`paraview`] | `.vtu` and `.pvd` |
//! | [`compare`] | result folders side by side |
//! | [`tables`] | the table at the end of a run |
//! | [`solve_in_time`], [`write_in_time`] | a scene in time, from its answer to the files of its result |
//! | [`Cost`], [`write_result`] | what a run cost; an answer into a result folder |

pub mod accuracy_chart;
mod answer_files;
pub mod charts;
pub mod compare;
pub mod contact_files;
pub mod envelope_files;
mod error;
pub mod gearbox_files;
mod in_time;
mod marked_place;
pub mod motion_files;
pub mod optimum_files;
pub mod page;
pub mod pair_files;
pub mod paraview;
pub mod plan_files;
mod static_sink;
pub mod study_files;
pub mod tables;
pub mod universal;
pub mod view;

pub use answer::{Cost, Phase, csv};
pub use answer_files::{Written, write_result, write_rows, write_summary, write_tables_and_page};
pub use error::ReportError;
pub use in_time::{Recorder, WrittenInTime, solve_in_time};
pub use marked_place::MarkedPlace;
pub use pair_files::{static_charts, write_in_time, write_key_sweep_result, write_static_result, write_static_rows};
pub use static_sink::StaticFileSink;

/// Schema of `summary.json`: grows with every change after which an older reader would misread it.
pub const SUMMARY_SCHEMA: u32 = 4;
