//! What force does the mesh give at a phase, an approach and a tilt? A table of the contact, made to a stated error,
//! in place of the contact itself.

mod build;
mod column;
mod damping;
mod damping_table;
mod error;
mod load_axis;
mod map;
mod offset_pairs;
mod pair_shares;
mod pair_sums;
mod sampler;
mod spline;
mod spline_cache;

pub use build::{MapPlan, MapWatch, MapWork};
pub use damping::MapDamping;
pub use error::MapError;
pub use map::{ContactMap, CutPlace, MapCertificate, MapContact, Wanted};
pub use offset_pairs::{OffsetError, OffsetMap, PairOffsets};
pub use sampler::{ContactSample, LoadedSlice, PhaseContact};
pub use spline_cache::SplineCache;
