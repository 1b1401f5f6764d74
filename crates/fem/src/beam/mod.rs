//! Straight shafts as beams along z; every node has the same coordinates as a gear.
//!
//! Coordinates of a node: displacements x, y, z (mm), rotations about x, y, z (rad). In bending, without shear, u_x' =
//! theta_y and u_y' = -theta_x.

mod element;
mod line;
mod section;

pub use element::BeamTheory;
use element::{beam_gyroscopic, beam_mass, beam_stiffness};
pub use line::{BeamLine, BeamPiece, coincidence};
pub use section::BeamSection;

/// Number of coordinates of a node.
pub const NODE_COORDINATES: usize = 6;
