//! The answer about a study, and its page.

use answer::{Answer, Check, Checks, Cost};
use serde_json::{Map, Value, json};

use super::{
    CaseResult, StudyResult,
    charts::figures,
    tables::{grid, speed_up_text, step_s, study as study_rows},
};
use store::CASES;

use crate::{
    ReportError,
    page::{Cell, Content, Grid, Page, Part, again, cost_part, counted},
};

/// The answer: the table `study`, a row a case.
pub fn study_answer(of: StudyResult<'_>, cost: Cost) -> Answer {
    let StudyResult { study, runs, findings, speed_up, warnings, .. } = of;
    let full = study.full.zip(speed_up).map(|(full, s)| {
        let step_s = step_s(runs, full.case);
        json!({
            "case": study.cases[full.case].label,
            "at_rest": s,
            "motion_step_s": step_s,
            "full_position_over_motion_step": step_s.map(|step| s.full_position_s / step),
        })
    });
    Answer {
        kind: "study",
        name: study.name.clone(),
        inputs: json!({ "study": study.file.display().to_string(), "parameter": study.parameter }),
        tables: vec![study_rows(study, findings)],
        headline: json!({
            "cases": (0..study.cases.len()).map(|i| case(of, i)).collect::<Vec<_>>(),
            "correlations": findings.followers.iter().map(|f| json!({
                "column": f.column, "beside": f.beside, "by_case": f.correlation,
            })).collect::<Vec<_>>(),
            "full": full,
        }),
        checks: Checks::new([Check::cases_without_result(
            runs.iter().filter(|run| run.is_err()).count(),
            runs.len(),
            "`reason` of each case says why",
        )]),
        remarks: warnings.to_vec(),
        // What differs from run to run is no result.
        info: Map::from_iter([("wall_s".to_owned(), json!(runs.iter().map(wall_s).collect::<Vec<_>>()))]),
        cost,
    }
}

/// The page: figures, the numbers, each case's own report linked by its folder's name.
///
/// # Errors
/// For rows without a column that is drawn.
pub fn study_page(of: StudyResult<'_>, answer: &Answer) -> Result<Page, ReportError> {
    let StudyResult { study, runs, findings, speed_up, reports, .. } = of;
    let mut page = Page::of(answer, format!("study of {}", counted(study.cases.len(), "case")));
    for figure in figures(study, runs, findings)? {
        page.push(Part::more().words(figure.text).figures(figure.charts));
    }
    page.push(Part::new("Numbers").closing().grid(grid(study, runs, findings)));
    if let Some((full, s)) = study.full.zip(speed_up) {
        let text = speed_up_text(s, &study.cases[full.case].label, step_s(runs, full.case));
        page.push(Part::new("Against every degree of freedom").closing().with(Content::Items(vec![text])));
    }
    page.push(cases(of));
    page.push(cost_part(&answer.cost));
    let words = if reports { " --reports all" } else { "" };
    page.push(again(&format!("ale-gear vary {} --out DIR{words}", study.file.display())));
    Ok(page)
}

fn cases(of: StudyResult<'_>) -> Part {
    let StudyResult { study, runs, findings, reports, .. } = of;
    let rows = study.cases.iter().enumerate().map(|(i, case)| {
        let folder = format!("{CASES}/{}", study.folder(i));
        let has_report = runs[i].as_ref().map_or_else(|miss| miss.has_folder, |run| run.has_report);
        let link = has_report.then(|| format!("{folder}/report.html"));
        let told = match findings.reason(i) {
            Some(reason) if has_folder(&runs[i]) => format!("no result: {reason} ({folder})"),
            Some(reason) => format!("no result: {reason}"),
            None => folder,
        };
        let scene = case.scene.file.display().to_string();
        vec![Cell { link, ..Cell::text(&case.label) }, Cell::text(scene), Cell::text(told)]
    });
    let mut words = "The files of each case are in its folder below `cases`.".to_owned();
    if !reports {
        words += " Reports and views of single cases at rest are made with `--reports`.";
    }
    Part::new("Cases").words(words).grid(Grid::new(["case", "scene", "folder"]).rows(rows))
}

/// Wall time of a case with a result, s.
fn wall_s(run: &CaseResult) -> Option<f64> {
    run.as_ref().ok().map(|run| run.cost.wall_s)
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
    })
}
