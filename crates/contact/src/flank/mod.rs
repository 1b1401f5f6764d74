//! Flanks: their smooth surface, the mesh over it, points on it, and which faces of two flanks may touch.

mod candidates;
mod gap_source;
mod grid;
mod patch;
mod points;
mod surface;

pub use candidates::{Candidates, FacePair};
pub use gap_source::GapSource;
pub use grid::flank_grids;
pub(crate) use patch::Interpolation;
pub use patch::{FacePoint, FlankPatch};
pub use points::{ContactPoint, contact_points};
pub use surface::{Cylinder, Foot, Surface};
