//! What a study knows of its cases before they run, and what it warns of after.

use analysis::{
    lumped::is_lumped,
    parameter_study::Findings,
    remark::{self, Remark},
};
use scene::{Scene, study::Study};

use super::{CaseResult, with_result};
use columns::{LumpedLayout, history_columns};
use store::checkpoint::{InputDigests, motion_column_names};

/// Columns that a scene's `history.csv` will have, but for those of single pairs.
pub fn columns_of(scene: &Scene) -> Option<Vec<String>> {
    match &scene.motion {
        Some(_) if is_lumped(scene) => Some(LumpedLayout::of(scene).sheet().names()),
        Some(_) => Some(motion_column_names(scene)),
        None => Some(history_columns(scene, &[])),
    }
}

/// What says that two studies have the same cases: scenes, files that they name, program; and whether cases have
/// reports.
pub fn study_digest(study: &Study, reports: bool) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(format!("{} {reports}", env!("CARGO_PKG_VERSION")).as_bytes());
    for case in &study.cases {
        let digests = InputDigests::of(&case.scene);
        // A motion that is made longer goes on from its checkpoint; a case that is done does not.
        let cycles = case.scene.analysis.cycles;
        hasher.update(format!("{} {digests:?} {cycles}\n", case.label).as_bytes());
    }
    hasher.finalize().to_hex().to_string()
}

/// Cases without a result first; then what the others warn of, each once, with their names.
pub fn study_warnings(study: &Study, runs: &[CaseResult], findings: &Findings) -> Vec<Remark> {
    let failed = (0..study.cases.len()).filter_map(|i| {
        let reason = findings.reason(i)?;
        Some(remark::case_unsolved(reason).about(&study.cases[i].label))
    });
    let of_runs = with_result(study, runs, findings)
        .flat_map(|(case, run, _)| run.warnings.iter().map(|said| said.clone().about(&case.label)));
    failed.chain(of_runs).chain(findings.warnings.iter().cloned()).collect()
}
