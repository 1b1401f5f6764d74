//! A pair in motion: rigid bodies on bearings, drives and loads, and the contact of their elastic teeth between them.

mod body;
mod coordinates;
mod drive;
mod mechanism;
mod mesh_side;
mod nominal;
mod options;

pub use body::{Bearing, COORDINATES, RigidBody};
pub use coordinates::{Coordinates, Displacement};
pub use drive::{Speed, Torque};
pub use mechanism::{Instant, PairMechanism, equivalent_mass};
pub use nominal::{Moment, Nominal};
pub use options::{Drive, MeshDamping, MotionOptions};
