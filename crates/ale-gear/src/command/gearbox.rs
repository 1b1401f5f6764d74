//! `ale-gear gearbox`: shafts, bearings and several meshes at rest, and in motion where the file asks for it.

use std::path::PathBuf;

use analysis::gearbox_at_rest::solve_gearbox;
use report::gearbox_files::write_gearbox;
use scene::gearbox::Gearbox;

use super::{Answer, cache_args::CacheArgs};
use crate::{error::CommandError, output::ResultDirectory, phases::Phases, scene::SceneError, talk};

/// Words of `ale-gear gearbox`.
#[derive(Debug, clap::Args)]
pub(super) struct GearboxArgs {
    /// Gearbox file
    gearbox: PathBuf,
    /// Folder for the results; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    cache: CacheArgs,
}

impl GearboxArgs {
    /// Solves the gearbox; the text is the closing table.
    pub(super) fn execute(self, quiet: bool) -> Result<Answer, CommandError> {
        let file = Gearbox::read(&self.gearbox).map_err(|e| match &e {
            SceneError::Read { .. } => CommandError::input(
                &e,
                Some("`ale-gear gearbox BOX.toml --out DIR` wants the path of a gearbox file".into()),
            ),
            _ => e.into(),
        })?;
        let mut phases = Phases::with_bars();
        let results = ResultDirectory::create(&self.out)?;
        let result = solve_gearbox(&file, &self.cache.open(), &mut phases)?;
        let table = write_gearbox(&file, &result, phases.cost(), &results)?;
        results.finish(talk::note)?;
        let failure = result.verdict(&file).err().map(CommandError::from);
        let text = if quiet { String::new() } else { format!("{table}\nresults: {}\n", self.out.display()) };
        Ok(Answer { text, failure })
    }
}
