//! The answer about a study, and its page.

use std::collections::BTreeMap;

use analysis::{accuracy_chart::SpeedUp, facts::GeometryFacts};
use answer::{Answer, Check, Checks, Cost, keyed};
use described::Key;
use serde::Serialize;
use serde_json::json;

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

described::described! {
    /// Headline of a study.
    #[derive(Serialize)]
    struct StudyHeadline<'a> {
        /// cases, in the order of the file
        cases: Vec<CaseSummary<'a>>,
        /// correlations of two columns that the study asks for
        correlations: Vec<Correlation<'a>>,
        /// one case against every degree of freedom; `null` where the study does not ask for it
        full: Option<FullSummary<'a>>,
    }

    /// A case of a study.
    #[derive(Serialize)]
    struct CaseSummary<'a> {
        /// name of the case
        label: &'a str,
        /// value of the parameter
        value: f64,
        /// file of the scene
        scene: String,
        /// reason why there is no result; `null` where there is one
        reason: Option<&'a str>,
        /// folder of the case; `null` where it left no files
        folder: Option<String>,
        /// geometry of the pair; `null` without a result
        geometry: Option<GeometryFacts>,
        /// quantities of the study by name; `null` without a result
        quantities: Option<BTreeMap<String, f64>>,
        /// steps in time; `null` at rest and without a result
        steps: Option<u64>,
    }

    /// Pearson's correlation coefficient of two columns over all rows of a case.
    #[derive(Serialize)]
    struct Correlation<'a> {
        /// one column
        column: &'a str,
        /// the other column
        beside: &'a str,
        /// Pearson's coefficient by case: 1 or -1 where one column is a linear function of the other; `null` where a column does not vary, and without a result
        by_case: &'a [Option<f64>],
    }

    /// A case against every degree of freedom.
    #[derive(Serialize)]
    struct FullSummary<'a> {
        /// name of the case
        case: &'a str,
        /// times of both models at rest
        at_rest: &'a SpeedUp,
        /// wall time of one step in time of the reduced pair, settling and writing included
        motion_step_s: Option<f64>,
        /// wall time of one position with every degree of freedom over that of a step: the least that the reduction saves in time
        full_position_over_motion_step: Option<f64>,
    }

    /// Facts of a study.
    #[derive(Serialize)]
    struct StudyInfo {
        /// wall time of each case
        wall_s: Vec<Option<f64>>,
    }
}

/// Objects of the summary with their keys.
pub(crate) const OBJECTS: [(&str, &[Key]); 5] = [
    ("headline, a study", StudyHeadline::KEYS),
    ("cases, a study", CaseSummary::KEYS),
    ("correlations, a study", Correlation::KEYS),
    ("full, a study", FullSummary::KEYS),
    ("the summary of a study", StudyInfo::KEYS),
];

/// The answer: the table `study`, a row a case.
pub fn study_answer(of: StudyResult<'_>, cost: Cost) -> Answer {
    let StudyResult { study, runs, findings, speed_up, remarks, .. } = of;
    let full = study.full.zip(speed_up).map(|(full, s)| {
        let step_s = step_s(runs, full.case);
        FullSummary {
            case: &study.cases[full.case].label,
            at_rest: s,
            motion_step_s: step_s,
            full_position_over_motion_step: step_s.map(|step| s.full_position_s / step),
        }
    });
    Answer {
        kind: "study",
        name: study.name.clone(),
        inputs: json!({ "study": study.file.display().to_string(), "parameter": study.parameter }),
        tables: vec![study_rows(study, findings)],
        headline: json!(StudyHeadline {
            cases: (0..study.cases.len()).map(|i| case(of, i)).collect(),
            correlations: findings
                .followers
                .iter()
                .map(|f| Correlation { column: &f.column, beside: &f.beside, by_case: &f.correlation })
                .collect(),
            full,
        }),
        checks: Checks::new([Check::cases_without_result(
            runs.iter().filter(|run| run.is_err()).count(),
            runs.len(),
            "`reason` of each case says why",
        )]),
        remarks: remarks.to_vec(),
        // What differs from run to run is no result.
        info: keyed(&StudyInfo { wall_s: runs.iter().map(wall_s).collect() }),
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
    page.push(Part::new("Results").closing().grid(grid(study, runs, findings)));
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

fn case(of: StudyResult<'_>, i: usize) -> CaseSummary<'_> {
    let (case, reason) = (&of.study.cases[i], of.findings.reason(i));
    let run = of.runs[i].as_ref().ok().filter(|_| reason.is_none());
    let quantities = of.findings.cases[i]
        .as_ref()
        .ok()
        .map(|found| of.study.quantities.iter().zip(&found.quantities).map(|(q, v)| (q.name(), *v)).collect());
    CaseSummary {
        label: &case.label,
        value: case.value,
        scene: case.scene.file.display().to_string(),
        reason,
        folder: has_folder(&of.runs[i]).then(|| format!("{CASES}/{}", of.study.folder(i))),
        geometry: run.map(|r| r.record.geometry),
        quantities,
        steps: run.and_then(|r| r.steps),
    }
}
