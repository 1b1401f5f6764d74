//! The gearbox file: shafts, bearings, gears and the pairs that mesh.
//!
//! | module | what it does |
//! |---|---|
//! | `file` | a checked gearbox |
//! | `read` | from a file to that |
//! | `vibration`, `modes`, `motion`, `mesh_cycles` | how it swings, with which modes of its gears, and how it runs in time, for how many cycles |
//! | `accuracy` | how exact its numbers are to be |
//! | `rating` | whether it will hold, at which speed |
//! | `shaft` | sections of the file, or of a REXS file |
//! | `bearing`, `rolling`, `designation`, `seats` | bearings of a stiffness, and those with rolling elements; which a designation says; where they sit |
//! | `planets` | parts of one planet, written out for all |
//! | `one_gear` | gears of several meshes, of which all scenes say the same |
//! | `of_pair`, `whole_pair` | the gearbox that a pair is the short form of: its mesh, and what it has beside that |
//! | `schema`, `check`, `parts`, `values`, `housing`, `loads` | its words, and what they mean: every complaint is made here |

mod accuracy;
mod bearing;
mod check;
mod designation;
mod file;
mod housing;
mod loads;
mod mesh_cycles;
mod modes;
mod motion;
mod of_pair;
mod one_gear;
mod pair_setting;
mod parts;
mod planets;
mod planets_fit;
mod rating;
mod read;
mod rolling;
mod schema;
mod seats;
mod shaft;
mod stage_starter;
mod values;
mod vibration;
mod whole_pair;

pub use file::{
    AxialPlay, Gearbox, GearboxBearing, GearboxGear, GearboxInput, GearboxMesh, GearboxPlanets, GearboxRating,
    GearboxRolling, GearboxSection, GearboxShaft, GearboxTorque, GearboxVibration, PlanetMesh, RollingSize, ThrustSeat,
};
pub use motion::{GearboxBranch, GearboxDamping, GearboxMotion};
pub use of_pair::gearbox_of_moving_pair;
pub(crate) use schema::{GEARBOX, tables};
pub use schema::{GearboxDrive, MeshModel, MeshTiming, RollingKind};
pub use stage_starter::{StageHeld, StageStarter};
pub use whole_pair::{GearboxOfPair, gearbox_of_pair};
