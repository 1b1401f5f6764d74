//! `ale-gear vary`: a scene with keys varied, a row a case.

use std::{ops::Range, path::PathBuf};

use analysis::SharedModels;
use report::{
    folder::{Cache, Partial},
    plan_files::{DoneCases, plan_digest, solve_cases, write_cases},
};
use scene::plan::{Plan, PlanWords};

use super::{cache_args::CacheArgs, overrides::Overrides, run::write_result};
use crate::{error::CommandError, output::ResultDirectory, phases::Phases, resolution::with_slices, study_cases, talk};

/// Words of `ale-gear vary`.
#[derive(Debug, clap::Args)]
pub(super) struct VaryArgs {
    /// Plan file; or a scene file, with `--vary` and `--output`
    plan: PathBuf,
    /// Folder for the results; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// A key and its values: `KEY=1,2,5`, `KEY=0:40:9` (nine), `KEY~0:40` (drawn), `KEY~normal:0:5`; may be given again
    #[arg(long, value_name = "WORDS")]
    vary: Vec<String>,
    /// A number of the headline of `summary.json` that is wanted; may be given again
    #[arg(long, value_name = "KEY")]
    output: Vec<String>,
    /// How samples of what is drawn are spread: latin-hypercube, sobol or random [default: latin-hypercube]
    #[arg(long, value_name = "NAME")]
    design: Option<String>,
    /// How many samples of what is drawn [default: 100]
    #[arg(long, value_name = "N")]
    samples: Option<u32>,
    /// Other samples for another seed [default: 1]
    #[arg(long, value_name = "N")]
    seed: Option<u32>,
    #[command(flatten)]
    overrides: Overrides,
    #[command(flatten)]
    cache: CacheArgs,
}

impl VaryArgs {
    /// Every complaint about the words and the plan is made here, before any work starts or any file is written.
    fn plan(&self) -> Result<Plan, CommandError> {
        let Self { vary, output, design, samples, seed, .. } = self;
        let settings = self.overrides.settings()?;
        let refuse = |what: &str, hint: &str| Err(CommandError::input(what, Some(hint.into())));
        if !vary.is_empty() && !output.is_empty() {
            let design = design.as_deref();
            let words = PlanWords { vary, outputs: output, design, samples: *samples, seed: *seed };
            return Ok(Plan::of_words(&self.plan, &settings, &words)?);
        }
        if !vary.is_empty() || !output.is_empty() {
            return refuse(
                "a scene is varied by `--vary`, and `--output` says what is wanted of each case",
                "as `--vary 'operation.torque_nm=50:200:7' --output peak_to_peak_ste_um`; or give a plan file",
            );
        }
        if !settings.is_empty() || design.is_some() || samples.is_some() || seed.is_some() {
            let hint = "write them into the plan, or give a scene file with `--vary` and `--output`";
            return refuse("a plan file says keys, samples and seed itself", hint);
        }
        Ok(Plan::read(&self.plan)?)
    }

    /// Runs the cases that are not done yet; the text is the closing table.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let (plan, mut phases) = (self.plan()?, Phases::with_bars());
        let results = ResultDirectory::create(&self.out)?;
        // Beside the results, so that a run that is cut short goes on from there.
        let mut name = self.out.file_name().unwrap_or_default().to_owned();
        name.push(".cases");
        let done_file = self.out.with_file_name(name);
        let complain = |e: std::io::Error| CommandError::write(&done_file, &e);
        let done = DoneCases::open(&done_file, &plan_digest(&plan)?).map_err(complain)?;
        let (count, before) = (plan.cases.count(), done.count());
        if before > 0 {
            talk::note(format!("{before} of {count} cases were done before"));
        }
        let cache = self.cache.open();
        solve_range(&plan, 0..count, &mut phases, &cache, &done).map_err(complain)?;
        let text = write_cases(&plan, &done, &phases.cost(), &results)?;
        results.finish(talk::note)?;
        done.remove().map_err(complain)?;
        Ok(format!("{text}\nresults: {}\n", self.out.display()))
    }
}

/// Solves the cases of a range that are not done yet.
pub(super) fn solve_range(
    plan: &Plan,
    range: Range<usize>,
    phases: &mut Phases,
    cache: &Cache,
    done: &DoneCases,
) -> std::io::Result<()> {
    let scratch = Partial::new(std::env::temp_dir().join(format!("ale-gear-cases-{}", std::process::id())));
    let in_time = |case: usize, scene: &_| {
        let folder = scratch.path().join(case.to_string());
        let solve = |own: &_| write_result(&with_slices(Clone::clone(scene)), &mut Phases::quiet(), own, cache);
        study_cases::numbers(&folder, solve).map_err(|e| e.message)
    };
    let open = range.clone().filter(|&case| !done.has(case)).count();
    phases.run_steps("cases", open as u64, |progress| {
        solve_cases((plan, range), &SharedModels::new(cache), &in_time, done, &|| progress.tick())
    })
}
