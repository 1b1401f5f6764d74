//! The table of a study on the terminal, and the same as CSV.

use std::fmt::Write;

use analysis::{accuracy_chart::SpeedUp, parameter_study::Findings};
use scene::study::Study;

use super::{CaseResult, StudyResult};
use crate::{
    csv::{always_quoted, push_row},
    tables::fixed,
};

/// One row a case.
pub const STUDY_FILE: &str = "study.csv";

/// A number of every case.
struct Line {
    name: String,
    values: Vec<Option<f64>>,
    decimals: usize,
}

/// The lines of either table, in their order.
fn lines(study: &Study, findings: &Findings) -> Vec<Line> {
    let cases = || findings.cases.iter().map(|c| c.as_ref().ok());
    let ratio = |k: usize| cases().map(|c| Some(c?.contact_ratios[k])).collect();
    let mut all: Vec<Line> = ["eps_alpha", "eps_beta", "eps_gamma"]
        .iter()
        .enumerate()
        .map(|(k, name)| Line { name: (*name).to_owned(), values: ratio(k), decimals: 4 })
        .collect();
    all.extend(study.quantities.iter().enumerate().map(|(k, quantity)| Line {
        name: quantity.name(),
        values: cases().map(|c| Some(c?.quantities[k]).filter(|v| v.is_finite())).collect(),
        decimals: 3,
    }));
    all.extend(findings.followers.iter().map(|f| Line { name: f.name(), values: f.correlation.clone(), decimals: 4 }));
    all
}

/// `study.csv`: one row a case; the last column says why a case has no result, and is empty where it has one.
pub fn study_csv(study: &Study, findings: &Findings) -> String {
    let lines = lines(study, findings);
    let names: Vec<&str> = lines.iter().map(|l| l.name.as_str()).collect();
    let mut csv = format!("label,value,{},reason\n", names.join(","));
    for (i, case) in study.cases.iter().enumerate() {
        let _ = write!(csv, "{},", always_quoted(&case.label));
        let values = lines.iter().map(|l| l.values[i].unwrap_or(f64::NAN));
        push_row(&mut csv, std::iter::once(case.value).chain(values));
        // Behind the numbers, on their line.
        csv.pop();
        let _ = writeln!(csv, ",{}", findings.reason(i).map(always_quoted).unwrap_or_default());
    }
    csv
}

/// Width of a column at the most: longer labels stand out, and none of 65536 characters can be a width at all.
const WIDEST: usize = 200;

/// The closing table: a column a case, what the whole model took, phases, warnings.
pub fn study_table(of: StudyResult<'_>) -> String {
    let StudyResult { study, runs, findings, speed_up, cost, warnings, .. } = of;
    let lines = lines(study, findings);
    let label_width = lines.iter().map(|l| l.name.len()).max().unwrap_or(0).max(study.parameter.len()).min(WIDEST);
    let width = study.cases.iter().map(|c| c.label.chars().count()).max().unwrap_or(0).clamp(11, WIDEST);
    let mut t = format!("{}\n\n  {:<label_width$}", study.name, "");
    // Writing to a String cannot fail.
    for case in &study.cases {
        let _ = write!(t, " {:>width$}", case.label);
    }
    let _ = write!(t, "\n  {:<label_width$}", study.parameter);
    for case in &study.cases {
        let _ = write!(t, " {:>width$}", case.value);
    }
    t.push('\n');
    for line in &lines {
        let _ = write!(t, "  {:<label_width$}", line.name);
        for value in &line.values {
            let text = value.map_or_else(|| "-".to_owned(), |v| fixed(v, line.decimals));
            let _ = write!(t, " {text:>width$}");
        }
        t.push('\n');
    }
    let _ = write!(t, "  {:<label_width$}", "wall time, s");
    for run in runs {
        let text = run.as_ref().map_or_else(|_| "-".to_owned(), |run| format!("{:.2}", run.cost.wall_s));
        let _ = write!(t, " {text:>width$}");
    }
    t.push('\n');
    if let (Some(s), Some(full)) = (speed_up, study.full) {
        let _ = writeln!(t, "\n{}", speed_up_text(s, &study.cases[full.case].label, step_s(runs, full.case)));
    }
    let _ = writeln!(t, "\n  wall time {:.2} s on {} threads", cost.wall_s, cost.threads);
    for warning in warnings {
        let _ = writeln!(t, "\nwarning: {warning}");
    }
    t
}

/// Wall time of a step in time of a case, s; `None` at rest and without a result.
pub(super) fn step_s(runs: &[CaseResult], case: usize) -> Option<f64> {
    runs[case].as_ref().ok()?.step_s()
}

/// What was compared, in words.
pub(super) fn speed_up_text(s: &SpeedUp, label: &str, step_s: Option<f64>) -> String {
    let mut text = format!(
        "Every degree of freedom kept ({label}, at rest, {} of {} positions run): {:.3} s a position, {} DOF. Reduced on the same meshes: {:.3} ms a \
         position, {} DOF kept: {:.0} times faster; the first cycle with everything before it {:.0} times. Transmission errors differ by {:.1e} of \
         their mean.",
        s.full_positions_run,
        s.positions_of_cycle,
        s.full_position_s,
        s.dof,
        1e3 * s.reduced_position_s,
        s.dof_kept,
        s.times_faster_position,
        s.times_faster_first_cycle,
        s.relative_difference_of_ste.abs(),
    );
    if let Some(step) = step_s {
        let _ = write!(
            text,
            " A step in time of the reduced pair took {:.3} ms: {:.0} times faster than one position of the whole model, of which a step in time would \
             solve at least one.",
            1e3 * step,
            s.full_position_s / step
        );
    }
    text
}
