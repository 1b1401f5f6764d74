//! `ale-gear gearbox`: shafts, bearings and several meshes at rest, and in motion where the file asks for it.

use std::path::PathBuf;

use analysis::gearbox_at_rest::{GearboxResult, solve_gearbox};
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
        let missed = missed(&result);
        let said: Vec<String> = missed.iter().map(|[what, _]| what.clone()).collect();
        let failed = (!said.is_empty()).then(|| said.join("; "));
        gearbox_page(&file, &result, &cost, failed.as_deref())?.write(&results)?;
        // Last of all, so that a summary means that everything is there.
        let files = results.files()?;
        results.write("summary.json", gearbox_summary(&file, &result, &cost, &files, &said).as_bytes())?;
        results.finish(talk::note)?;
        let table = gearbox_table(&file, &result, &cost);
        let first = missed.into_iter().next();
        let failure = first
            .map(|[what, hint]| CommandError::failed(format_args!("the result does not hold: {what}"), Some(hint)));
        let text = if quiet { String::new() } else { format!("{table}\nresults: {}\n", self.out.display()) };
        Ok(Answer { text, failure })
    }
}

/// What does not hold, each with what to do about it.
fn missed(result: &GearboxResult) -> Vec<[String; 2]> {
    let mut all = Vec::new();
    let mut say = |what: String, hint: &str| all.push([what, hint.to_owned()]);
    if let Some(share) = result.certificate.into_iter().find(|share| share.is_nan() || *share > BALANCE) {
        let hint = "are bearings and shafts many decades stiffer than the teeth? `held` is rigid";
        say(format!("{share:.1e} of the load is left over"), hint);
    }
    let Some(motion) = &result.motion else { return all };
    let (left, beyond) = (motion.energy.relative_residual.abs(), motion.reach.iter().copied().fold(0.0, f64::max));
    if left.is_nan() || left > ENERGY {
        let what = format!("{left:.1e} of the energy of the motion comes from nowhere");
        say(what, "take more `steps_per_cycle`, or `method = \"energy\"`");
    }
    if beyond > 1.0 {
        let what = format!("the motion goes {beyond:.2} times as far as the maps of the contact hold");
        say(what, "take `mesh = \"exact\"`, or let it run with more damping");
    }
    let off = motion.reduction.error;
    if off.is_nan() || off > FREQUENCIES {
        let what = format!("natural frequencies of the reduced shafts are off by {off:.1e}");
        say(what, "state a lower or higher `highest_frequency_hz`: modes up to twice that are kept");
    }
    all
}
