//! What does the gear look like from its flanks?
//!
//! The flank nodes of the window's teeth are the boundary B, everything else but the bore is the interior I; the bore
//! moves rigidly with the gear's body frame.
//!
//! ```text
//! Phi_IC = -K_II^-1 K_IB,  T = [I; Phi_IC],  K^ = T' K T,  M^ = T' M T,  C = K^^-1
//! ```
//! One sparse factorisation a gear, boundary last, gives all of it, and stress modes S = D B T with it. Coordinates are three displacements a
//! boundary node (x, y, z), mm, in the window's own frame.

mod cyclic;
mod error;
mod grid;
mod half_tooth;
mod layer_profile;
mod plane_strain;
mod record;
mod reducer;
mod stored;
mod stress_modes;
mod window;

pub use cyclic::pitch_permutation;
pub use error::ReductionError;
pub use grid::{FlankGrid, GridReducer};
pub use half_tooth::HalfTooth;
pub use layer_profile::LayerProfile;
pub use record::{RECORD_VERSION, RecordError, RecordKey, ReductionRecord, record_key};
pub use reducer::{GearReducer, ReductionOptions};
pub use stored::StoredGear;
pub use stress_modes::StressModes;
pub use window::{ReducedGear, Window};
