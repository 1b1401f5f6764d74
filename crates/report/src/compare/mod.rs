//! Result folders side by side: headline numbers with differences, curves over each other.
//!
//! | module | what it does |
//! |---|---|
//! | `folder` | a result folder read back |
//! | `numbers` | headline numbers and inputs, run by run |
//! | `curves` | columns that the runs share, over mesh phase, time or speed |
//! | `csv`, `table`, `report` | both as files, for a terminal, as a page |

mod csv;
mod curves;
mod folder;
mod numbers;
mod report;
mod table;

pub use csv::{write_compare_csv, write_curves_csv};
pub use report::{CompareChart, compare_charts, write_compare_report};
pub use table::compare_table;

pub use curves::{Axis, Overlay, Trace, overlays};
pub use folder::{ResultFolder, summary};
pub use numbers::{Difference, NumberRow, WordRow, headline_rows, input_rows};
