//! Models of a gear pair with few degrees of freedom.
//!
//! | module | what it is | DOF |
//! |---|---|---|
//! | [`iso`] | tooth and mesh stiffness after ISO 6336-1, method B, and what follows from it in closed form | 0 |
//! | [`lumped8`] | x, y, z, theta of each gear; backlash, friction force and torque; dimensionless form | 8 |
//! | [`lumped12`] | six coordinates of each gear; tilt stiffness, friction vector, modes with and without friction | 12 |
//! | [`impact`] | rigid gears on their true flanks, impact function, stick-slip friction | 1 to 12 |
//! | [`shaft18`] | lumped shafts with helical meshes between them, natural frequencies and backlash | as many as are kept; 18 |
//!
//! A [`LumpedPair`] holds what these have in common: directions, contact lines, bodies, excitation and load, from
//! published data or fed by another model of the same pair ([`MeshCycle::fed`]). Units: mm, N, t, s, rad.

mod clock;
mod dead_zone;
pub mod error;
mod fourier;
mod frame;
mod history;
pub mod impact;
pub mod iso;
pub mod lumped12;
pub mod lumped8;
mod mesh_cycle;
pub mod modes;
mod pair;
mod plane_of_action;
pub mod shaft18;
mod statics;
mod terms;

pub use clock::MeshClock;
pub use dead_zone::{Beyond, DeadZone};
pub use error::LumpedError;
pub use fourier::{Fourier, FourierTorque};
pub use frame::MeshFrame;
pub use history::{HistoryRow, LumpedModel, starting_state};
pub use mesh_cycle::MeshCycle;
pub use pair::{LumpedPair, Operation};
pub use plane_of_action::{LineMeans, LineSharing, PlaneOfAction};
pub use statics::equilibrium;
