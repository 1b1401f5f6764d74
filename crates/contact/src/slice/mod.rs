//! Contact of slices: one line load an axial slice, where both profiles are nearest.

mod flank_pair;
mod mesh;
mod profile_search;
mod rigid;
mod set;
mod tooth_layer;

pub use flank_pair::{FlankPair, Slice, SliceFlank, SliceHint, SlicePlace, slice};
pub use mesh::{ContactWork, MeshContact, MeshForce, Want};
pub(crate) use profile_search::{bracket_zero, bracket_zero_within};
pub use rigid::{NearestPlace, RigidFlanks};
pub use set::SliceSet;
pub use tooth_layer::ToothLayer;
