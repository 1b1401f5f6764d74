//! Runs the scenes of a study, each into a folder of its own, side by side.

use crate::scene::SceneError;
use std::{
    path::Path,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
};

use rayon::ThreadPoolBuilder;

use super::{Case, Study};
use crate::{
    error::CommandError,
    facts::{Cost, GeometryFacts},
    gears,
    motion::{Columns, HISTORY, read_columns},
    output::{CASES, ResultDirectory},
    scene::Scene,
    talk,
};

/// Phases of a motion that take steps.
const STEPPING: [&str; 3] = ["shoot", "settle", "solve"];

/// What a case left behind.
#[derive(Debug, Clone)]
pub(crate) struct CaseRun {
    /// Rows of its `history.csv`.
    pub rows: Columns,
    /// What it took, on its own share of the threads.
    pub cost: Cost,
    /// Geometry of the pair.
    pub geometry: GeometryFacts,
    /// Steps in time; `None` at rest.
    pub steps: Option<u64>,
    /// What its summary warns of.
    pub warnings: Vec<String>,
}

impl CaseRun {
    /// Wall time of a step in time, s; `None` at rest.
    pub fn step_s(&self) -> Option<f64> {
        let steps = self.steps.filter(|s| *s > 0)?;
        let stepping = self.cost.phases.iter().filter(|p| STEPPING.contains(&p.name.as_str()));
        Some(stepping.map(|p| p.wall_s).sum::<f64>() / steps as f64)
    }
}

/// A case without a result.
#[derive(Debug, Clone)]
pub(crate) struct CaseMiss {
    /// Why.
    pub error: CommandError,
    /// Whether its files are there to be looked at: those of a result that does not hold.
    pub has_folder: bool,
}

impl From<SceneError> for CaseMiss {
    fn from(error: SceneError) -> Self {
        CommandError::from(error).into()
    }
}

impl From<CommandError> for CaseMiss {
    fn from(error: CommandError) -> Self {
        Self { error, has_folder: false }
    }
}

/// A case's result, or why it has none.
pub(crate) type CaseOutcome = Result<CaseRun, CaseMiss>;

/// Runs a scene and writes every file of its result; inside, whether it holds.
pub(crate) type Solve<'a> =
    &'a (dyn Fn(&Scene, &ResultDirectory) -> Result<Result<Cost, CommandError>, CommandError> + Sync);

/// Runs all cases into the folder `cases` of the study's results. `done` is told of each. A case without a solution takes nothing from the others; one whose result does not hold leaves its
/// files, marked as such, as a run by itself does.
///
/// As many run at once as there are threads, each with its share of them: motion is serial, so cores serve cases. The threads of
/// a case are its own, so that no case waits for, or is timed with, the work of another. Results do not depend on their number.
pub(crate) fn run_cases(
    study: &Study,
    results: &ResultDirectory,
    solve: Solve<'_>,
    done: &(dyn Fn(&Case) + Sync),
) -> Vec<CaseOutcome> {
    let count = study.cases.len();
    let threads = rayon::current_num_threads();
    let workers = threads.min(count).max(1);
    let next = AtomicUsize::new(0);
    let slots: Vec<Mutex<Option<CaseOutcome>>> = (0..count).map(|_| Mutex::new(None)).collect();
    let work = || {
        let pool = ThreadPoolBuilder::new().num_threads((threads / workers).max(1)).build();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(slot) = slots.get(i) else { break };
            let run = || one(study, i, results, solve);
            let ran = match &pool {
                Ok(pool) => pool.install(run),
                // No threads to be had: the process's own serve as well.
                Err(_) => run(),
            };
            done(&study.cases[i]);
            *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(ran);
        }
    };
    std::thread::scope(|scope| {
        let others: Vec<_> = (1..workers).map(|_| scope.spawn(work)).collect();
        work();
        drop(others);
    });
    slots.into_iter().filter_map(|slot| slot.into_inner().unwrap_or_else(PoisonError::into_inner)).collect()
}

fn one(study: &Study, i: usize, results: &ResultDirectory, solve: Solve<'_>) -> CaseOutcome {
    let case = &study.cases[i];
    let folder = results.path(CASES).join(study.folder(i));
    let own = ResultDirectory::create(&folder).map_err(CommandError::from)?;
    let solved = solve(&case.scene, &own)?;
    own.finish(talk::note).map_err(CommandError::from)?;
    let cost = solved.map_err(|error| CaseMiss { error, has_folder: true })?;
    let rows = read_columns(&folder.join(HISTORY)).map_err(CommandError::from)?;
    let summary = summary(&folder)?;
    let warnings = summary["warnings"].as_array().map_or(&[][..], |list| list);
    Ok(CaseRun {
        rows,
        cost,
        geometry: gears::geometry_facts(&case.scene.gear_pair()?),
        steps: summary["headline"]["certificate"]["steps"].as_u64(),
        warnings: warnings.iter().filter_map(|w| Some(w.as_str()?.to_owned())).collect(),
    })
}

/// The summary that the case has just written.
fn summary(folder: &Path) -> Result<serde_json::Value, CommandError> {
    let path = folder.join("summary.json");
    let text = std::fs::read_to_string(&path).map_err(|e| CommandError::write(&path, &e))?;
    serde_json::from_str(&text).map_err(|e| {
        let hint = Some("does another program write into the folder?".into());
        CommandError::failed(format_args!("{}: {e}", path.display()), hint)
    })
}
