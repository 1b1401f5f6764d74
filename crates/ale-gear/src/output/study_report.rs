//! `report.html` and `summary.json` of a study.

use minijinja::{context, value::Serde};
use serde_json::{Map, Value, json};

use report::page::Rendered;

use super::{
    CASES,
    study_charts::figures,
    study_tables::{speed_up_text, step_s},
};
use crate::chart::SpeedUp;
use crate::error::CommandError;
use crate::facts::Cost;
use crate::parameter_study::{CaseOutcome, Findings, Study};

/// What files of a study are made of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StudyResult<'a> {
    /// What was asked.
    pub study: &'a Study,
    /// What the cases left.
    pub runs: &'a [CaseOutcome],
    /// What was read off it.
    pub findings: &'a Findings,
    /// The whole model, where it was run.
    pub speed_up: Option<&'a SpeedUp>,
    /// What it all took.
    pub cost: &'a Cost,
    /// What a user should hear.
    pub warnings: &'a [String],
}

/// The report: figures, the table, each case's own report linked by its folder's name.
///
/// # Errors
/// Exit status 1 if the template cannot be filled; that would be a fault of this program.
pub(crate) fn write_study_report(of: StudyResult<'_>, table: &str) -> Result<Rendered, CommandError> {
    let StudyResult { study, runs, findings, speed_up, warnings, .. } = of;
    let figures: Vec<Value> = figures(study, runs, findings)?
        .into_iter()
        .map(|figure| json!({ "text": figure.text, "charts": figure.charts }))
        .collect();
    let cases: Vec<Value> = study
        .cases
        .iter()
        .enumerate()
        .map(|(i, case)| {
            json!({
                "label": case.label,
                "scene": case.scene.file.display().to_string(),
                "folder": has_folder(&runs[i]).then(|| study.folder(i)),
                "reason": findings.reason(i),
            })
        })
        .collect();
    let full = study.full.zip(speed_up);
    let speed = full.map(|(f, s)| speed_up_text(s, &study.cases[f.case].label, step_s(runs, f.case)));
    let page = Rendered::new(
        "study.html",
        context! {
            name => &study.name,
            version => env!("CARGO_PKG_VERSION"),
            file => study.file.display().to_string(),
            figures => Serde(figures),
            cases => Serde(cases),
            speed => speed,
            table => table,
            warnings => warnings.to_vec(),
        },
    )?;
    Ok(page)
}

/// The summary as JSON; numbers without a value are `null`.
pub(crate) fn write_study_summary(of: StudyResult<'_>, files: &[String]) -> String {
    let StudyResult { study, runs, findings, speed_up, cost, warnings } = of;
    let cases: Vec<Value> = (0..study.cases.len()).map(|i| case(of, i)).collect();
    let full = study.full.zip(speed_up).map(|(full, s)| {
        let step_s = step_s(runs, full.case);
        json!({
            "case": study.cases[full.case].label,
            "at_rest": s,
            "motion_step_s": step_s,
            "full_position_over_motion_step": step_s.map(|step| s.full_position_s / step),
        })
    });
    let summary = json!({
        "program": "ale-gear",
        "version": env!("CARGO_PKG_VERSION"),
        "name": study.name,
        "study": study.file.display().to_string(),
        "parameter": study.parameter,
        "cases": cases,
        "correlations": findings.followers.iter().map(|f| json!({
            "column": f.column, "beside": f.beside, "by_case": f.correlation,
        })).collect::<Vec<_>>(),
        "full": full,
        "cost": cost,
        "warnings": warnings,
        "files": files,
    });
    // Strings and numbers only, all keys are strings: there is nothing that JSON could refuse.
    let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
    text.push('\n');
    text
}

/// Whether a case left files.
fn has_folder(run: &CaseOutcome) -> bool {
    run.as_ref().map_or_else(|miss| miss.has_folder, |_| true)
}

fn case(of: StudyResult<'_>, i: usize) -> Value {
    let (case, reason) = (&of.study.cases[i], of.findings.reason(i));
    let run = of.runs[i].as_ref().ok().filter(|_| reason.is_none());
    let quantities = of.findings.cases[i].as_ref().ok().map(|found| {
        of.study.quantities.iter().zip(&found.quantities).map(|(q, v)| (q.name(), json!(v))).collect::<Map<_, _>>()
    });
    json!({
        "label": case.label,
        "value": case.value,
        "scene": case.scene.file.display().to_string(),
        "reason": reason,
        "folder": has_folder(&of.runs[i]).then(|| format!("{CASES}/{}", of.study.folder(i))),
        "geometry": run.map(|r| r.geometry),
        "quantities": quantities,
        "steps": run.map(|r| r.steps),
        "wall_s": run.map(|r| r.cost.wall_s),
    })
}
