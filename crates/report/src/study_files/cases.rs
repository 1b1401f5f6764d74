//! What a study warns of.

use analysis::{
    parameter_study::Findings,
    remark::{self, Remark},
};
use scene::study::Study;

use super::{CaseResult, with_result};

/// Cases without a result first; then what the others warn of, each once, with their names.
pub fn study_remarks(study: &Study, runs: &[CaseResult], findings: &Findings) -> Vec<Remark> {
    let failed = (0..study.cases.len()).filter_map(|i| {
        let reason = findings.reason(i)?;
        Some(remark::case_unsolved(reason).about(&study.cases[i].label))
    });
    let of_runs = with_result(study, runs, findings)
        .flat_map(|(case, run, _)| run.remarks.iter().map(|said| said.clone().about(&case.label)));
    failed.chain(of_runs).chain(findings.remarks.iter().cloned()).collect()
}
