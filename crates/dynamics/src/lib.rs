//! Parts of a gear pair in motion: rigid bodies on bearings, drives and loads, and the contact of elastic teeth, in the
//! form that the mechanism (`gearbox::motion`) needs.

mod body;
mod drive;
mod elastic_displacement;
mod equivalent_mass;
mod extremes;
mod flank_maps;
mod gear_vibration;
mod instant;
mod low_frequency;
mod mesh_flanks;
mod mesh_side;
mod options;
mod rotation;
mod side_loads;

pub use body::{Bearing, COORDINATES, Displacement, RigidBody};
pub use drive::{Speed, Torque};
pub use elastic_displacement::ElasticDisplacement;
pub use equivalent_mass::{damping_per_length, equivalent_mass, equivalent_mass_of, masses_on_base_circles};
pub use extremes::Extremes;
pub use flank_maps::{MapFailure, MapRequest};
pub use gear_vibration::GearVibration;
pub use instant::{FlankInstant, LoadedSlice};
pub use low_frequency::{CHANGE_LIMIT, ElasticChange, LOW_FREQUENCY_LIMIT, MeshResonance};
pub use mesh_flanks::{FlankDamping, FlankForces, FlankStates, MeshFlanks};
pub use mesh_side::{ModalForce, SideState, ToothChanges};
pub use options::{Drive, MeshDamping, MotionOptions};
pub use rotation::rotation_share;
pub use side_loads::SideLoads;
