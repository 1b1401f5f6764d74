//! Every case alone: a row of wanted numbers a case.

use std::{ops::Range, path::Path, sync::Arc};

use analysis::{NoObserver, Observer, PhaseWork, Progress, SharedModels};
use plan::{CaseLines, DoneCases, KnownCases, check_outputs, columns_of, plan_digest, rows_file, solve_cases};
use report::{
    Written,
    plan_files::{PageWords, write_cases},
};
use scene::{
    Document,
    plan::{Plan, PlanOutput, PlanTake, PlanWords},
    study::{Take, column_advice},
};
use store::folder::{Cache, beside_results};

use super::{
    super::{Answer, case_reports::CaseReports, plan_case::sliced},
    DrawnArgs, VaryArgs,
};
use crate::{
    error::CommandError,
    output::ResultDirectory,
    phases::Phases,
    scene::Setting,
    talk::{self, Verbosity},
};

/// Torques of a Harris map over the scene's: the first, the last, how many.
const HARRIS: (f64, f64, u32) = (0.1, 1.4, 14);

/// What is taken of a column where `--of` names one.
const TAKES: [PlanTake; 4] =
    [PlanTake::Of(Take::Mean), PlanTake::Of(Take::PeakToPeak), PlanTake::Of(Take::Least), PlanTake::Of(Take::Largest)];

impl VaryArgs {
    /// Words that go with cases that are alone.
    const EACH: [&str; 10] = [
        "--vary",
        "--output",
        "--of",
        "--harris",
        "--design",
        "--samples",
        "--seed",
        "--reports",
        "--report-case",
        "--json",
    ];

    /// Every complaint about the words and the plan is made here, before any work starts or any file is written.
    pub(super) fn plan(&self) -> Result<Plan, CommandError> {
        let DrawnArgs { design, samples, seed } = &self.drawn;
        let settings = self.overrides.settings()?;
        let refuse = |what: &str, hint: &str| Err(CommandError::input(what, Some(hint.into())));
        let (mut vary, mut outputs) = (self.vary.clone(), self.output.clone());
        let document = Document::read(&self.file)?;
        if self.harris {
            let scene = document.scene(&settings)?;
            vary.push(harris_axis(scene.operation.torque_nm));
            outputs.insert(0, "peak_to_peak_ste_um".into());
        }
        let columns = self.outputs_of_column(&document, &settings)?;
        let asks = !outputs.is_empty() || !columns.is_empty();
        if !vary.is_empty() && asks {
            let design = design.as_deref();
            let words =
                PlanWords { vary: &vary, outputs: &outputs, columns: &columns, design, samples: *samples, seed: *seed };
            return Ok(Plan::of_scene(document, &settings, &words)?);
        }
        if !vary.is_empty() || asks {
            return refuse(
                "a scene is varied by `--vary`, and `--output` says what is wanted of each case",
                "as `--vary 'operation.torque_nm=50:200:7' --output peak_to_peak_ste_um` of a pair, `--vary 'torque.0.torque_nm=50:200:7' --output peak_to_peak_ste_um.0` of a gearbox; or give a plan file",
            );
        }
        if design.is_some() || samples.is_some() || seed.is_some() {
            let hint = "write them into the plan, or give a scene file with `--vary` and `--output`";
            return refuse("a plan file says samples and seed itself", hint);
        }
        Ok(Plan::of(&document, &settings)?)
    }

    /// What is wanted of the column that `--of` names.
    fn outputs_of_column(&self, document: &Document, settings: &[Setting]) -> Result<Vec<PlanOutput>, CommandError> {
        let Some(column) = &self.of else { return Ok(Vec::new()) };
        let machine = sliced(document.machine(settings)?);
        if let Some(all) = columns_of(&machine).filter(|all| !all.iter().any(|name| name == column)) {
            let names: Vec<&str> = all.iter().map(String::as_str).collect();
            let what = format_args!("`--of {column}` is not a column of {}", rows_file(&machine));
            return Err(CommandError::input(what, column_advice(column, &names)));
        }
        Ok(TAKES.map(|take| PlanOutput::Column { column: column.clone(), take }).into())
    }

    /// The command that makes it again.
    fn again(&self) -> String {
        let mut words = format!("ale-gear vary {} --out DIR", self.file.display());
        let mut add = |word: String| words.push_str(&format!(" {word}"));
        if self.harris {
            add("--harris".into());
        }
        self.vary.iter().for_each(|word| add(format!("--vary '{word}'")));
        self.output.iter().for_each(|key| add(format!("--output {key}")));
        self.of.iter().for_each(|column| add(format!("--of {column}")));
        self.drawn.design.iter().for_each(|name| add(format!("--design {name}")));
        self.drawn.samples.iter().for_each(|n| add(format!("--samples {n}")));
        self.drawn.seed.iter().for_each(|n| add(format!("--seed {n}")));
        self.overrides.settings().unwrap_or_default().iter().for_each(|setting| add(setting.word()));
        words + &self.reports.words()
    }

    /// Runs the cases that are not done yet.
    pub(super) fn each(&self, quiet: bool) -> Result<Answer, CommandError> {
        self.only(&Self::EACH, "cases that are run each alone")?;
        let plan = self.plan()?;
        let out = self.folder()?;
        let table = run_plan(&plan, (out, &self.again()), &self.reports, &self.cache.open())?;
        Answer::of_folder(out, (table, None), (self.json, quiet))
    }
}

/// The torques of a Harris map as an axis.
fn harris_axis(torque_nm: f64) -> String {
    let (from, to, count) = HARRIS;
    format!("operation.torque_nm={}:{}:{count}", from * torque_nm, to * torque_nm)
}

/// Runs the cases of a plan into a folder, those that are not done yet; `again` makes it again, the text is the closing
/// table.
fn run_plan(
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
    let Written { answer, table } = write_cases((plan, &done), words, phases.cost(), &results)?;
    results.finish(talk::note)?;
    done.remove().map_err(complain)?;
    match (answer.checks.failed(), known.reasons.first()) {
        (Some(_), Some(why)) => {
            let hint = format!("`cases.csv` in {} says of each case why", out.display());
            Err(CommandError::failed(format_args!("no case has a result; the first: {why}"), Some(hint)))
        }
        _ => Ok(table),
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
        talk::say(Verbosity::Bars, || format!("ale-gear: {message}"));
    }
}
