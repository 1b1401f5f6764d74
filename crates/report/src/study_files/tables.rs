//! Rows of a study, and what it took against every degree of freedom.

use std::fmt::Write;

use analysis::{accuracy_chart::SpeedUp, parameter_study::Findings};
use answer::{Table, label_of};
use scene::study::Study;

use super::CaseResult;
use crate::{
    page::{Cell, Grid},
    plan_files::plain,
};

/// A number of every case.
struct Line {
    name: String,
    /// Name in words, for a page.
    label: String,
    meaning: &'static str,
    values: Vec<Option<f64>>,
}

/// All numbers, in their order.
fn lines(study: &Study, findings: &Findings) -> Vec<Line> {
    let cases = || findings.cases.iter().map(|c| c.as_ref().ok());
    let ratio = |k: usize| cases().map(|c| Some(c?.contact_ratios[k])).collect();
    let ratios = [
        ("eps_alpha", "transverse contact ratio"),
        ("eps_beta", "overlap ratio"),
        ("eps_gamma", "total contact ratio"),
    ];
    let ratios = ratios.into_iter().enumerate();
    let mut all: Vec<Line> = ratios
        .map(|(k, (name, meaning))| Line {
            name: name.to_owned(),
            label: meaning.to_owned(),
            meaning,
            values: ratio(k),
        })
        .collect();
    all.extend(study.quantities.iter().enumerate().map(|(k, quantity)| Line {
        name: quantity.name(),
        label: label_of(&quantity.name()),
        meaning: "quantity of the study, by its `take` and column",
        values: cases().map(|c| Some(c?.quantities[k]).filter(|v| v.is_finite())).collect(),
    }));
    all.extend(findings.followers.iter().map(|f| Line {
        name: f.name(),
        label: format!("correlation of {} with {}", plain(&label_of(&f.column)), plain(&label_of(&f.beside))),
        meaning: "Pearson's correlation coefficient of two columns over all rows of the case; `NaN` where one does not vary",
        values: f.correlation.clone(),
    }));
    all
}

/// One row a case; the last column says why a case has no result, and is empty where it has one.
pub(crate) fn study(study: &Study, findings: &Findings) -> Table {
    let mut table = Table::new("study")
        .texts("label", "name of the case", study.cases.iter().map(|case| case.label.clone()))
        .numbers("value", "value of the parameter", study.cases.iter().map(|case| case.value));
    for line in lines(study, findings) {
        table.push_numbers(line.name, line.meaning, line.values.iter().map(|v| v.unwrap_or(f64::NAN)));
    }
    let reasons = (0..study.cases.len()).map(|i| findings.reason(i).unwrap_or_default());
    table.texts("reason", "reason why the case has no result; empty where it has one", reasons)
}

/// A column a case.
pub(super) fn grid(study: &Study, runs: &[CaseResult], findings: &Findings) -> Grid {
    let head = std::iter::once("").chain(study.cases.iter().map(|case| case.label.as_str()));
    let row =
        |name: &str, cells: &mut dyn Iterator<Item = Cell>| std::iter::once(Cell::text(name)).chain(cells).collect();
    let parameter = row(&study.parameter, &mut study.cases.iter().map(|case| Cell::count(case.value)));
    let numbers = lines(study, findings)
        .into_iter()
        .map(|line| row(&line.label, &mut line.values.iter().map(|value| Cell::significant(*value))));
    let wall_s = |run: &CaseResult| run.as_ref().ok().map(|run| run.cost.wall_s);
    let wall = row("wall time, s", &mut runs.iter().map(|run| Cell::number(wall_s(run), 2)));
    Grid::new(head).rows([parameter]).rows(numbers).rows([wall])
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
