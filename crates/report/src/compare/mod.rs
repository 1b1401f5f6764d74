//! Result folders side by side: headline numbers with differences, curves over each other.
//!
//! | module | what it does |
//! |---|---|
//! | `folder` | a result folder read back |
//! | `one_mesh` | a gearbox beside pairs, by the names of a pair |
//! | `numbers` | headline numbers and inputs, run by run |
//! | `curves` | columns of tables that the runs share, over mesh phase, time, speed or the first column |
//! | `rows`, `report` | both as tables, and on a page |

mod curves;
mod folder;
mod numbers;
mod one_mesh;
mod report;
mod rows;

pub(crate) use report::OBJECT;
pub use report::{CompareChart, compare_answer, compare_charts, compare_page};
pub(crate) use rows::documented;

pub use curves::{Axis, Overlay, Trace, overlays};
pub use folder::{ResultFolder, summary};
pub use numbers::{BESIDE, Difference, NumberRow, WordRow, headline_rows, input_rows};
pub use one_mesh::by_shared_names;
