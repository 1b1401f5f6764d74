//! `ale-gear gearbox`: shafts, bearings and several meshes at rest, and in motion where the file asks for it.

use std::path::PathBuf;

use analysis::gearbox_at_rest::{GearboxMotionResult, solve_gearbox};
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
/// Energy that may come from nowhere, over the work of all.
const ENERGY: f64 = 1e-3;
/// Error of the natural frequencies of reduced shafts.
const FREQUENCIES: f64 = 0.03;

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
        let failure = failure.or_else(|| result.motion.as_ref().and_then(motion_failure));
        let text = if quiet { String::new() } else { format!("{table}\nresults: {}\n", self.out.display()) };
        Ok(Answer { text, failure })
    }
}

/// Why the rows of a motion do not hold.
fn motion_failure(motion: &GearboxMotionResult) -> Option<CommandError> {
    let (left, beyond) = (motion.energy.relative_residual.abs(), motion.reach.iter().copied().fold(0.0, f64::max));
    let off = motion.reduction.error;
    let failed = |what: String, hint: &str| Some(CommandError::failed(what, Some(hint.to_owned())));
    if left.is_nan() || left > ENERGY {
        let what = format!("the motion does not hold: {left:.1e} of the energy comes from nowhere");
        return failed(what, "take more `steps_per_cycle`, or `method = \"energy\"`");
    }
    if beyond > 1.0 {
        let what = format!("the motion goes {beyond:.2} times as far as the maps of the contact hold");
        return failed(what, "take `mesh = \"exact\"`, or let it run with more damping");
    }
    if off > FREQUENCIES {
        let what = format!("natural frequencies of the reduced shafts are off by {off:.1e}");
        return failed(what, "state a lower or higher `highest_frequency_hz`: modes up to twice that are kept");
    }
    None
}
