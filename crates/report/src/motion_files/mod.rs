//! Files of a motion beside its rows: spectra, what is largest over speed, frequencies over speed, charts.

mod charts;
mod precision;
mod sink;
mod spectrum;

pub use charts::{MotionPictures, SHOWN_CYCLES, SweepPictures, motion_charts, sweep_charts};
pub use precision::{motion_precision_csv, motion_precision_svg, motion_precision_table, write_motion_precision};
pub use sink::MotionFileSink;
pub use spectrum::{SPECTRA, spectra};
