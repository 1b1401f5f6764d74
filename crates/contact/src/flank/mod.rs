//! Flanks: their smooth surface, their mesh, points on them, and faces of two flanks that may touch.

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
