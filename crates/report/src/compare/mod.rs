//! Result folders side by side: headline numbers with differences, curves over each other.
//!
//! | module | what it does |
//! |---|---|
//! | `folder` | a result folder read back |
//! | `numbers` | headline numbers and inputs, run by run |
//! | `curves` | columns that the runs share, over mesh phase, time or speed |

mod curves;
mod folder;
mod numbers;

pub use curves::{Axis, Overlay, Trace, overlays};
pub use folder::ResultFolder;
pub use numbers::{Difference, NumberRow, WordRow, headline_rows, input_rows};
