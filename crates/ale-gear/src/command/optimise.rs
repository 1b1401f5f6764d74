//! `ale-gear optimise`: the micro-geometry that is quietest.

use std::{ops::ControlFlow, path::PathBuf};

use analysis::{
    NoObserver, PhaseWork, SharedModels,
    optimum::{Evaluated, Optimised, Optimum, optimise, summarise},
    run_phase,
};
use plan::{CaseLines, DoneCases, OptimumError, check_numbers, goal_unit, numbers_digest, optimise_numbers};
use report::optimum_files::{NumberOptimumResult, OptimumResult, passed_limits, write_number_optimum, write_optimum};
use scene::{
    Document, DocumentKind,
    optimum::{DesignParameter, NumberOptimisation, Optimisation, OptimisationWords},
};
use store::folder::beside_results;

use super::{Answer, FileWords, cache_args::CacheArgs, overrides::Overrides};
use crate::{
    error::CommandError,
    output::ResultDirectory,
    phases::Phases,
    talk::{self, Verbosity, say},
};

/// Tells what was evaluated, with its goal.
fn tell(which: Evaluated, goal: Option<String>) {
    let goal = goal.unwrap_or_else(|| "no result".into());
    say(Verbosity::Bars, || format!("ale-gear: {which}: {}", goal.trim_end()));
}

/// Words of `ale-gear optimise`.
#[derive(Debug, clap::Args)]
pub(super) struct OptimiseArgs {
    /// Optimisation file, or a scene file
    file: PathBuf,
    /// Folder for the results, created when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// Key to change within bounds, `KEY=FROM:TO`, starting at the scene's value; repeatable [default: tip reliefs,
    /// their starts, lead crowning]
    #[arg(long, value_name = "WORDS", allow_hyphen_values = true)]
    vary: Vec<String>,
    /// Torques to optimise for, N m, comma-separated; for a gearbox those of the first `[[torque]]`, others in
    /// proportion [default: the document's]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    torques: Vec<f64>,
    /// Number of the headline to minimise instead of the transmission error, e.g. `face_load_factor.0`; of several
    /// numbers the mean absolute value
    #[arg(long, value_name = "KEY", conflicts_with_all = ["measure", "max_pressure", "max_edge_pressure", "front"])]
    goal: Vec<String>,
    /// Limit of a number of the headline, with `--goal`; repeatable
    #[arg(long, value_name = "KEY=MOST", requires = "goal")]
    limit: Vec<String>,
    /// Measure of the transmission error: peak-to-peak, rms or harmonics (the first) [default: peak-to-peak]
    #[arg(long, value_name = "NAME")]
    measure: Option<String>,
    /// Limit of the contact pressure, MPa
    #[arg(long, value_name = "MPA")]
    max_pressure: Option<f64>,
    /// Limit of the contact pressure at end faces and tip edges, MPa
    #[arg(long, value_name = "MPA")]
    max_edge_pressure: Option<f64>,
    /// Maximum number of evaluations [default: 20]
    #[arg(long, value_name = "N")]
    evaluations: Option<u32>,
    /// Number of points of the trade-off against pressure [default: none]
    #[arg(long, value_name = "N")]
    front: Option<u32>,
    /// Print the summary as JSON instead of the closing table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overrides: Overrides,
    #[command(flatten)]
    cache: CacheArgs,
}

impl OptimiseArgs {
    /// An optimisation file into a folder.
    pub(super) fn of_file(FileWords { file, out, overrides, cache, json }: FileWords) -> Self {
        let (vary, torques, measure, max_pressure, max_edge_pressure) = (Vec::new(), Vec::new(), None, None, None);
        let (evaluations, front) = (None, None);
        Self {
            file,
            out,
            vary,
            torques,
            goal: Vec::new(),
            limit: Vec::new(),
            measure,
            max_pressure,
            max_edge_pressure,
            evaluations,
            front,
            json,
            overrides,
            cache,
        }
    }

    /// What the words say.
    fn words(&self) -> OptimisationWords<'_> {
        OptimisationWords {
            parameters: &self.vary,
            torques_nm: &self.torques,
            measure: self.measure.as_deref(),
            max_pressure_mpa: self.max_pressure,
            max_edge_pressure_mpa: self.max_edge_pressure,
            goals: &self.goal,
            limits: &self.limit,
            evaluations: self.evaluations.unwrap_or(20),
            front: self.front.unwrap_or(0),
        }
    }

    /// Refuses words beside a file that says everything.
    fn says_all_itself(&self) -> Result<(), CommandError> {
        let Self { vary, torques, measure, max_pressure, evaluations, front, goal, limit, .. } = self;
        let words = !vary.is_empty() || !torques.is_empty() || measure.is_some() || max_pressure.is_some();
        let words = words || self.max_edge_pressure.is_some() || evaluations.is_some() || front.is_some();
        if words || !goal.is_empty() || !limit.is_empty() {
            let hint = "write it into [optimise], or give a scene file without it";
            return Err(CommandError::input("an optimisation file says everything itself", Some(hint.into())));
        }
        Ok(())
    }

    /// Every complaint about the words and the files is made here, before any work starts or any file is written.
    fn plan(&self, document: Document) -> Result<Optimisation, CommandError> {
        let settings = self.overrides.settings()?;
        if Optimisation::is_one(&document).0 {
            self.says_all_itself()?;
            return Ok(Optimisation::of(&document, &settings)?);
        }
        if document.base_kind() == Some(DocumentKind::Gearbox) {
            let message = format_args!("{}: of a gearbox a number of its headline is made small", self.file.display());
            let hint = "as `--goal face_load_factor.0 --vary 'mesh.0.scene.pinion.modification.lead_slope_um=-30:30'`";
            return Err(CommandError::input(message, Some(hint.into())));
        }
        Ok(Optimisation::of_scene(document, &settings, &self.words())?)
    }

    /// The words that make it again.
    fn again(&self) -> String {
        let Self { file, vary, torques, measure, max_pressure, evaluations, front, .. } = self;
        let mut words = vec![format!("ale-gear optimise {} --out DIR", file.display())];
        words.extend(vary.iter().map(|word| format!("--vary '{word}'")));
        if !torques.is_empty() {
            let list: Vec<String> = torques.iter().map(f64::to_string).collect();
            words.push(format!("--torques {}", list.join(",")));
        }
        words.extend(self.goal.iter().map(|key| format!("--goal {key}")));
        words.extend(self.limit.iter().map(|word| format!("--limit {word}")));
        words.extend(measure.iter().map(|word| format!("--measure {word}")));
        words.extend(max_pressure.iter().map(|limit| format!("--max-pressure {limit}")));
        words.extend(self.max_edge_pressure.iter().map(|limit| format!("--max-edge-pressure {limit}")));
        words.extend(evaluations.iter().map(|n| format!("--evaluations {n}")));
        words.extend(front.iter().map(|n| format!("--front {n}")));
        words.extend(self.overrides.settings().unwrap_or_default().iter().map(scene::Setting::word));
        words.join(" ")
    }

    /// Searches, and writes the results; the text is the closing table.
    pub(super) fn execute(self, quiet: bool) -> Result<Answer, CommandError> {
        // What cannot be read is complained about as a scene is.
        let document = Document::read(&self.file)?;
        let (is_file, of_numbers) = Optimisation::is_one(&document);
        if !self.goal.is_empty() || of_numbers {
            return self.numbers(&document, is_file, quiet);
        }
        let (plan, mut phases) = (self.plan(document)?, Phases::with_bars());
        plan.parameters.iter().filter_map(DesignParameter::begins_elsewhere).for_each(talk::note);
        let results = ResultDirectory::create(&self.out)?;
        let cache = self.cache.open();
        let models = SharedModels::new(&cache);
        // It ends when it has converged, nobody knows when; the last one is that of values that a machine can be set to.
        let most = u64::from(plan.evaluations) + 1;
        let work = if plan.front > 0 { PhaseWork::Unknown } else { PhaseWork::AtMost(most) };
        let optimum: Optimum = run_phase(&mut phases, "search", work, |progress| {
            optimise(&models, &plan, |which, goal| {
                progress.tick();
                tell(which, goal.map(|goal| format!("{goal:.4} um")));
                ControlFlow::Continue(())
            })
        })?;
        let summary: Optimised = phases.run("results", || summarise(&models, &optimum))?;
        let scene = optimum.plan.own_scene(&optimum.values)?.standing_alone();
        let again = self.again();
        let of = OptimumResult { optimum: &optimum, summary: &summary, scene: &scene, again: &again };
        let text = write_optimum(&of, phases.cost(), &results)?.table;
        results.finish(talk::note)?;
        let hint = "raise the limit, add parameters, or widen their bounds (`--vary`)";
        let failure = passed_limits(&optimum)
            .map(|what| CommandError { status: 3, ..CommandError::failed(what, Some(hint.into())) });
        Answer::of_folder(&self.out, (text, failure), (self.json, quiet))
    }

    /// Optimises numbers of a headline; what is solved is kept beside the results until they are complete.
    fn numbers(&self, document: &Document, is_file: bool, quiet: bool) -> Result<Answer, CommandError> {
        let settings = self.overrides.settings()?;
        let plan = if is_file {
            self.says_all_itself()?;
            NumberOptimisation::of(document, &settings)?
        } else {
            NumberOptimisation::of_scene(document.clone(), &settings, &self.words())?
        };
        let checked = check_numbers(&plan.machine(&plan.start())?, &plan.outputs(), &self.file);
        checked.map_err(|e| CommandError::input(&e, Some(e.hint.clone())))?;
        plan.parameters.iter().filter_map(DesignParameter::begins_elsewhere).for_each(talk::note);
        let mut phases = Phases::with_bars();
        let results = ResultDirectory::create(&self.out)?;
        let done_file = beside_results(&self.out);
        let complain = |e: std::io::Error| CommandError::write(&done_file, &e);
        let lines = CaseLines::new(plan.parameters.len(), plan.goals.len() + plan.limits.len());
        let done = DoneCases::open(&self.out, &numbers_digest(&plan), lines)?;
        if done.count() > 0 {
            talk::note(format!("{} designs were solved before", done.count()));
        }
        let cache = self.cache.open();
        let models = SharedModels::new(&cache);
        let most = u64::from(plan.evaluations) + 1;
        let unit = goal_unit(&plan);
        let optimum = run_phase(&mut phases, "search", PhaseWork::AtMost(most), |progress| {
            optimise_numbers(&plan, &models, &|| Box::new(NoObserver), &done, |which, goal| {
                progress.tick();
                tell(which, goal.map(|goal| format!("{goal:.6} {unit}")));
                ControlFlow::Continue(())
            })
        });
        let optimum = optimum.map_err(|e| match e {
            OptimumError::Write(e) => complain(e),
            e => CommandError::failed(&e, Some("try it by itself: `ale-gear run` with the same words".into())),
        })?;
        let again = self.again();
        let of = NumberOptimumResult { plan: &plan, optimum: &optimum, again: &again };
        let text = write_number_optimum(&of, phases.cost(), &results)?.table;
        results.finish(talk::note)?;
        done.remove().map_err(complain)?;
        let hint = "raise the limit, add parameters, or widen their bounds (`--vary`)";
        let failure =
            of.passed_limits().map(|what| CommandError { status: 3, ..CommandError::failed(what, Some(hint.into())) });
        Answer::of_folder(&self.out, (text, failure), (self.json, quiet))
    }
}
