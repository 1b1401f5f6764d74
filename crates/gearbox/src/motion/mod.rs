//! Motion of shafts, bearings and gears in time: any number of meshes, each at its own phase.
//!
//! | module | what it does |
//! |---|---|
//! | `reduced_bodies` | shafts with few coordinates: seats, and modes with the seats held |
//! | `free_coordinates` | what moves: deviations, and the turn of the whole train where a torque drives |
//! | `gear_modes` | elastic modes of gears |
//! | `moving_mesh` | what a motion asks of a mesh; what answers: `spring_mesh` with `pitch_errors`, `tilting_spring` (from the contact: `contact_spring`), `mapped_mesh` (along its levers: `lever_mesh`), `moving_exact` |
//! | `varying_torques` | torques of outputs over time |
//! | `rolling_supports` | rolling bearings by their laws, beside the springs in their place |
//! | `pair`, `pair_model` | a pair alone: two rigid gears and one mesh; what it is before it moves |
//! | `pair_run`, `pair_sweep` | mesh cycle by mesh cycle, speed by speed |
//! | `times` | cycles of the fastest mesh, with their rows and steps |
//! | `mechanism`, `live_mesh`, `balance` | all of it as one [`integrate::Mechanism`] |
//! | `start`, `stable_step` | from equilibrium on; how long explicit steps may be |
//! | `plan`, `run`, `memory` | row by row; what a checkpoint holds beside the state |
//! | `periodic_state` | where it settles to, without waiting |
//! | `branch`, `speed_family` | periodic motions over the speed, stable and unstable |
//! | `instant`, `energy` | what is read off |

mod balance;
mod branch;
mod contact_spring;
mod energy;
mod free_coordinates;
mod gear_modes;
mod instant;
mod lever_mesh;
mod live_mesh;
mod loops;
mod mapped_mesh;
mod mechanism;
mod memory;
mod moving_exact;
mod moving_frame;
mod moving_mesh;
mod normal_damper;
mod options;
mod pair;
mod pair_model;
mod pair_run;
mod pair_sweep;
mod periodic_state;
mod pitch_errors;
mod plan;
mod reduced_bodies;
mod rolling_supports;
mod run;
mod speed_family;
mod spring_mesh;
mod stable_step;
mod start;
mod tilting_spring;
mod times;
mod varying_torques;

pub use branch::GearboxBranch;
pub use contact_spring::ContactSpring;
pub use dynamics::{Extremes, FlankInstant, GearVibration, MapRequest, Speed, Torque as TorqueOverTime};
pub use energy::GearboxEnergy;
pub use instant::{GearboxInstant, MeshInstant};
pub use lever_mesh::{LEVERS, LeverForces, LeverMesh};
pub use mapped_mesh::MappedMesh;
pub use mechanism::GearboxMechanism;
pub use memory::{GearboxMemory, MeshMemory};
pub use moving_exact::MovingExactMesh;
pub use moving_mesh::{MeshLosses, MovingMesh};
pub use options::{Drive, MotionOptions};
pub use pair::PairInstant;
pub use pair_model::PairModel;
pub use pair_run::{PairMotion, compared, instants, run_to_steady};
pub use pair_sweep::{SteadyBy, SteadyOptions, SweepMiss, SweepOutcome, SweepPlan, SweepPoint, sweep};
pub use periodic_state::shoot;
pub use pitch_errors::PitchErrors;
pub use plan::MotionPlan;
pub use reduced_bodies::{ReducedBodies, ReductionCertificate};
pub use run::{FlankCourse, GearboxCheckpoint, GearboxCourse, GearboxRun};
pub use spring_mesh::SpringMesh;
pub use tilting_spring::TiltingSpring;
pub use times::{CycleSteps, MotionTimes};
pub use varying_torques::TorqueMemory;
