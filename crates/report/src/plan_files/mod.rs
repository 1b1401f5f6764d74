//! Files of a plan: a row a case.
//!
//! | module | what it does |
//! |---|---|
//! | `page` | the report: spread, curves, maps, correlation, cases to sort |
//! | `curves`, `maps` | an output over one axis, and over two |
//! | `spread` | quantiles and what else is told of a number |
//! | `write` | the files and the closing table |

mod curves;
mod maps;
mod page;
mod spread;
mod write;

pub(crate) use curves::plain;
pub use page::{PageWords, report_folder};
pub use write::write_cases;
pub(crate) use write::{OBJECTS, documented};
