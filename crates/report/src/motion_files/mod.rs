//! Files of a motion beside its rows: spectra, what is largest over speed, frequencies over speed.

mod campbell;
mod passage;
mod series;
mod spectrum;

pub use campbell::campbell_csv;
pub use passage::{cycles_csv, order_cuts_csv};
pub use series::motion_series;
pub use spectrum::{SPECTRA, spectra, spectrum_csv, waterfall_csv};

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
