//! A result as a folder: there as a whole or not at all.
//!
//! | module | what it does |
//! |---|---|
//! | `result_directory` | a result while it grows, and as it takes its place |
//! | `record` | by what a result is known; nothing else is ever replaced |
//! | `names` | which files a result may hold |
//! | `kept_cases` | cases of a study that are done, beside its results |
//! | `gear_cache` | reduced gears and maps from run to run |

mod gear_cache;
mod kept_cases;
mod names;
mod record;
mod result_directory;

pub use gear_cache::Cache;
pub use kept_cases::{KeptCases, beside_results, in_use};
pub use result_directory::ResultDirectory;
