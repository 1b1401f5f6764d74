//! Files of a chart of accuracy against cost.

mod csv;
mod tables;
mod work_precision;

pub use csv::chart_csv;
pub use tables::chart_tables;
pub use work_precision::{work_precision_svg, write_work_precision};
