//! What a study knows of its cases before they run, and what it warns of after.

use analysis::{lumped::is_lumped, parameter_study::Findings};
use scene::{Scene, study::Study};

use super::{CaseResult, with_result};
use crate::{checkpoint::motion_column_names, columns::history_columns};

/// Columns that a scene's `history.csv` will have; `None` where only a run can tell.
pub fn columns_of(scene: &Scene) -> Option<Vec<String>> {
    match &scene.motion {
        Some(_) if is_lumped(scene) => None,
        Some(_) => Some(motion_column_names(scene)),
        None => Some(history_columns(scene, &[])),
    }
}

/// Cases without a result first; then what the others warn of, each once, with their names.
pub fn study_warnings(study: &Study, runs: &[CaseResult], findings: &Findings) -> Vec<String> {
    let failed = (0..study.cases.len()).filter_map(|i| {
        let reason = findings.reason(i)?;
        Some(format!("{}: no result: {reason}; tables, charts and correlations are without it", study.cases[i].label))
    });
    let of_runs = with_result(study, runs, findings)
        .flat_map(|(case, run, _)| run.warnings.iter().map(|w| format!("{}: {w}", case.label)).collect::<Vec<_>>());
    failed.chain(of_runs).chain(findings.warnings.iter().cloned()).collect()
}
