//! Orders of a motion: spectra at constant speed, largest values over speed, and the frequencies that orders meet.

mod campbell;
mod run_up;
mod series;
mod spectrum;

pub(crate) use campbell::CAMPBELL_BEYOND;
pub use campbell::{CampbellDiagram, CriticalSpeed};
pub use run_up::{OrderCut, PeakOverSpeed, RunUp, RunUpCycle, RunUpHeadline};
pub use series::MotionSeries;
pub(crate) use spectrum::window;
pub use study::{MotionSpectrum, Stretches, Waterfall, WaterfallLine, waterfall};
