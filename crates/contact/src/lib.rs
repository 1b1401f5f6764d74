//! Who touches whom, how hard, over what length?
//!
//! Three steps, in the order of the files:
//!
//! 1. [`Candidates`]: which flank faces may touch (bounding volumes, surface against surface);
//! 2. [`closest_points`]: gap and normal of each candidate point against the other flank's smooth surface, and of the
//!    line of least gap;
//! 3. [`complementarity`]: forces so that g >= 0, p >= 0, p g = 0 at every point, together with the rotation that
//!    balances the torque.
//!
//! Body 1 (pinion) carries the contact points, body 2 (wheel) the surface they are held against. Gap g >= 0 is open;
//! the force on body 1 acts along body 2's outward normal. Lengths in mm, forces in N.

mod bulk_grid;
mod bulk_table;
mod candidates;
mod closest_point;
pub mod complementarity;
mod condensed;
mod error;
pub mod hertz;
mod least_gap;
mod line_length;
mod loaded_line;
mod local;
mod patch;
mod points;
mod pressure;
mod profile_search;
mod rigid;
mod slices;
mod surface;
mod tooth_layer;

pub use bulk_table::{BulkCompliance, BulkTable, TablePlace, TableWork};
pub use candidates::{Candidates, FacePair};
pub use closest_point::{ContactRow, GapSource, LinePoints, Scene, Support, closest_points, contact_row, line_points};
pub use complementarity::{
    Balance, DenseProblem, DenseSolver, Equality, HeldSolution, Law, LinearContact, Problem, Solution,
};
pub use condensed::{Condensed, opening};
pub use error::ContactError;
pub use least_gap::{SurfacePair, least_gap};
pub use line_length::{contact_intervals, covered};
pub use loaded_line::{LineStation, loaded_intervals};
pub use local::{EndFace, LocalBody, LocalContact, LocalLaw, LocalState, layer_constant, wedge_softening};
pub use patch::{FacePoint, FlankPatch};
pub use points::{ContactPoint, contact_points};
pub use pressure::nodal_pressures;
pub use rigid::{NearestPlace, RigidFlanks};
pub use slices::{FlankPair, Slice, SliceFlank, SliceHint, SlicePlace, slice};
pub use surface::{Cylinder, Foot, Surface};
pub use tooth_layer::ToothLayer;

/// Points and vectors, mm.
pub type Vec3 = nalgebra::Vector3<f64>;
/// Pose of a body: its own frame to the common one.
pub type Pose = nalgebra::Isometry3<f64>;
