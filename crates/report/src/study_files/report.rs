//! `report.html` and `summary.json` of a study.

use minijinja::{context, value::Serde};
use serde_json::{Map, Value, json};

use super::{
    CASES, CaseResult, StudyResult,
    charts::figures,
    tables::{speed_up_text, step_s},
};
use crate::{ReportError, page::Rendered};

/// The report: figures, the table, each case's own report linked by its folder's name.
///
/// # Errors
/// For rows without a column that is drawn, and if the template cannot be filled.
pub fn write_study_report(of: StudyResult<'_>, table: &str) -> Result<Rendered, ReportError> {
    let StudyResult { study, runs, findings, speed_up, warnings, reports, .. } = of;
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
                "report": runs[i].as_ref().map_or_else(|miss| miss.has_folder, |run| run.has_report),
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
            reports => reports,
            table => table,
            warnings => warnings.to_vec(),
        },
    )?;
    Ok(page)
}

/// The summary as JSON; numbers without a value are `null`.
pub fn write_study_summary(of: StudyResult<'_>, files: &[String]) -> String {
    let StudyResult { study, runs, findings, speed_up, cost, warnings, .. } = of;
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
fn has_folder(run: &CaseResult) -> bool {
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
        "geometry": run.map(|r| r.record.geometry),
        "quantities": quantities,
        "steps": run.map(|r| r.steps),
        "wall_s": run.map(|r| r.cost.wall_s),
    })
}
