//! What is kept between runs: result folders that are there as a whole or not at all, checkpoints, reduced gears; and
//! whether memory holds what a scene asks for.
//!
//! | module | what it does |
//! |---|---|
//! | [`folder`] | a result folder that is there as a whole or not at all; cases that are done; the cache of gears |
//! | [`checkpoint`] | rows and state of a motion that can be gone on from |
//! | [`check_memory`] | whether memory holds what a scene asks for |
//! | [`ResultFiles`] | where files go |

pub mod checkpoint;
mod error;
pub mod folder;
mod memory_available;
mod memory_demand;
mod result_files;

pub use error::StoreError;
pub use memory_available::{available_bytes, available_mb};
pub use memory_demand::{MemoryDemandError, check_memory, check_sweep_memory};
pub use result_files::ResultFiles;

/// Folder of the cases of a plan or a study, each a result of its own, within that of the whole.
pub const CASES: &str = "cases";
