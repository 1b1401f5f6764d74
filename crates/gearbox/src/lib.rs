//! How do shafts, bearings and gears stand and swing together?
//!
//! The files in the order of the model:
//!
//! 1. [`Structure`] and its parts: what the user says;
//! 2. [`Supports`]: bearings in series with the housing; [`rolling_bearing`]: those whose stiffness follows the load;
//! 3. [`Assembly`]: matrices of all nodes;
//! 4. [`Rotors`], [`WhirlModes`], [`ModalEnergy`]: natural frequencies and whirl modes over speed;
//! 5. [`Train`]: which way and how fast all gears turn, and the phase of every mesh;
//! 6. [`MeshElement`]: what a mesh is asked for; the exact contact ([`ExactMesh`]) or a spring ([`motion::SpringMesh`]);
//! 7. [`StaticGearbox`], [`GearboxPosition`]: where all of it stands under load;
//! 8. [`Vibration`]: how it swings about that, driven by its meshes, gears with their elastic modes ([`ElasticBody`]) or rigid;
//! 9. [`motion`]: how all of it moves in time.
//!
//! Axes of shafts are along +z; units mm, N, MPa, t, s, rad; common axes. Results are the same bits for any number of
//! threads.

mod assembly;
mod balance;
mod bearing;
mod campbell;
mod compliant_support;
mod elastic_body;
mod elastic_gears;
mod equilibrium;
mod error;
mod even_mesh;
mod exact_mesh;
mod joined_meshes;
mod linearised;
mod load_sharing;
mod mesh_bears;
mod mesh_element;
pub mod mesh_numbers;
mod mesh_torques;
mod modal_contact;
mod modal_energy;
pub mod motion;
mod position;
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
mod unconstrained;
mod vibration;
mod whirl;

pub use assembly::Assembly;
pub use bearing::Bearing;
pub use elastic_body::ElasticBody;
pub use elastic_gears::elastic_gears;
pub use error::GearboxError;
pub use exact_mesh::ExactMesh;
pub use load_sharing::{LoadSharing, PlanetShare, load_shares, planet_play};
pub use mesh_bears::MeshBears;
pub use mesh_element::{MeshElement, MeshForces, ModalForces, Vector12};
pub use mesh_torques::mesh_torques;
pub use modal_energy::{Component, EnergyShare, ModalEnergy};
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
