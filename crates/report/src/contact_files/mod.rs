//! Contact lines and contact patterns as files, which only a run with slices has.

mod lines;
mod pattern_csv;
mod write;

pub use lines::write_contact_lines;
pub use pattern_csv::write_contact_pattern;
pub use write::{write_contact, write_patterns};
