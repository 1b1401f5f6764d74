//! How do the bodies move?
//!
//! Quasi-static analysis: the driver stands at a given angle, the driven gear turns until the contact forces balance its
//! torque. Station by station over mesh cycles, with tooth changes in between.

mod contact_set;
mod cycle;
mod elastic;
mod equilibrium;
mod error;
mod flank_grid;
mod friction;
mod full;
mod kinematic;
mod line;
mod loads;
mod mesh_contact;
mod modal_flanks;
mod options;
pub mod pair_motion;
mod parts;
mod pose;
mod pose_solver;
pub mod result;
mod root_stress;
mod slice_count;
mod slice_set;
mod statics;
mod walk;

pub use contact_set::ContactSet;
pub use elastic::{ElasticGear, FullGear};
pub use equilibrium::{Equilibrium, Station};
pub use error::StaticError;
pub use flank_grid::flank_grids;
pub use kinematic::kinematic_transmission_error;
pub use mesh_contact::{ContactWork, MeshContact, MeshForce};
pub use options::{Bulk, Driver, Method, StaticOptions};
pub use pose::{Misalignment, Offset};
pub use result::{Certificate, PairResult, Site, SliceResult, StaticHistory, StaticPosition, Wrench};
pub use root_stress::{FilletStress, ROOT_STRESS_DEFINITION, ROOT_STRESS_RECOVERY, StressPeak};
pub use slice_count::{SliceCount, SpringErrors, slice_errors, slices_needed};
pub use slice_set::SliceSet;
pub use statics::{Change, StaticModel};
