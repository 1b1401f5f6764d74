//! Reduces a gear to its flanks.
//!
//! The flank nodes of the window's teeth are the boundary B. All other nodes except those of the bore are the interior
//! I. The bore moves rigidly with the gear's body frame.
//!
//! ```text
//! Phi_IC = -K_II^-1 K_IB,  T = [I; Phi_IC],  K^ = T' K T,  M^ = T' M T,  C = K^^-1
//! ```
//! There are two methods for the compliance C and, on request, K^, M^, fields and stress modes S = D B T. They give the
//! same result. A gear that is invariant under rotation by one pitch is condensed as one sector that is joined with
//! itself; any other gear is condensed with one sparse factor of the whole gear. Coordinates are three displacements
//! per boundary node (x, y, z), mm, in the window's own frame.

mod bolt_shares;
mod cyclic;
mod elastic;
mod elastic_bore;
mod error;
mod general;
mod kept_table;
mod layer_profile;
mod load;
mod local_compliance;
mod mean_seat;
mod modes;
mod plane_strain;
mod record;
mod recovery;
mod reducer;
mod stack;
mod stress_modes;
mod stress_recovery;
mod teeth;
mod turned_rows;
mod window;

pub use elastic::{ElasticGear, FullGear};
pub use error::ReductionError;
pub use fem::KeptFactor;
pub use kept_table::{KeptTable, TableKey};
pub use layer_profile::LayerProfile;
pub use load::{FlankGrid, FlankGrids};
pub use local_compliance::LocalCompliance;
pub use modes::{GearModes, LowestFrequencies, ModeChoice, StandingModes};
pub use record::{
    RECORD_VERSION, RecordError, RecordKey, ReductionRecord, factor_bytes, read_factor, read_table, record_key,
    table_bytes,
};
pub use reducer::{
    BoltCompliance, BoltsAndFlanks, GearReducer, ReductionOptions, ReductionStage, ReductionWatch, ReductionWay,
    TablePart,
};
pub use stack::LayerStack;
pub use stress_modes::StressModes;
pub use teeth::{PartFault, PartStore, ToothColumns};
pub use window::{ReducedGear, Window};
