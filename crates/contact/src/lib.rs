//! Contact of the tooth flanks: which points touch, with what force, over what length.
//!
//! The computation has three steps, in the order of the files:
//!
//! 1. [`flank::Candidates`]: which flank faces may touch (bounding volumes, surface against surface);
//! 2. [`mod@slice`]: the smallest gap of the two profiles at each height, the default method; or
//!    [`nodal::closest_points`]: gap and normal of each candidate point, and of the points along the line of smallest
//!    gap, against the other flank's smooth surface;
//! 3. [`complementarity`]: forces with g >= 0, p >= 0, p g = 0 at every point, together with the rotation that balances
//!    the torque.
//!
//! Body 1 (pinion) carries the contact points; body 2 (wheel) is the surface against which they are measured. A gap g
//! >= 0 is open; the force on body 1 acts along the outward normal of body 2. Lengths are in mm, forces in N.

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
/// Pose of a body: transformation from its own frame to the common one.
pub type Pose = nalgebra::Isometry3<f64>;
