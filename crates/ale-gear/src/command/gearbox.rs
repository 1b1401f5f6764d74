//! `ale-gear gearbox`: shafts, bearings and several meshes at rest.

use std::path::PathBuf;

use analysis::gearbox_at_rest::solve_gearbox;
use report::gearbox_files::{gearbox_page, gearbox_summary, gearbox_table, write_gearbox_rows};
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

/// Share of loads that may be left over, and of forces on a body.
const BALANCE: f64 = 1e-6;

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
        write_gearbox_rows(&file, &result, &results)?;
        let cost = phases.cost();
        let missed = result.certificate.into_iter().find(|share| share.is_nan() || *share > BALANCE);
        let missed = missed.map(|share| format!("{share:.1e} of the load is left over"));
        gearbox_page(&file, &result, &cost, missed.as_deref())?.write(&results)?;
        // Last of all, so that a summary means that everything is there.
        let files = results.files()?;
        results.write("summary.json", gearbox_summary(&file, &result, &cost, &files).as_bytes())?;
        results.finish(talk::note)?;
        let table = gearbox_table(&file, &result, &cost);
        let failure = missed.map(|what| {
            let hint = "are bearings and shafts many decades stiffer than the teeth? `held` is rigid".to_owned();
            CommandError::failed(format_args!("the result does not hold: {what}"), Some(hint))
        });
        let text = if quiet { String::new() } else { format!("{table}\nresults: {}\n", self.out.display()) };
        Ok(Answer { text, failure })
    }
}
