//! Geometry sheet and what is known of meshes as text, and numbers in words.

mod geometry_table;
mod lines;
mod mesh_table;

pub(crate) use geometry_table::{GeometryBlock, geometry_blocks};
pub use geometry_table::{geometry_json, geometry_table};
pub(crate) use lines::given;
pub use lines::{fixed, model_name, push_line, torque};
pub use mesh_table::{mesh_findings, mesh_findings_json, mesh_info_table};
