//! The gearbox file: shafts, bearings, gears and the pairs that mesh.
//!
//! | module | what it does |
//! |---|---|
//! | `file` | a checked gearbox |
//! | `read` | from a file to that |
//! | `motion` | how it runs in time |
//! | `raw`, `check`, `values` | its words, and what they mean: every complaint is made here |

mod check;
mod file;
mod motion;
mod raw;
mod read;
mod values;

pub use file::{
    Gearbox, GearboxBearing, GearboxGear, GearboxInput, GearboxMesh, GearboxSection, GearboxShaft, GearboxTorque,
};
pub use motion::{GearboxDrive, GearboxMotion, MeshModel};
