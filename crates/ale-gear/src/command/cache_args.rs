//! Words about the cache, the same for every command that reduces gears.

use std::path::PathBuf;

use store::folder::Cache;

/// Which cache is used.
#[derive(Debug, Clone, Default, clap::Args)]
pub(super) struct CacheArgs {
    /// Folder of reduced gears [default: the user's cache folder]
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
    /// Do not read or write the folder of reduced gears
    #[arg(long, conflicts_with = "cache")]
    no_cache: bool,
}

impl CacheArgs {
    /// The cache that the words name.
    pub(super) fn open(&self) -> Cache {
        match &self.cache {
            _ if self.no_cache => Cache::off(),
            Some(folder) => Cache::in_folder(folder.clone()),
            None => Cache::of_user(),
        }
    }
}
