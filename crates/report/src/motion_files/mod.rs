//! Files of a motion beside its rows: spectra, what is largest over speed, frequencies over speed, charts.

mod campbell;
mod charts;
mod passage;
mod precision;
mod resonance;
mod sink;
mod spectrum;
mod write;

pub use campbell::campbell_csv;
pub use charts::{MotionPictures, SHOWN_CYCLES, SweepPictures, motion_charts, sweep_charts};
pub use passage::{cycles_csv, order_cuts_csv};
pub use precision::{motion_precision_csv, motion_precision_svg, motion_precision_table, write_motion_precision};
pub use resonance::resonance_csv;
pub use sink::MotionFileSink;
pub use spectrum::{SPECTRA, spectra, spectrum_csv, waterfall_csv};
pub use write::{write_motion, write_sweep};

/// Frequencies over speed.
pub const CAMPBELL_FILE: &str = "campbell.csv";
/// One row a mesh cycle of a ramp.
pub const CYCLES_FILE: &str = "cycles.csv";
/// Amplitudes of mesh orders over speed.
pub const ORDER_CUTS_FILE: &str = "order_cuts.csv";
/// Lines of a motion at constant speed.
pub const SPECTRUM_FILE: &str = "spectrum.csv";
/// Spectra of a ramp, stretch by stretch.
pub const WATERFALL_FILE: &str = "waterfall.csv";
/// Answers of a sweep.
pub const RESONANCE_FILE: &str = "resonance.csv";
