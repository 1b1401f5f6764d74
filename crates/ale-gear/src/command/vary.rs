//! `ale-gear vary`: a scene with keys varied, a row a case.

use std::{
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
};

use analysis::{NoObserver, Observer, PhaseWork, Progress, SharedModels};
use report::{
    folder::{Cache, beside_results},
    plan_files::{CaseLines, DoneCases, KnownCases, PageWords, check_outputs, plan_digest, solve_cases, write_cases},
};
use scene::{
    Document,
    plan::{Plan, PlanWords},
};

use super::{cache_args::CacheArgs, case_reports::CaseReports, overrides::Overrides};
use crate::{
    error::CommandError,
    output::ResultDirectory,
    phases::Phases,
    talk::{self, Loudness},
};

/// Words of `ale-gear vary`.
#[derive(Debug, clap::Args)]
pub(super) struct VaryArgs {
    /// Plan file; or a scene file, with `--vary` and `--output`, or `--harris`
    plan: PathBuf,
    /// Folder for the results; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// A key and its values: `KEY=1,2,5`, `KEY=0:40:9` (nine), `KEY~0:40` (drawn), `KEY~normal:0:5`, `KEY~iso1328:6` (a
    /// tolerance class); several keys with the same value: `KEY+KEY=1,2,5`; may be given again
    #[arg(long, value_name = "WORDS")]
    vary: Vec<String>,
    /// A number of the headline of `summary.json` that is wanted; may be given again
    #[arg(long, value_name = "KEY")]
    output: Vec<String>,
    /// Harris map: peak-to-peak STE over the torque, from a tenth of the scene's to 1.4 times it; a curve for each value
    /// of what `--vary` names beside
    #[arg(long)]
    harris: bool,
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
    reports: CaseReports,
    #[command(flatten)]
    overrides: Overrides,
    #[command(flatten)]
    cache: CacheArgs,
}

/// Torques of a Harris map over the scene's: the first, the last, how many.
const HARRIS: (f64, f64, u32) = (0.1, 1.4, 14);

impl VaryArgs {
    /// Every complaint about the words and the plan is made here, before any work starts or any file is written.
    fn plan(&self) -> Result<Plan, CommandError> {
        let Self { design, samples, seed, .. } = self;
        let settings = self.overrides.settings()?;
        let refuse = |what: &str, hint: &str| Err(CommandError::input(what, Some(hint.into())));
        let (mut vary, mut outputs) = (self.vary.clone(), self.output.clone());
        let document = Document::read(&self.plan)?;
        if self.harris {
            let scene = document.scene(&settings)?;
            vary.push(harris_axis(scene.operation.torque_nm));
            outputs.insert(0, "peak_to_peak_ste_um".into());
        }
        if !vary.is_empty() && !outputs.is_empty() {
            let design = design.as_deref();
            let words = PlanWords { vary: &vary, outputs: &outputs, design, samples: *samples, seed: *seed };
            return Ok(Plan::of_scene(document, &settings, &words)?);
        }
        if !vary.is_empty() || !outputs.is_empty() {
            return refuse(
                "a scene is varied by `--vary`, and `--output` says what is wanted of each case",
                "as `--vary 'operation.torque_nm=50:200:7' --output peak_to_peak_ste_um`; or give a plan file",
            );
        }
        if !settings.is_empty() || design.is_some() || samples.is_some() || seed.is_some() {
            let hint = "write them into the plan, or give a scene file with `--vary` and `--output`";
            return refuse("a plan file says keys, samples and seed itself", hint);
        }
        Ok(Plan::of(&document)?)
    }

    /// The command that makes it again.
    fn again(&self, plan: &Plan) -> String {
        let mut words = format!("ale-gear vary {} --out DIR", self.plan.display());
        let mut add = |word: String| words.push_str(&format!(" {word}"));
        if self.harris {
            add("--harris".into());
        }
        self.vary.iter().for_each(|word| add(format!("--vary '{word}'")));
        self.output.iter().for_each(|key| add(format!("--output {key}")));
        self.design.iter().for_each(|name| add(format!("--design {name}")));
        self.samples.iter().for_each(|n| add(format!("--samples {n}")));
        self.seed.iter().for_each(|n| add(format!("--seed {n}")));
        // Those of a file stand in it.
        if self.harris || !self.vary.is_empty() {
            plan.settings.iter().for_each(|setting| add(setting.word()));
        }
        words + &self.reports.words()
    }

    /// Runs the cases that are not done yet; the text is the closing table.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let plan = self.plan()?;
        run_plan(&plan, (&self.out, &self.again(&plan)), &self.reports, &self.cache.open())
    }
}

/// The torques of a Harris map as an axis.
fn harris_axis(torque_nm: f64) -> String {
    let (from, to, count) = HARRIS;
    format!("operation.torque_nm={}:{}:{count}", from * torque_nm, to * torque_nm)
}

/// Runs the cases of a plan into a folder, those that are not done yet; `again` makes it again, the text is the closing
/// table.
pub(super) fn run_plan(
    plan: &Plan,
    (out, again): (&Path, &str),
    reports: &CaseReports,
    cache: &Cache,
) -> Result<String, CommandError> {
    reports.check(plan)?;
    check_outputs(plan).map_err(|e| CommandError::input(&e, Some(e.hint.clone())))?;
    let mut phases = Phases::with_bars();
    let results = ResultDirectory::create(out)?;
    // Beside the results, so that a run that is cut short goes on from there.
    let done_file = beside_results(out);
    let complain = |e: std::io::Error| CommandError::write(&done_file, &e);
    let done = DoneCases::open(out, &plan_digest(plan), CaseLines::of(plan))?;
    let (count, before) = (plan.cases.count(), done.count());
    if before > 0 {
        talk::note(format!("{before} of {count} cases were done before"));
    }
    solve_range(plan, 0..count, &mut phases, cache, &done).map_err(complain)?;
    let known = KnownCases::of(plan, &done.all());
    let written = reports.write((plan, &known), &mut phases, &results, cache)?;
    let words = PageWords { again, reports: &written };
    let text = write_cases((plan, &done), words, phases.cost(), &results)?.table;
    results.finish(talk::note)?;
    done.remove().map_err(complain)?;
    match known.reasons.first() {
        Some(why) if known.failed == known.count() => {
            let hint = format!("`cases.csv` in {} says of each case why", out.display());
            Err(CommandError::failed(format_args!("no case has a result; the first: {why}"), Some(hint)))
        }
        _ => Ok(format!("{text}\nresults: {}\n", out.display())),
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
    let open = range.clone().filter(|&case| !done.has(case)).count();
    phases.run_steps("cases", open as u64, |progress| {
        solve_cases((plan, range), &SharedModels::new(cache), &|| Box::new(Notes), done, progress)
    })
}

/// Says what those who wait for a case should hear before its end.
struct Notes;

impl Observer for Notes {
    fn begin(&mut self, _: &str, _: PhaseWork) -> Arc<dyn Progress> {
        Arc::new(NoObserver)
    }

    fn end(&mut self) {}

    fn note(&mut self, message: String) {
        talk::say(Loudness::Bars, || format!("ale-gear: {message}"));
    }
}
