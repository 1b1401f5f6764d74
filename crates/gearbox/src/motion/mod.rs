//! How shafts, bearings and gears move in time: any number of meshes, each at its own phase.
//!
//! | module | what it does |
//! |---|---|
//! | `reduced_bodies` | shafts with few coordinates: seats, and modes with the seats held |
//! | `free_coordinates` | what moves: deviations, and the turn of the whole train where a torque drives |
//! | `moving_mesh` | what a motion asks of a mesh; `spring_mesh`, `pitch_errors`, `moving_exact`: what answers |
//! | `mechanism`, `live_mesh`, `balance` | all of it as one [`integrate::Mechanism`] |
//! | `start`, `run` | from equilibrium on, row by row |
//! | `instant`, `energy` | what is read off |

mod balance;
mod energy;
mod free_coordinates;
mod instant;
mod live_mesh;
mod mechanism;
mod moving_mesh;
mod options;
mod pitch_errors;
mod reduced_bodies;
mod run;
mod spring_mesh;
mod start;

pub use energy::GearboxEnergy;
pub use instant::{GearboxInstant, MeshInstant};
pub use mechanism::GearboxMechanism;
pub use moving_mesh::{MeshDamper, MovingMesh};
pub use options::{Drive, MotionOptions};
pub use pitch_errors::PitchErrors;
pub use reduced_bodies::{ReducedBodies, ReductionCertificate};
pub use run::{GearboxRun, MotionPlan};
pub use spring_mesh::SpringMesh;
