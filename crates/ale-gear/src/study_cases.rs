//! Runs the scenes of a study side by side: those at rest on models that they share, as cases of a plan are.

use std::path::Path;

use analysis::{
    PhaseWork, RemarksAtRest, RestRequest, SharedModels, Solved, parallel_map,
    parameter_study::{CaseFailure, CaseRecord},
    remark::{self, Remark},
    run_phase, solve_at_rest,
};
use columns::read_columns;
use columns::solved_rows;
use report::study_files::{CaseMiss, CaseResult, CaseRun};
use report::{Cost, ReportError, write_static_rows};
use scene::{
    Kind,
    study::{RefusedCase, Study, StudyCase},
};
use store::checkpoint::HISTORY;
use store::folder::KeptCases;

use crate::{
    certificate::Written, error::CommandError, gears, output::ResultDirectory, phases::Phases, scene::Scene, talk,
};

/// Runs a scene and writes every file of its result, also of one that does not hold.
pub(crate) type Solve<'a> = &'a (dyn Fn(&Scene, &ResultDirectory) -> Result<Written, CommandError> + Sync);

/// How the cases of a study are run.
#[derive(Clone, Copy)]
pub(crate) struct CaseRunner<'a> {
    /// What cases at rest have in common.
    pub models: &'a SharedModels<'a>,
    /// What runs a case by itself, as `ale-gear run` does.
    pub alone: Solve<'a>,
    /// Whether every case is run so, with a report of its own.
    pub reports: bool,
}

/// Runs all cases that are not done yet. `done` is told of each. A case without a solution takes nothing from the
/// others; one that was run by itself and does not hold leaves its files, marked as such.
pub(crate) fn run_cases(
    study: &Study,
    kept: &KeptCases,
    runner: CaseRunner<'_>,
    done: &(dyn Fn(&StudyCase) + Sync),
) -> Vec<CaseResult> {
    parallel_map(study.cases.len(), |i| {
        let ran = one(study, i, kept, runner).unwrap_or_else(|e| Err(miss(e, false)));
        done(&study.cases[i]);
        ran
    })
}

/// Why a case has no result, and whether its files are there to be looked at.
fn miss(error: CommandError, has_folder: bool) -> CaseMiss {
    let CommandError { status, message, excerpt, hint } = error;
    CaseMiss { failure: CaseFailure { message, excerpt, hint, is_without_result: status == 1 }, has_folder }
}

/// Whether a case is solved on models that others share: at rest, without files of its own beside its rows.
fn shares(scene: &Scene) -> bool {
    let output = &scene.output;
    let files =
        output.vtu || output.contact_lines || output.flank_orders || output.parquet || !output.derivatives.is_empty();
    scene.analysis.kind == Kind::Static && scene.accuracy.is_none() && !files
}

fn one(study: &Study, i: usize, kept: &KeptCases, runner: CaseRunner<'_>) -> Result<CaseResult, CommandError> {
    let StudyCase { scene, refused, .. } = &study.cases[i];
    if let Some(RefusedCase { message, excerpt, hint }) = refused {
        let error = CommandError::input(message, hint.clone()).about(excerpt.as_deref());
        return Ok(Err(miss(error, false)));
    }
    let folder = kept.folder(&study.folder(i));
    if folder.is_dir()
        && let Some(found) = of_folder(scene, &folder)?
    {
        return Ok(Ok(found));
    }
    let own = ResultDirectory::create(&folder)?;
    let (solved, cost) = if shares(scene) && !runner.reports {
        write_rows(scene, runner.models, &own)?
    } else {
        let Written { solved, cost, verdict, .. } = (runner.alone)(scene, &own)?;
        if let Err(error) = verdict {
            own.finish(talk::note)?;
            return Ok(Err(miss(error, true)));
        }
        (solved, cost)
    };
    own.finish(talk::note)?;
    Ok(Ok(CaseRun {
        record: CaseRecord {
            rows: solved_rows(&solved).map_err(ReportError::from)?,
            geometry: gears::geometry_facts(&scene.gear_pair()?),
        },
        cost,
        steps: steps(&solved.headline()?),
        has_report: has_report(&folder),
        remarks: solved.remarks().to_vec(),
    }))
}

/// Solves a scene at rest and writes its rows and its summary: no report, no view.
fn write_rows(
    scene: &Scene,
    models: &SharedModels<'_>,
    results: &ResultDirectory,
) -> Result<(Solved, Cost), CommandError> {
    let mut phases = Phases::quiet();
    let work = || solve_at_rest(scene, models, RestRequest::to_the_end(RemarksAtRest::Collected));
    let solved = run_phase(&mut phases, "solve", PhaseWork::Unknown, |_| work())?;
    let (facts, cost) = (solved.facts()?, phases.cost());
    let rows = (&solved.history, solved.derivatives.as_ref());
    write_static_rows(&solved.scene, rows, (&facts, &cost), results)?;
    Ok((Solved::AtRest(Box::new(solved)), cost))
}

/// Steps in time that a headline tells of; `None` at rest.
fn steps(headline: &serde_json::Value) -> Option<u64> {
    headline["certificate"]["steps"].as_u64()
}

fn has_report(folder: &Path) -> bool {
    folder.join("report.html").is_file()
}

/// The case that a folder holds which an earlier run has left; `None` where its result does not hold.
fn of_folder(scene: &Scene, folder: &Path) -> Result<Option<CaseRun>, CommandError> {
    let summary = report::compare::summary(folder)?;
    if summary["certificate"] == "failed" {
        return Ok(None);
    }
    let rows = read_columns(&folder.join(HISTORY))?;
    let remarks = summary["remarks"].as_array().map_or(&[][..], |list| list);
    Ok(Some(CaseRun {
        record: CaseRecord { rows, geometry: gears::geometry_facts(&scene.gear_pair()?) },
        cost: serde_json::from_value(summary["cost"].clone()).unwrap_or_default(),
        steps: steps(&summary["headline"]),
        has_report: has_report(folder),
        remarks: remarks.iter().filter_map(|said| Remark::read(said, remark::ALL)).collect(),
    }))
}
