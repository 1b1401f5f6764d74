//! The pair in motion.
//!
//! | module | what it does |
//! |---|---|
//! | `options` | words of the scene in the solvers' units |
//! | `checks` | what must hold of any motion |
//! | `stable` | steps too long for an explicit method |

mod checks;
mod options;
mod stable;

pub use checks::{MOTION_WAY_OUT, energy_check, force_jump_check, pulling_check};
pub use options::{RPM, bearing, drive, motion_options, scheme, speed, stated_body, steady_by, torque};
pub use stable::{Steps, UnstableSteps, refuse_unstable};
