//! The gearbox file: shafts, bearings, gears and the pairs that mesh.
//!
//! | module | what it does |
//! |---|---|
//! | `file` | a checked gearbox |
//! | `read` | from a file to that |
//! | `vibration`, `motion` | how it swings, and how it runs in time |
//! | `raw`, `check`, `values`, `housing`, `loads` | its words, and what they mean: every complaint is made here |

mod check;
mod file;
mod housing;
mod loads;
mod motion;
mod raw;
mod read;
mod values;
mod vibration;

pub use file::{
    Gearbox, GearboxBearing, GearboxGear, GearboxInput, GearboxMesh, GearboxSection, GearboxShaft, GearboxTorque,
    GearboxVibration,
};
pub use motion::{GearboxDrive, GearboxMotion, MeshModel};
