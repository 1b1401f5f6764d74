//! Maps of the mesh contact: the mesh force as a function of phase, approach and tilt, in a table with a stated error
//! that replaces the contact solution.

mod beyond;
mod build;
mod certificate;
mod column;
mod damping;
mod damping_table;
mod error;
mod errors;
mod friction;
mod friction_table;
mod load_axis;
mod map;
mod offset_pairs;
mod pair_shares;
mod pair_sums;
mod plan;
mod sampler;
mod spline;
mod spline_cache;

pub use build::{MapWatch, MapWork};
pub use certificate::{FrictionError, MapCertificate};
pub use damping::MapDamping;
pub use error::MapError;
pub use friction::MapFriction;
pub use map::{ContactMap, CutPlace, MapContact, Wanted};
pub use offset_pairs::{OffsetError, OffsetMap, PairOffsets};
pub use plan::MapPlan;
pub use sampler::{ContactSample, LoadedSlice, PhaseContact};
pub use spline_cache::SplineCache;
