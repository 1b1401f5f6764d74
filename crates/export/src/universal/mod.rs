//! Universal files (SDRC I-DEAS), which programs for modal analysis, test and acoustics read: units (dataset 164) and
//! functions of frequency (dataset 58).
//!
//! Columns are those of the public descriptions of both datasets; numbers of the ordinate have 13 digits.

mod function;
mod number;

pub use function::{Function, Response, universal_file};
