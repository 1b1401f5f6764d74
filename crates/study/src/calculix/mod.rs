//! CalculiX as one more way to compute a position: a deck from the very meshes that this program uses, the run, what
//! came out.
//!
//! ```text
//! both gears at one position, their own meshes; pinion's centre at the origin, wheel's at (a, 0, 0)
//! driver's bore nodes held; driven gear's bore a rigid body on its axis, with the torque
//! window's tooth pairs: surface to surface, linear pressure-overclosure, frictionless, small displacement
//! ```
//! The gaps are those of the mesh's own faces, so linear elements show their facets here. CalculiX is a program of its
//! own (`ccx`, GPL): it is started as a process where it is installed, nothing of it is linked.

mod deck;
mod elements;
mod error;
mod print;
mod run;

pub use deck::{Body, Deck};
pub use elements::element_type;
pub use error::CalculixError;
pub use print::{CalculixResult, PairForce};
pub use run::{Calculix, CalculixRun};
