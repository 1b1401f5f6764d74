//! A result as a folder: there as a whole or not at all.
//!
//! | module | what it does |
//! |---|---|
//! | `result_directory` | which files a result may hold; never replaces what this program did not write |
//! | `gear_cache` | reduced gears and maps from run to run |
//! | `work_folder` | the folder beside it in which it grows, and those of killed processes |
//! | `partial` | paths that are taken away unless they become whole |

mod gear_cache;
mod partial;
mod result_directory;
mod work_folder;

pub use gear_cache::Cache;
pub use partial::{Partial, remove_partial_paths};
pub use result_directory::ResultDirectory;
