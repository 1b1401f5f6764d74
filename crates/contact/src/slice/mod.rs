//! Contact of slices: one line load per axial slice, at the point where both profiles are nearest.

mod first_order;
mod flank_change;
mod flank_pair;
mod half_teeth;
mod hint;
mod mesh_contact;
mod profile_end;
mod profile_kink;
mod profile_search;
mod rigid;
mod same_slices;
mod set;
mod smooth_slice;
mod supported;
mod tooth_layer;

pub use flank_change::{ChangeRates, FlankChange, FlankRates, HeldForces};
pub(crate) use flank_pair::{FlankPair, SlicePoint};
pub use flank_pair::{Slice, SliceFlank, slice};
pub(crate) use half_teeth::{HalfTeeth, TableFlanks};
pub use hint::SliceHint;
pub use mesh_contact::{
    Approach, CommonGear, ContactWork, EvaluationLevel, FlanksOfBore, JoinedContacts, MeshContact, PressedBore,
};
pub use rigid::{NearestPoint, RigidFlanks};
pub use same_slices::SameSlices;
pub use set::SliceSet;
pub use tooth_layer::ToothLayer;
