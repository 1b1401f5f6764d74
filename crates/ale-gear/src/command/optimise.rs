//! `ale-gear optimise`: the micro-geometry that is quietest.

use std::{ops::ControlFlow, path::PathBuf};

use analysis::{
    PhaseWork, SharedModels,
    optimum::{Optimised, Optimum, optimise, told},
    run_phase,
};
use report::optimum_files::{OptimumResult, passed_limits, write_optimum};
use scene::{
    Document,
    optimum::{Optimisation, OptimisationWords},
};

use super::{Answer, FileWords, cache_args::CacheArgs, overrides::Overrides};
use crate::{error::CommandError, output::ResultDirectory, phases::Phases, talk};

/// Words of `ale-gear optimise`.
#[derive(Debug, clap::Args)]
pub(super) struct OptimiseArgs {
    /// Optimisation file, or a scene file
    file: PathBuf,
    /// Folder for the results; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    /// A key that may change within bounds, `KEY=FROM:TO`; the search begins at the scene's own value; may be given again
    /// [default: tip reliefs, where they begin, lead crowning]
    #[arg(long, value_name = "WORDS", allow_hyphen_values = true)]
    vary: Vec<String>,
    /// Torques at which it counts, N m, with commas between [default: the scene's]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    torques: Vec<f64>,
    /// What shall be small: peak-to-peak, rms or harmonics (the first) [default: peak-to-peak]
    #[arg(long, value_name = "NAME")]
    measure: Option<String>,
    /// Limit of the contact pressure, MPa
    #[arg(long, value_name = "MPA")]
    max_pressure: Option<f64>,
    /// Limit of the contact pressure at end faces and tip edges, MPa
    #[arg(long, value_name = "MPA")]
    max_edge_pressure: Option<f64>,
    /// Evaluations at the most [default: 20]
    #[arg(long, value_name = "N")]
    evaluations: Option<u32>,
    /// Points of the trade-off against a lower pressure [default: none]
    #[arg(long, value_name = "N")]
    front: Option<u32>,
    /// The summary as JSON on stdout, instead of the closing table
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

    /// Every complaint about the words and the files is made here, before any work starts or any file is written.
    fn plan(&self) -> Result<Optimisation, CommandError> {
        let Self { file, vary, torques, measure, max_pressure, evaluations, front, .. } = self;
        let settings = self.overrides.settings()?;
        let words = !vary.is_empty() || !torques.is_empty() || measure.is_some() || max_pressure.is_some();
        let words = words || self.max_edge_pressure.is_some() || evaluations.is_some() || front.is_some();
        // What cannot be read is complained about as a scene is.
        let document = Document::read(file)?;
        if Optimisation::is_one(&document) {
            if words {
                let hint = "write it into the file, or give a scene file";
                return Err(CommandError::input("an optimisation file says everything itself", Some(hint.into())));
            }
            return Ok(Optimisation::of(&document, &settings)?);
        }
        let words = OptimisationWords {
            parameters: vary,
            torques_nm: torques,
            measure: measure.as_deref(),
            max_pressure_mpa: *max_pressure,
            max_edge_pressure_mpa: self.max_edge_pressure,
            evaluations: evaluations.unwrap_or(20),
            front: front.unwrap_or(0),
        };
        Ok(Optimisation::of_scene(document, &settings, &words)?)
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
        let (plan, mut phases) = (self.plan()?, Phases::with_bars());
        let results = ResultDirectory::create(&self.out)?;
        let cache = self.cache.open();
        let models = SharedModels::new(&cache);
        // It ends when it has converged, nobody knows when; the last one is that of values that a machine can be set to.
        let most = u64::from(plan.evaluations) + 1;
        let work = if plan.front > 0 { PhaseWork::Unknown } else { PhaseWork::AtMost(most) };
        let optimum: Optimum = run_phase(&mut phases, "search", work, |progress| {
            optimise(&models, &plan, |count, goal| {
                progress.tick();
                match goal {
                    Some(goal) => talk::note(format!("evaluation {count}: {goal:.4} um")),
                    None => talk::note(format!("evaluation {count}: no result")),
                }
                ControlFlow::Continue(())
            })
        })?;
        let told: Optimised = phases.run("tell", || told(&models, &optimum))?;
        let scene = optimum.plan.own_scene(&optimum.values)?.standing_alone();
        let again = self.again();
        let of = OptimumResult { optimum: &optimum, told: &told, scene: &scene, again: &again };
        let text = write_optimum(&of, phases.cost(), &results)?.table;
        results.finish(talk::note)?;
        let hint = "allow more, or let more parameters change, within wider bounds (`--vary`)";
        let failure = passed_limits(&optimum)
            .map(|what| CommandError { status: 3, ..CommandError::failed(what, Some(hint.into())) });
        Answer::of_folder(&self.out, (text, failure), (self.json, quiet))
    }
}
