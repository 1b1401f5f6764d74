//! A motion on disk that can be gone on from: rows as they come, and the state that belongs to them.
//!
//! | module | what it does |
//! |---|---|
//! | `store` | the folder beside the results' and its state |
//! | `seal` | the digest around the state |
//! | `growing` | files of rows, which a later run takes up again |
//! | `inputs` | digests of what the run is made of |
//! | `pair`, `rows` | what a pair's motion keeps |
//! | `gearbox` | what a gearbox's motion keeps |

mod error;
mod gearbox;
mod growing;
mod inputs;
mod pair;
mod rows;
mod seal;
mod store;

pub use error::CheckpointError;
pub use gearbox::{GearboxFileSink, GearboxState};
pub use growing::Kept;
pub(crate) use inputs::Change;
pub use inputs::{InputDigests, Resumable};
pub use pair::PairState;
pub use rows::Rows;
pub use rows::{ENERGY_FILE, HISTORY, motion_column_names, parse_rows, read_rows};
pub use seal::sealed_state;
pub use store::{CheckpointFolder, Checkpoints, Stored, StoredState};
