//! Runs the scenes of a study, each into a folder of its own, side by side.

use std::path::Path;

use analysis::{
    parameter_study::{CaseFailure, CaseRecord},
    side_by_side,
};
use report::study_files::{CaseMiss, CaseResult, CaseRun};
use report::{checkpoint::HISTORY, read_columns};
use scene::study::{Study, StudyCase};

use study::Columns;

use crate::{
    certificate::Written,
    error::CommandError,
    facts::Cost,
    gears,
    output::{CASES, ResultDirectory},
    scene::Scene,
    talk,
};

/// Runs a scene and writes every file of its result; inside, whether it holds.
pub(crate) type Solve<'a> =
    &'a (dyn Fn(&Scene, &ResultDirectory) -> Result<Result<Cost, CommandError>, CommandError> + Sync);

/// Runs all cases into the folder `cases` of the study's results. `done` is told of each. A case without a solution
/// takes nothing from the others; one whose result does not hold leaves its files, marked as such, as a run by itself
/// does.
pub(crate) fn run_cases(
    study: &Study,
    results: &ResultDirectory,
    solve: Solve<'_>,
    done: &(dyn Fn(&StudyCase) + Sync),
) -> Vec<CaseResult> {
    side_by_side(study.cases.len(), |i| {
        let ran = one(study, i, results, solve).unwrap_or_else(|e| Err(miss(e, false)));
        done(&study.cases[i]);
        ran
    })
}

/// Why a case has no result, and whether its files are there to be looked at.
fn miss(error: CommandError, has_folder: bool) -> CaseMiss {
    let CommandError { status, message, excerpt, hint } = error;
    CaseMiss { failure: CaseFailure { message, excerpt, hint, is_without_result: status == 1 }, has_folder }
}

fn one(study: &Study, i: usize, results: &ResultDirectory, solve: Solve<'_>) -> Result<CaseResult, CommandError> {
    let case = &study.cases[i];
    let folder = results.path(CASES).join(study.folder(i));
    let own = ResultDirectory::create(&folder)?;
    let solved = solve(&case.scene, &own)?;
    own.finish(talk::note)?;
    let cost = match solved {
        Ok(cost) => cost,
        Err(error) => return Ok(Err(miss(error, true))),
    };
    let rows = read_columns(&folder.join(HISTORY))?;
    let summary = summary(&folder)?;
    let warnings = summary["warnings"].as_array().map_or(&[][..], |list| list);
    Ok(Ok(CaseRun {
        record: CaseRecord { rows, geometry: gears::geometry_facts(&case.scene.gear_pair()?) },
        cost,
        steps: summary["headline"]["certificate"]["steps"].as_u64(),
        warnings: warnings.iter().filter_map(|w| Some(w.as_str()?.to_owned())).collect(),
    }))
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

/// Rows and headline of a scene that is run into a folder, which is taken away again.
///
/// # Errors
/// Those of the run; that of its certificate among them.
pub(crate) fn numbers(
    folder: &Path,
    solve: impl FnOnce(&ResultDirectory) -> Result<Written, CommandError>,
) -> Result<(Columns, serde_json::Value), CommandError> {
    std::fs::create_dir_all(folder).map_err(|e| CommandError::write(folder, &e))?;
    let own = ResultDirectory::create(folder)?;
    let written = solve(&own)?;
    own.finish(|_| ())?;
    written.verdict?;
    let found = (read_columns(&folder.join(HISTORY))?, summary(folder)?["headline"].take());
    // What stays goes with the folder around it.
    let _ = std::fs::remove_dir_all(folder);
    Ok(found)
}
