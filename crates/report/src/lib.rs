//! Results to tables, charts, pages and files for other programs.
//!
//! | module | what it does |
//! |---|---|
//! | [`csv`] | numbers and texts as fields of a file with commas |
//! | [`charts`] | curves, maps and diagrams as SVG with the points for a page's script |
//! | [`page`] | pages that need nothing beside themselves |
//! | [`contact_files`] | contact lines and contact pattern |
//! | [`accuracy_chart`] | table and picture of accuracy against cost |
//! | `branch_files` | branches of periodic motions: of a pair, and of each mesh of a gearbox |
//! | [`pair_files`] | the answer of every run of a pair |
//! | [`measured_files`] | a measured gear: files for a scene, deviations, waves, pictures |
//! | [`motion_files`] | spectra, passages over speed, Campbell diagrams |
//! | [`gearbox_files`] | a gearbox at rest: meshes, bearings, shaft lines |
//! | [`study_files`] | the same figures of several scenes, side by side |
//! | [`optimum_files`] | an optimisation: the scene of the optimum, tables, report |
//! | [`plan_files`] | many cases of one scene, a row a case |
//! | [`compare`] | result folders side by side |
//! | [`tables`] | the table at the end of a run |
//! | [`write_in_time`] | files of a scene in time |
//! | [`documented_tables`], [`documented_objects`] | columns and keys with their meanings, for `docs/outputs.md` |
//! | [`Cost`], [`write_result`] | what a run cost; an answer into a result folder |

pub mod accuracy_chart;
mod answer_files;
mod branch_files;
pub mod charts;
pub mod compare;
pub mod contact_files;
mod documented;
mod error;
pub mod gearbox_files;
mod how_exact;
mod marked_place;
mod measured_files;
pub mod motion_files;
pub mod optimum_files;
pub mod page;
pub mod pair_files;
pub mod plan_files;
pub mod study_files;
pub mod tables;

pub use answer::{Cost, Phase, csv};
pub use answer_files::{Written, write_result, write_rows, write_summary, write_tables_and_page};
pub use documented::{documented_objects, documented_tables};
pub use error::ReportError;
pub use marked_place::MarkedPlace;
pub use measured_files::{MeasuredFiles, measured_files};
pub use pair_files::{static_charts, write_in_time, write_key_sweep_result, write_static_result, write_static_rows};

/// Schema of `summary.json`: grows with every change after which an older reader would misread it.
pub const SUMMARY_SCHEMA: u32 = 4;
