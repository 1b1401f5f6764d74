//! Files of a motion beside its rows: spectra, what is largest over speed, frequencies over speed, charts.

mod charts;
mod spectrum;

pub use charts::{MotionPictures, SHOWN_CYCLES, SweepPictures, motion_charts, sweep_charts};
pub use spectrum::{SPECTRA, spectra};
