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

mod bracketing;
pub mod complementarity;
mod compliance;
mod elastic_contact;
mod error;
mod flank;
mod flank_projection;
mod friction;
mod line;
mod local;
mod nodal;
mod offset;
mod options;
mod pose;
mod result;
mod set;
mod slice;
mod window;

pub use bracketing::last_inside;
pub(crate) use complementarity::SavedSolution;
pub use complementarity::{Balance, DenseProblem, DenseSolver, Equality, Law, LinearContact, Problem, Solution};
pub(crate) use compliance::{BulkCompliance, FullContact, TablePoint};
pub use compliance::{BulkTable, Condensed, ModalFlanks, ModalForces, TableWork, opening};
pub use elastic_contact::{CandidateRows, ElasticContact, WarmStart, warm_start};
pub use error::ContactError;
pub use flank::{
    Candidates, ContactPoint, Cylinder, FacePair, FacePoint, FlankPatch, Foot, GapSource, Surface, contact_points,
    flank_grids,
};
pub use flank_projection::FlankProjection;
pub use friction::{Friction, friction_work, sliding_distance};
pub use line::{
    LineStation, NeighbourPairs, contact_intervals, covered, hertz, line_pressure, line_station, loaded_intervals,
    nodal_contact_line, nodal_pressures, slice_line,
};
pub use local::{EndFace, LocalBody, LocalContact, LocalLaw, LocalState, layer_constant, wedge_softening};
pub use nodal::{ContactRow, LinePoints, Scene, Support, closest_points, contact_row, least_gap, line_points};
pub use offset::{Misalignment, Offset};
pub use options::{Bulk, ContactOptions, Method};
pub use pose::{check_offsets, displaced, frames, gear_centre, gear_pose, own_turns, reference_angle};
pub(crate) use result::opening_by_motion;
pub use result::{MeshForce, Site, SliceResult, SliceState, Wrench, slice_result, wrenches};
pub use set::ContactSet;
pub use slice::{
    ContactWork, EvaluationLevel, MeshContact, NearestPoint, RigidFlanks, SameSlices, Slice, SliceFlank, SliceHint,
    SliceSet, ToothLayer, slice,
};
pub(crate) use slice::{FlankPair, SlicePoint};

pub use window::WindowContact;

/// Points and vectors, mm.
pub type Vec3 = nalgebra::Vector3<f64>;
/// Pose of a body: its own frame to the common one.
pub type Pose = nalgebra::Isometry3<f64>;
