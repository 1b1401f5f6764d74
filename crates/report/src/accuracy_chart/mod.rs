//! Files of a chart of accuracy against cost.

mod csv;
mod resonance;
mod tables;
mod work_precision;

pub use csv::chart_csv;
pub use resonance::{
    resonance_curves_csv, resonance_curves_svg, resonance_precision_csv, resonance_precision_svg,
    resonance_precision_table, write_resonance_precision,
};
pub use tables::chart_tables;
pub use work_precision::{work_precision_svg, write_work_precision};
