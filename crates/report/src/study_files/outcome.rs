//! What files of a study are made of.

use analysis::{
    accuracy_chart::SpeedUp,
    parameter_study::{CaseFailure, CaseFindings, CaseRecord, Findings},
};
use scene::study::{Study, StudyCase};

use crate::Cost;

/// Phases of a motion that take steps.
const STEPPING: [&str; 3] = ["shoot", "settle", "solve"];

/// A case with a result.
#[derive(Debug, Clone)]
pub struct CaseRun {
    /// Rows and geometry.
    pub record: CaseRecord,
    /// Cost of the case, on its own share of the threads.
    pub cost: Cost,
    /// Steps in time; `None` at rest.
    pub steps: Option<u64>,
    /// What its summary warns of.
    pub remarks: Vec<answer::Remark>,
    /// Whether its folder has a report.
    pub has_report: bool,
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
pub struct CaseMiss {
    /// Why.
    pub failure: CaseFailure,
    /// Whether its files are there to be looked at: those of a result that does not hold.
    pub has_folder: bool,
}

/// A case's result, or why it has none.
pub type CaseResult = Result<CaseRun, CaseMiss>;

/// What files of a study are made of.
#[derive(Debug, Clone, Copy)]
pub struct StudyResult<'a> {
    /// What was asked.
    pub study: &'a Study,
    /// What the cases left.
    pub runs: &'a [CaseResult],
    /// What was read off it.
    pub findings: &'a Findings,
    /// The whole model, where it was run.
    pub speed_up: Option<&'a SpeedUp>,
    /// Remarks for the user.
    pub remarks: &'a [answer::Remark],
    /// Whether every case was to have a report.
    pub reports: bool,
}

/// Cases that have a result, with its rows.
pub fn with_result<'a>(
    study: &'a Study,
    runs: &'a [CaseResult],
    findings: &'a Findings,
) -> impl Iterator<Item = (&'a StudyCase, &'a CaseRun, &'a CaseFindings)> {
    let all = study.cases.iter().zip(runs).zip(&findings.cases);
    all.filter_map(|((case, run), found)| Some((case, run.as_ref().ok()?, found.as_ref().ok()?)))
}
