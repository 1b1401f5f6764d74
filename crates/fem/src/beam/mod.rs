//! Straight shafts as beams along z, with the coordinates of a gear at every node.
//!
//! Coordinates of a node: displacements x, y, z (mm), turns about x, y, z (rad). In bending u_x' = theta_y and u_y' =
//! -theta_x, but for shear.

mod element;
mod line;
mod section;

pub use element::BeamTheory;
use element::{beam_gyroscopic, beam_mass, beam_stiffness};
pub use line::{BeamLine, BeamPiece, coincidence};
pub use section::BeamSection;

/// Coordinates of a node.
pub const NODE_COORDINATES: usize = 6;
