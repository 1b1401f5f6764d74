//! Orders of a motion: spectra at constant speed, what is largest over speed, and the frequencies that orders meet.

mod campbell;
mod passage;
mod series;
mod spectrum;

pub use campbell::{CampbellDiagram, CriticalSpeed};
pub use passage::{OrderCut, Passage, PassageCycle, PassageHeadline, PeakOverSpeed};
pub use series::MotionSeries;
pub use spectrum::{MotionSpectrum, WaterfallLine, waterfall};
