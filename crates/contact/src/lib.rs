//! Who touches whom, how hard, over what length?
//!
//! Three steps, in the order of the files:
//!
//! 1. [`flank::Candidates`]: which flank faces may touch (bounding volumes, surface against surface);
//! 2. [`mod@slice`]: the least gap of the two profiles at each height, the contact's default; or [`nodal::closest_points`]:
//!    gap and normal of each candidate point against the other flank's smooth surface, and of the line of least gap;
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
pub mod flank;
mod flank_projection;
mod friction;
mod lanes;
pub mod line;
pub mod local;
pub mod nodal;
mod offset;
mod options;
pub mod pose;
mod result;
mod set;
pub mod slice;
mod window;

pub use bracketing::last_inside;
pub(crate) use complementarity::SavedSolution;
pub(crate) use compliance::{BulkBody, FullContact, TablePoint};
pub use compliance::{BulkTable, Condensed, ModalFlanks, ModalForces, TableWork, opening};
pub use elastic_contact::{CandidateRows, ElasticContact, WarmStart, warm_start};
pub use error::ContactError;
pub use flank_projection::FlankProjection;
pub use friction::{Friction, friction_work, sliding_distance};
pub use offset::{Misalignment, Offset};
pub use options::{Bulk, ContactOptions, Method};
pub(crate) use result::opening_by_motion;
pub use result::{MeshForce, Site, SliceResult, SliceState, Wrench, slice_result, wrenches};
pub use set::ContactSet;
pub(crate) use slice::{FlankPair, SlicePoint};
pub use window::WindowContact;

/// Points and vectors, mm.
pub type Vec3 = nalgebra::Vector3<f64>;
/// Pose of a body: its own frame to the common one.
pub type Pose = nalgebra::Isometry3<f64>;
