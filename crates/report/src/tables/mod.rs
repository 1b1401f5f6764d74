//! Tables at the end of a run: a label, a value and its unit a line.

mod lines;
mod motion_table;
mod static_table;

pub use lines::{Lines, fixed, framed, model_name, push_line};
pub use motion_table::{motion_table, sweep_table};
pub use static_table::closing_table;
