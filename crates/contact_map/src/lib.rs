//! What force does the mesh give at a phase, an approach and a tilt? A table of the contact, made to a stated error,
//! in place of the contact itself.

mod beyond;
mod build;
mod certificate;
mod column;
mod damping;
mod damping_table;
mod error;
mod errors;
mod friction;
mod load_axis;
mod map;
mod offset_pairs;
mod pair_shares;
mod pair_sums;
mod sampler;
mod spline;
mod spline_cache;

pub use build::{MapPlan, MapWatch, MapWork};
pub use certificate::MapCertificate;
pub use damping::MapDamping;
pub use error::MapError;
pub use friction::{FrictionError, MapFriction};
pub use map::{ContactMap, CutPlace, MapContact, Wanted};
pub use offset_pairs::{OffsetError, OffsetMap, PairOffsets};
pub use sampler::{ContactSample, LoadedSlice, PhaseContact};
pub use spline_cache::SplineCache;
