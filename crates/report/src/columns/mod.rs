//! Columns of files of rows.

mod static_history;

pub use static_history::{history_columns, write_history};
