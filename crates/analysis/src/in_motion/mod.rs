//! Checks of any machine in motion, and remarks for the user: for a single pair, and for every mesh of a gearbox.
//!
//! | module | what it does |
//! |---|---|
//! | `checks` | what must hold: energy, flanks that pull, forces that jump, deflection, maps |
//! | `flanks` | the flanks of a mesh: what they do, what must hold of them, what is said |
//! | `machine` | what is said of a whole machine: its speed, its energy, how it settles |
//! | `resolved` | whether rows and steps show what moves |

mod checks;
mod flanks;
mod machine;
mod resolved;

pub use checks::{
    deflection_check_in_motion, excursion_check, force_jump_check, map_checks, map_excess, pulling_check,
};
pub(crate) use checks::{energy_check, energy_remark};
pub use flanks::FlankCertificate;
pub(crate) use flanks::{BothFlanks, MeshInMotion, NO_BACKLASH_UM, Parting, no_backlash};
pub(crate) use machine::{Settled, speed_changed, stretched, work_open};
pub(crate) use resolved::{MeshRecord, Resolved, StepKeys, coarse_steps, steps_of_cycle};
