//! Vibration of a gearbox about its equilibrium, in the frequency domain. Theory (86) to (90).
//!
//! | module | what it does |
//! |---|---|
//! | `mesh_cycle` | a mesh through its own cycle while the others stand at their means |
//! | `excitation` | mean stiffness of a mesh, and what its transmission error does at every order |
//! | `reduced` | fewer modes: those of the range, and what loads at the gears need beyond |
//! | `response` | amplitudes at one frequency |
//! | `forced` | orders of all meshes over speed: mesh forces, bearing forces |
//! | `orders` | what orders do at one speed, and the lines of excitation |

mod excitation;
mod forced;
mod mesh_cycle;
mod orders;
mod reduced;
mod response;

pub use excitation::{MeanMesh, MeshExcitation, MeshSample, turn_levers};
pub use forced::{Harmonic, Vibration, rms, taken_off};
pub use mesh_cycle::own_cycle;
pub use orders::{ExcitationLine, OrderForces, SpeedRms};
