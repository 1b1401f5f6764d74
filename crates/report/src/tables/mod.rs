//! Tables at the end of a run: a label, a value and its unit a line.

mod geometry_table;
mod lines;
mod mesh_table;
mod motion_table;
mod static_table;

pub use geometry_table::{geometry_json, geometry_table};
pub use lines::{Lines, fixed, framed, model_name, push_line, torque};
pub use mesh_table::{mesh_findings, mesh_findings_json, mesh_info_table};
pub use motion_table::{motion_table, sweep_table};
pub use static_table::closing_table;
