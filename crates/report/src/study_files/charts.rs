//! Figures of a study.

use analysis::parameter_study::{Findings, last_cycles};
use answer::label_of;
use scene::study::{Follow, OverTime, Study};
use study::StudyError;

use super::{CaseResult, with_result};
use crate::{
    charts::{Curve, dot_chart, line_chart},
    plan_files::plain,
};
use columns::motion_history::{MESH_PHASE, TIME};

/// A figure: a sentence above its charts.
pub(super) struct Figure {
    pub text: String,
    pub charts: Vec<String>,
}

/// All figures, in the order of the study file.
///
/// # Errors
/// [`StudyError`] for rows without a column that is drawn.
pub(super) fn figures(study: &Study, runs: &[CaseResult], findings: &Findings) -> Result<Vec<Figure>, StudyError> {
    let follow = study.follow.iter().map(|f| following(study, runs, findings, f));
    let over_time = study.over_time.iter().map(|o| over_time(study, runs, findings, o));
    let over_value = (!study.quantities.is_empty()).then(|| Ok(over_value(study, runs, findings)));
    follow.chain(over_time).chain(over_value).collect()
}

/// Columns of one case over mesh cycles, one under the other, and each pair of them against each other.
fn following(study: &Study, runs: &[CaseResult], findings: &Findings, follow: &Follow) -> Result<Figure, StudyError> {
    let case = &study.cases[follow.case];
    let (Ok(run), Ok(_)) = (&runs[follow.case], &findings.cases[follow.case]) else {
        let text = format!("{} has no result: {} is not drawn.", case.label, plain(&label_of(&follow.column)));
        return Ok(Figure { text, charts: Vec::new() });
    };
    let rows = last_cycles(&case.scene, &run.record.rows, follow.cycles);
    let cycles = mesh_cycles(rows.series(MESH_PHASE.name)?);
    let chart = |name: &String| {
        let label = label_of(name);
        let curve = Curve { label: String::new(), points: points(&cycles, rows.series(name)?) };
        Ok(line_chart(&format!("{}, {}", plain(&label), case.label), "mesh cycles", &label, &[curve], false))
    };
    let against = |beside: &String| {
        let (x, y) = (label_of(beside), label_of(&follow.column));
        let title = format!("{} against {}, {}", plain(&y), plain(&x), case.label);
        let points = points(rows.series(beside)?, rows.series(&follow.column)?);
        Ok(line_chart(&title, &x, &y, &[Curve { label: String::new(), points }], false))
    };
    let charts: Vec<Option<String>> = std::iter::once(&follow.column)
        .chain(&follow.beside)
        .map(chart)
        .chain(follow.beside.iter().map(against))
        .collect::<Result<_, StudyError>>()?;
    let said: Vec<String> = findings
        .followers
        .iter()
        .filter(|f| f.column == follow.column && follow.beside.contains(&f.beside))
        .map(|f| format!("{:+.3} with {}", f.correlation[follow.case].unwrap_or(f64::NAN), plain(&label_of(&f.beside))))
        .collect();
    Ok(Figure {
        text: format!(
            "Correlation of {} over all rows of {}: {}.",
            plain(&label_of(&follow.column)),
            case.label,
            said.join(", ")
        ),
        charts: charts.into_iter().flatten().collect(),
    })
}

/// One column of all cases over time, each from the beginning of its cycles shown.
fn over_time(study: &Study, runs: &[CaseResult], findings: &Findings, over: &OverTime) -> Result<Figure, StudyError> {
    let curves = with_result(study, runs, findings)
        .map(|(case, run, _)| {
            let rows = last_cycles(&case.scene, &run.record.rows, over.cycles);
            let time = rows.series(TIME.name)?;
            let begin = time.first().copied().unwrap_or(0.0);
            let since: Vec<f64> = time.iter().map(|t| 1e3 * (t - begin)).collect();
            Ok(Curve { label: case.label.clone(), points: points(&since, rows.series(&over.column)?) })
        })
        .collect::<Result<Vec<Curve>, StudyError>>()?;
    let label = label_of(&over.column);
    let chart = line_chart(&format!("{} over time", plain(&label)), "time [ms]", &label, &curves, false);
    Ok(Figure { text: left_out(study, findings), charts: chart.into_iter().collect() })
}

/// The quantities over the parameter, one chart each: a line, or dots where several cases have the same value.
fn over_value(study: &Study, runs: &[CaseResult], findings: &Findings) -> Figure {
    let charts = study.quantities.iter().enumerate().filter_map(|(k, quantity)| {
        let mut at: Vec<(f64, f64)> =
            with_result(study, runs, findings).map(|(case, _, found)| (case.value, found.quantities[k])).collect();
        at.sort_by(|a, b| a.0.total_cmp(&b.0));
        let name = label_of(&quantity.name());
        let title = format!("{} over {}", plain(&name), plain(&study.parameter));
        // Cases of one value are no curve: a line through them would go up and down.
        let several = at.windows(2).any(|pair| pair[0].0 == pair[1].0);
        let curve = [Curve { label: String::new(), points: at }];
        if several {
            dot_chart(&title, &study.parameter, &name, &curve)
        } else {
            line_chart(&title, &study.parameter, &name, &curve, false)
        }
    });
    Figure { text: left_out(study, findings), charts: charts.collect() }
}

/// Says which cases a figure of all is without.
fn left_out(study: &Study, findings: &Findings) -> String {
    match findings.without_result(study).as_slice() {
        [] => String::new(),
        labels => format!("Without {}: no result.", labels.join(", ")),
    }
}

fn points(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    x.iter().zip(y).map(|(x, y)| (*x, *y)).collect()
}

/// Mesh cycles since the beginning of the first one, from the phases: rows need not be evenly spaced.
fn mesh_cycles(phases: &[f64]) -> Vec<f64> {
    let mut whole = 0.0;
    let mut last = 0.0;
    let count = |phase: &f64| {
        if *phase < last - 0.5 {
            whole += 1.0;
        }
        last = *phase;
        whole + phase
    };
    phases.iter().map(count).collect()
}
