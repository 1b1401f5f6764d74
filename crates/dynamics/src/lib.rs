//! How does the pair move? Rigid bodies on bearings, drives and loads, and the contact of their elastic teeth between
//! them.

mod body;
mod coordinates;
mod drive;
mod elastic_displacement;
mod equivalent_mass;
mod error;
mod extremes;
mod flank_maps;
mod instant;
mod low_frequency;
mod mechanism;
mod mesh_flanks;
mod mesh_side;
mod modal;
mod nominal;
mod options;
mod rotation;
mod run;
mod side_loads;
mod stable_step;
mod stands;
mod start;
mod sweep;

pub use body::{Bearing, COORDINATES, RigidBody};
pub use coordinates::{Coordinates, Displacement};
pub use drive::{Speed, Torque};
pub use elastic_displacement::ElasticDisplacement;
pub use equivalent_mass::{damping_per_length, equivalent_mass};
pub use error::PairMotionError;
pub use extremes::Extremes;
pub use flank_maps::{MapFailure, MapRequest};
pub use instant::{Instant, LoadedSlice};
pub use low_frequency::{CHANGE_LIMIT, ElasticChange, LOW_FREQUENCY_LIMIT, MeshResonance};
pub use mechanism::{MechanismState, PairMechanism};
pub use mesh_flanks::{FlankDamping, FlankForces, FlankStates, MeshFlanks};
pub use mesh_side::{ModalForce, SideState, ToothChanges};
pub use modal::GearVibration;
pub use nominal::{Nominal, NominalState};
pub use options::{Drive, MeshDamping, MotionOptions};
pub use rotation::rotation_share;
pub use run::{Motion, MotionSettings, compared, instants, run_to_steady};
pub use side_loads::SideLoads;
pub use stable_step::stable_step;
pub use start::quasi_static_start;
pub use sweep::{SteadyBy, SteadyOptions, SweepMiss, SweepOutcome, SweepPlan, SweepPoint, shoot, sweep};
