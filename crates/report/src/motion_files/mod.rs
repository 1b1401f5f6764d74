//! Files of a motion beside its rows: spectra, sections, what is largest over speed, frequencies over speed, charts.

mod charts;
mod section;
mod spectrum;
mod waterfall;

pub(crate) use charts::energy_chart;
pub use charts::{MotionPictures, SHOWN_CYCLES, SweepPictures, motion_charts, sweep_charts};
pub(crate) use section::{portrait, section};
pub use spectrum::SPECTRA;
pub(crate) use spectrum::{spectrum, spectrum_chart};
pub(crate) use waterfall::{WaterfallOf, waterfall, waterfall_chart};
