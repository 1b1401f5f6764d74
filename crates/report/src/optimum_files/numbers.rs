//! The answer about an optimisation of numbers: its search, and what the optimum is worth.

use std::collections::BTreeMap;

use analysis::remark::{self, Remark};
use answer::{Answer, Cost, Table};
use design::Stop;
use plan::{NumberOptimum, goal_of, goal_unit};
use scene::{Setting, optimum::NumberOptimisation, plan::PlanOutput};
use serde::Serialize;
use serde_json::json;

use super::{HELD, page::parameter_part, tables};
use crate::{
    ReportError, Written,
    charts::{Curve, line_chart},
    page::{Cell, Grid, Line, Page, Part, again, cost_part, counted},
    write_result,
};
use store::folder::ResultDirectory;

described::described! {
    /// Headline of an optimisation of numbers.
    #[derive(Serialize)]
    pub(super) struct NumberHeadline<'a> {
        /// mean absolute value of the goals at the start
        goal_start: f64,
        /// mean absolute value of the goals at the optimum
        goal_optimum: f64,
        /// evaluations of the search
        evaluations: usize,
        /// end of the search: `converged` or `evaluations`
        stop: Stop,
        /// share by which a limit is passed at the optimum
        over_limits: f64,
        /// parameters by their keys
        parameters: BTreeMap<&'a str, NumberParameter>,
        /// settings of the optimum for `ale-gear run`
        set: Vec<String>,
    }

    /// A parameter of an optimisation of numbers.
    #[derive(Serialize)]
    pub(super) struct NumberParameter {
        /// value at the start
        start: f64,
        /// value of the optimum
        value: f64,
        /// lower bound
        lowest: f64,
        /// upper bound
        highest: f64,
    }
}

/// What files of an optimisation of numbers are made of.
#[derive(Debug, Clone, Copy)]
pub struct NumberOptimumResult<'a> {
    /// What was asked.
    pub plan: &'a NumberOptimisation,
    /// The optimum.
    pub optimum: &'a NumberOptimum,
    /// The command that makes it again.
    pub again: &'a str,
}

impl NumberOptimumResult<'_> {
    fn goals(&self) -> [f64; 2] {
        [&self.optimum.before, &self.optimum.after].map(|numbers| goal_of(numbers, self.plan.goals.len()))
    }

    /// What a run of the optimum sets beside the document.
    fn settings(&self) -> Vec<String> {
        // Keys of a plan that was checked.
        let set = self.plan.settings_of(&self.optimum.values).unwrap_or_default();
        set.iter().map(Setting::word).collect()
    }

    /// The limits that the optimum passes; `None` where it holds them.
    pub fn passed_limits(&self) -> Option<Remark> {
        let limited = self.plan.limits.iter().zip(&self.optimum.after[self.plan.goals.len()..]);
        let passed = limited.filter(|(limit, value)| **value > (1.0 + HELD) * limit.most);
        let passed: Vec<String> = passed
            .map(|(limit, value)| format!("{} is {value:.4}, {} at the most", limit.output.name(), limit.most))
            .collect();
        (!passed.is_empty()).then(|| remark::limit_passed(passed.join("; ")))
    }
}

/// The answer about an optimisation of numbers: `steps`, and `numbers` before and after.
pub fn number_optimum_answer(of: &NumberOptimumResult<'_>, cost: Cost) -> Answer {
    let NumberOptimumResult { plan, optimum, .. } = *of;
    let [start, best] = of.goals();
    let parameters = plan.parameters.iter().zip(&optimum.values).map(|(p, value)| {
        (p.name(), NumberParameter { start: p.start, value: *value, lowest: p.bounds[0], highest: p.bounds[1] })
    });
    Answer {
        kind: "optimum",
        name: plan.name.clone(),
        inputs: json!({ "scene": plan.scene_file(), "goals": names(of) }),
        tables: vec![tables::steps(&plan.parameters, &optimum.found.steps, "goal"), numbers(of)],
        headline: json!(NumberHeadline {
            goal_start: start,
            goal_optimum: best,
            evaluations: optimum.found.steps.len(),
            stop: optimum.found.stop,
            over_limits: optimum.evaluation.over_limits(),
            parameters: parameters.collect(),
            set: of.settings(),
        }),
        remarks: of.passed_limits().into_iter().collect(),
        cost,
        ..Answer::default()
    }
}

fn names(of: &NumberOptimumResult<'_>) -> Vec<String> {
    of.plan.goals.iter().map(PlanOutput::name).collect()
}

/// `numbers`: a row a goal and a limited number.
fn numbers(of: &NumberOptimumResult<'_>) -> Table {
    let NumberOptimumResult { plan, optimum, .. } = *of;
    let outputs = plan.outputs();
    let limits: Vec<f64> = plan.limits.iter().map(|limit| limit.most).collect();
    table(&outputs, &[&optimum.before, &optimum.after], plan.goals.len(), &limits)
}

/// Numbers, `goals` goals first, with values before and after, and the limits of the others.
pub(super) fn table(outputs: &[PlanOutput], values: &[&[f64]; 2], goals: usize, limits: &[f64]) -> Table {
    let limits = std::iter::repeat_n(f64::NAN, goals).chain(limits.iter().copied());
    Table::new("numbers")
        .texts("number", "key of the headline", outputs.iter().map(PlanOutput::name))
        .texts(
            "role",
            "role of the number: `goal` or `limit`",
            (0..outputs.len()).map(|k| if k < goals { "goal" } else { "limit" }),
        )
        .numbers("before", "value at the start, in the unit of the key", values[0].iter().copied())
        .numbers("after", "value of the optimum, in the unit of the key", values[1].iter().copied())
        .numbers("limit", "largest allowed value; `NaN` of a goal", limits)
}

/// Writes the answer; what comes back is the closing table.
///
/// # Errors
/// When the system refuses.
pub fn write_number_optimum(
    of: &NumberOptimumResult<'_>,
    cost: Cost,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let answer = number_optimum_answer(of, cost);
    let page = page(of, &answer);
    write_result(answer, &page, false, results)
}

fn page(of: &NumberOptimumResult<'_>, answer: &Answer) -> Page {
    let NumberOptimumResult { plan, optimum, .. } = *of;
    let mut page = Page::of(answer, format!("optimisation of {}", counted(plan.parameters.len(), "parameter")));
    let [start, best] = of.goals();
    let unit = goal_unit(plan);
    page.push(Part::new("Before and after").closing().lines([
        Line::text("goal", names(of).join(", "), "mean absolute value"),
        Line::number("goal at the start", start, 4, &unit),
        Line::number(format!("optimum, {}", counted(optimum.found.steps.len(), "evaluation")), best, 4, &unit),
    ]));
    let rows = plan.outputs().into_iter().enumerate().map(|(k, output)| {
        let limit = k.checked_sub(plan.goals.len()).map(|k| plan.limits[k].most);
        vec![
            Cell::text(output.name()),
            Cell::number(optimum.before[k], 4),
            Cell::number(optimum.after[k], 4),
            limit.map_or_else(|| Cell::text(""), |most| Cell::number(most, 4)),
        ]
    });
    let head = ["number", "start", "optimum", "limit"];
    page.push(Part::new("Numbers").closing().grid(Grid::new(head).rows(rows)));
    let found = plan.parameters.iter().zip(&optimum.found.values).zip(&optimum.values);
    page.push(parameter_part(found.map(|((parameter, found), value)| (parameter, *found, *value))));
    let steps = optimum.found.steps.iter().enumerate();
    let goals = steps.filter_map(|(i, step)| Some(((i + 1) as f64, step.goal?))).collect();
    let curve = [Curve { label: "goal".to_owned(), points: goals }];
    page.push(Part::more().figures(line_chart("The search", "evaluation", "goal", &curve, false)));
    let run = format!("ale-gear run {} {} --out DIR", plan.scene_file().display(), of.settings().join(" "));
    page.push(Part::new("The optimum by itself").note(run));
    page.push(cost_part(&answer.cost));
    page.push(again(of.again));
    page
}
