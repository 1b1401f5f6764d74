//! Files of an optimisation: the scene of the optimum, tables, report.

mod page;
mod tables;
mod write;

pub use write::{Goals, OptimumResult, optimum_warnings, passed_limits, write_optimum};
