//! Columns of files of rows: one table a kind of rows, from which header, rows, charts and `docs/outputs.md` come or
//! against which they are held.
//!
//! A new column is one entry of a table, and its line in the document.

mod derivatives;
pub mod energy;
mod error;
pub mod gearbox;
pub mod lumped_history;
pub mod motion_history;
mod motion_rows;
mod rows;
mod solved;
pub mod static_history;
mod table;

pub use derivatives::derivative_columns;
pub use energy::{ENERGY, EnergyRows};
pub use error::ColumnsError;
pub use lumped_history::{LUMPED_HISTORY, LumpedLayout, LumpedRows, lumped_columns, lumped_quantity};
pub use motion_history::{MOTION_HISTORY, MotionRows};
pub use motion_rows::motion_rows;
pub use rows::{columns_to_csv, parse_columns, read_columns};
pub use solved::solved_rows;
pub use static_history::{
    Points, STATIC_HISTORY, StaticCurves, StaticLayout, StaticRows, history_columns, history_rows, history_table,
};
pub(crate) use table::columns;
pub use table::{At, Column, GEARS, Group, Over, Rows, Sheet, Table};
