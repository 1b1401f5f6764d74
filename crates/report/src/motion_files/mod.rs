//! Files of a motion beside its rows: spectra, what is largest over speed, frequencies over speed, charts.

mod charts;
mod sink;
mod spectrum;

pub use charts::{MotionPictures, SHOWN_CYCLES, SweepPictures, motion_charts, sweep_charts};
pub use sink::MotionFileSink;
pub use spectrum::{SPECTRA, spectra};
