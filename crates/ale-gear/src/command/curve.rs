//! `ale-gear curve`: the periodic motions of a scene along a key, stable and unstable.

use std::path::PathBuf;

use super::{Answer, cache_args::CacheArgs, overrides::Overrides, run::RunArgs};
use crate::error::CommandError;

/// Words of `ale-gear curve`.
#[derive(Debug, clap::Args)]
pub(super) struct CurveArgs {
    /// Scene file, taken as one of a motion, with the model mapped, reduced, lumped8, lumped12 or shaft18
    scene: PathBuf,
    /// Folder for the results; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// The key along which motions are followed
    #[arg(long, default_value = "operation.speed_rpm")]
    key: String,
    /// Its value where the curve begins
    #[arg(long, value_name = "X")]
    from: f64,
    /// Its value where the curve ends
    #[arg(long, value_name = "X")]
    to: f64,
    /// The summary as JSON on stdout, instead of the closing table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overrides: Overrides,
    #[command(flatten)]
    cache: CacheArgs,
}

impl CurveArgs {
    /// Follows the curve: a run of the scene as a continuation.
    pub(super) fn execute(self, quiet: bool) -> Result<Answer, CommandError> {
        let words = [
            "analysis.kind=dynamic".to_owned(),
            "motion.run=continuation".to_owned(),
            format!("motion.continuation.key={}", self.key),
            format!("motion.continuation.from={}", self.from),
            format!("motion.continuation.to={}", self.to),
        ];
        let words = (self.overrides.behind(words), self.cache);
        RunArgs::of_file([self.scene, self.out], words, self.json).execute(quiet)
    }
}
