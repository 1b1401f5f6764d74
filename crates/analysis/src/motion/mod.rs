//! The pair in motion.
//!
//! | module | what it does |
//! |---|---|
//! | `options` | words of the scene in the solvers' units |
//! | `checks` | what must hold of any motion |
//! | `stable` | steps too long for an explicit method |
//! | `series` | quantities over time that the next three are read off |
//! | `spectrum`, `passage` | orders at constant speed; what is largest over speed |
//! | `campbell` | mesh orders through the pair's frequencies |

mod campbell;
mod checks;
mod options;
mod passage;
mod series;
mod spectrum;
mod stable;

pub use campbell::{CampbellDiagram, CriticalSpeed};
pub use checks::{MOTION_WAY_OUT, energy_check, force_jump_check, pulling_check};
pub use options::{RPM, bearing, drive, motion_options, scheme, speed, stated_body, steady_by, torque};
pub use passage::{OrderCut, Passage, PassageCycle, PassageHeadline, PeakOverSpeed};
pub use series::MotionSeries;
pub use spectrum::{MotionSpectrum, WaterfallLine, waterfall};
pub use stable::{Steps, UnstableSteps, refuse_unstable};
