//! `report.html` of a plan: how outputs are spread, what each axis does to them, and the cases as a table.

use answer::{Answer, label_of};
use scene::plan::{Plan, PlanAxis};
use study::correlation;

use super::{
    curves::{over_axes, plain},
    maps::maps,
    spread::Spread,
};
use plan::{Column, KnownCases};
use store::CASES;

use crate::{
    charts::{Curve, line_chart},
    page::{Cell, Grid, Page, Part, again, cost_part, counted},
};

/// Cases in the table of the page at most; `cases.csv` has all.
const MOST_ROWS: usize = 2000;

/// What a report of a plan says beside its numbers.
#[derive(Debug, Clone, Copy, Default)]
pub struct PageWords<'a> {
    /// The command that makes it again.
    pub again: &'a str,
    /// Cases that have a report of their own, in the folder [`report_folder`].
    pub reports: &'a [usize],
}

/// Folder of the report of a case, below that of the plan.
pub fn report_folder(case: usize) -> String {
    format!("{CASES}/{case}")
}

/// The page.
pub(super) fn page(plan: &Plan, known: &KnownCases, words: PageWords<'_>, answer: &Answer) -> Page {
    let axes: Vec<String> = plan.axes.iter().map(|axis| plain(&label_of(PlanAxis::name(axis))).to_owned()).collect();
    let mut page = Page::of(answer, format!("{} over {}", counted(known.count(), "case"), axes.join("; ")));
    page.push(numbers(known));
    page.push(Part::more().figures(known.outputs.iter().flat_map(|output| {
        let maps = maps(plan, known, output);
        maps.into_iter().chain(over_axes(plan, known, output)).chain(spread(output))
    })));
    page.push(together(known));
    page.push(cases(known, words.reports));
    page.push(cost_part(&answer.cost));
    page.push(
        again(words.again)
            .note("Add `--reports 10` for reports of the ten best cases, or `--report-case 3,17` for single cases."),
    );
    page
}

/// Distribution of each output over the cases.
fn numbers(known: &KnownCases) -> Part {
    let rows = known.outputs.iter().map(|output| {
        let spread = Spread::of(output.values.iter().copied());
        let [least, median, ninety, largest] =
            [0.0, 0.5, 0.9, 1.0].map(|share| Cell::significant(spread.quantile(share)));
        let case = output.ascending().first().map_or_else(|| "-".to_owned(), usize::to_string);
        vec![Cell::text(label_of(&output.name)), least, Cell::count(case), median, ninety, largest]
    });
    let head = ["quantity", "least", "in case", "median", "90 %", "largest"];
    Part::new("Results").closing().grid(Grid::new(head).rows(rows))
}

/// Correlation of outputs with axes.
fn together(known: &KnownCases) -> Part {
    let rows = known.axes.iter().map(|axis| {
        let with = known.outputs.iter().map(|output| Cell::number(pearson(&axis.values, &output.values), 3));
        std::iter::once(Cell::text(plain(&label_of(&axis.name)))).chain(with).collect()
    });
    let outputs = known.outputs.iter().map(|output| plain(&label_of(&output.name)).to_owned());
    let head = ["axis".to_owned()].into_iter().chain(outputs);
    let words = "Pearson's correlation coefficient over all cases: 1 or -1 for a linear relation, 0 for none.";
    Part::new("Correlation").words(words).grid(Grid::new(head).rows(rows))
}

/// The cases as a table to sort.
fn cases(known: &KnownCases, reports: &[usize]) -> Part {
    let shown = shown(known, reports);
    let mut words = String::new();
    if shown.len() < known.count() {
        words += &format!("The first {}; `cases.csv` has all. ", shown.len());
    }
    words += "A click on a heading sorts by it.";
    if !reports.is_empty() {
        words += " A case with a link has a report of its own.";
    }
    let columns = || known.axes.iter().chain(&known.outputs);
    let has_reasons = known.reasons.iter().any(|reason| !reason.is_empty());
    let reason = has_reasons.then(|| "reason".to_owned());
    let head = ["case".to_owned()].into_iter().chain(columns().map(|column| label_of(&column.name))).chain(reason);
    let rows = shown.into_iter().map(|case| {
        let link = reports.contains(&case).then(|| format!("{}/report.html", report_folder(case)));
        let number = Cell { link, ..Cell::count(case) };
        let numbers = columns().map(|column| Cell::significant(column.values[case]));
        let reason = has_reasons.then(|| Cell::text(&known.reasons[case]));
        std::iter::once(number).chain(numbers).chain(reason).collect()
    });
    Part::new("Cases").words(words).grid(Grid::new(head).rows(rows).sortable())
}

/// Cases of the table: the first ones, and all with a report of their own.
fn shown(known: &KnownCases, reports: &[usize]) -> Vec<usize> {
    let first = known.count().min(MOST_ROWS);
    let mut later: Vec<usize> = reports.iter().copied().filter(|&case| case >= first).collect();
    later.sort_unstable();
    (0..first).chain(later).collect()
}

/// Share of the cases that have no more than a value.
fn spread(output: &Column) -> Option<String> {
    let (name, sorted) = (&label_of(&output.name), output.ascending());
    let n = sorted.len() as f64;
    let share = |(i, &case): (usize, &usize)| (output.values[case], 100.0 * (i as f64 + 0.5) / n);
    let curve = Curve { label: String::new(), points: sorted.iter().enumerate().map(share).collect() };
    let title = format!("Distribution of {}", plain(name));
    line_chart(&title, name, "share of cases up to this value [%]", &[curve], true)
}

/// Pearson's coefficient over the cases that have a number; none where one of both does not vary.
fn pearson(at: &[f64], values: &[f64]) -> Option<f64> {
    let both = at.iter().zip(values).filter(|(a, v)| a.is_finite() && v.is_finite());
    let (a, v): (Vec<f64>, Vec<f64>) = both.map(|(a, v)| (*a, *v)).unzip();
    correlation(&a, &v).ok().flatten()
}
