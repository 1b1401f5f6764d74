//! Files of an optimisation: the scene of the optimum, tables, report.

mod page;
mod result;
mod tables;
mod write;

pub use result::{Goals, OptimumResult};
pub use write::{optimum_warnings, passed_limits, write_optimum};
