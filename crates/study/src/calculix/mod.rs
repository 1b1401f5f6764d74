//! CalculiX as another way to compute a position: an input deck from the same meshes, the run, and its results.
//!
//! ```text
//! both gears at one position, their own meshes; pinion's centre at the origin, wheel's at (a, 0, 0)
//! driver's bore nodes held; driven gear's bore a rigid body on its axis, with the torque
//! window's tooth pairs: surface to surface, linear pressure-overclosure, frictionless, small displacement
//! ```
//! The gaps are those of the mesh's own faces, so linear elements show the effect of their facets. CalculiX is a
//! separate program (`ccx`, GPL). It is started as a process if it is installed; none of it is linked.

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
