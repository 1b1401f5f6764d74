//! Gearboxes: statics, vibration and motion of shafts, bearings and gears together.
//!
//! The files, in the order of the model:
//!
//! 1. [`Structure`] and its parts: the input;
//! 2. [`Supports`]: bearings in series with the housing; [`rolling_bearing`]: bearings whose stiffness depends on the
//!    load;
//! 3. [`Assembly`]: matrices of all nodes;
//! 4. [`Rotors`], [`WhirlModes`], [`ModalEnergy`]: natural frequencies and whirl modes over speed;
//! 5. [`Train`]: sense and speed of all gears, and the phase of every mesh;
//! 6. [`MeshElement`]: the interface of a mesh; the exact contact ([`ExactMesh`]) or a spring ([`motion::SpringMesh`]);
//! 7. [`StaticGearbox`], [`GearboxPosition`]: the static equilibrium under load;
//! 8. [`Vibration`]: the vibration about this equilibrium, excited by the meshes, with elastic modes of the gears
//!    ([`ElasticBody`]) or rigid gears;
//! 9. [`motion`]: the motion in time.
//!
//! Axes of shafts are along +z. Units are mm, N, MPa, t, s, rad; vectors are in common axes. Results have the same bits
//! for any number of threads.

mod assembly;
mod balance;
mod bearing;
mod bore_error;
mod campbell;
mod compliant_support;
mod elastic_body;
mod elastic_gears;
mod equilibrium;
mod error;
mod even_mesh;
mod exact_mesh;
mod flank_forces;
mod joined_meshes;
mod linearised;
mod load_sharing;
mod mesh_bears;
mod mesh_element;
pub mod mesh_numbers;
mod mesh_of_gears;
mod mesh_torques;
mod modal_contact;
mod modal_energy;
pub mod motion;
mod opening_bolts;
mod position;
mod pressed_bore;
mod rigid_motions;
pub mod rolling_bearing;
mod search;
mod seat_error;
mod seats;
mod shafts_in_shafts;
mod solve;
mod static_gearbox;
mod static_result;
mod structure;
mod supports;
mod train;
mod turned_seat;
mod turning_frame;
mod unconstrained;
mod vibration;
mod whirl;

pub use assembly::Assembly;
pub use bearing::Bearing;
pub use bore_error::BoreError;
pub use elastic_body::ElasticBody;
pub use elastic_gears::elastic_gears;
pub use error::GearboxError;
pub use exact_mesh::ExactMesh;
pub use flank_forces::{FlankForces, SliceForces};
pub use load_sharing::{LoadSharing, PlanetShare, load_shares, planet_play};
pub use mesh_bears::MeshBears;
pub use mesh_element::{MeshElement, MeshForces, ModalForces, Vector12};
pub use mesh_of_gears::MeshOfGears;
pub use mesh_torques::{even_mesh_torques, mesh_torques};
pub use modal_energy::{Component, EnergyShare, ModalEnergy};
pub use opening_bolts::BoltForce;
pub use pressed_bore::RollersOnBore;
pub use seat_error::SeatError;
pub use static_gearbox::{Operation, StaticGearbox, Torque};
pub use static_result::{
    BearingState, GearboxCertificate, GearboxPosition, MeshState, ShaftLine, face_load_factor, line_load,
};
pub use structure::{Disc, ElasticMesh, Machine, MeshSpring, Shaft, Structure};
pub use supports::Supports;
pub use train::{GearMesh, Meshing, Train};
pub use vibration::{
    ExcitationLine, Harmonic, MeanMesh, MeshExcitation, MeshSample, OrderForces, SpeedRms, Vibration, own_cycle, rms,
    taken_off, turn_levers,
};
pub use whirl::{Held, Rotors, WhirlMode, WhirlModes};
