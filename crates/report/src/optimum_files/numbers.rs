//! The answer about an optimisation of numbers: its search, and what the optimum is worth.

use std::collections::BTreeMap;

use analysis::remark::{self, Remark};
use answer::{Answer, Cost, Table, label_of};
use design::Stop;
use plan::{NumberOptimum, goal_of, goal_unit};
use scene::{
    Machine, Setting,
    optimum::{NumberLimit, NumberLoad, NumberOptimisation},
    plan::PlanOutput,
};
use serde::Serialize;
use serde_json::json;

use super::{
    HELD,
    page::{grind, parameter_part},
    tables,
};
use crate::{
    ReportError, Written,
    charts::{Curve, line_chart},
    page::{Cell, Content, Grid, Line, Page, Part, again, cost_part, counted},
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
        let under = |(load, after): (&NumberLoad, &Vec<f64>)| {
            let limited = self.plan.limits.iter().zip(&after[self.plan.goals.len()..]);
            let passed = limited.filter(|(limit, value)| **value > (1.0 + HELD) * limit.most);
            let at = if self.plan.loads.len() > 1 { format!(" at {} N m", load.torque_nm) } else { String::new() };
            let told = |(limit, value): (&NumberLimit, &f64)| {
                format!("{} is {value:.4}{at}, {} at the most", limit.output.name(), limit.most)
            };
            passed.map(told).collect::<Vec<_>>()
        };
        let passed: Vec<String> = self.plan.loads.iter().zip(&self.optimum.after).flat_map(under).collect();
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
        inputs: json!({
            "scene": plan.scene_file(),
            "goals": names(of),
            "torques_nm": plan.loads.iter().map(|load| load.torque_nm).collect::<Vec<_>>(),
        }),
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
    let goals = plan.goals.len();
    let rows = plan.loads.iter().enumerate().flat_map(|(i, load)| {
        let row = |(k, output): (usize, &PlanOutput)| NumberRow {
            torque_nm: load.torque_nm,
            number: output.name(),
            values: [optimum.before[i][k], optimum.after[i][k]],
            limit: k.checked_sub(goals).map(|k| plan.limits[k].most),
        };
        outputs.iter().enumerate().map(row).collect::<Vec<_>>()
    });
    table(&rows.collect::<Vec<_>>())
}

/// A goal, or a number with its limit, under a load.
pub(super) struct NumberRow {
    torque_nm: f64,
    number: String,
    /// Before and after.
    values: [f64; 2],
    limit: Option<f64>,
}

/// Numbers with values before and after, goals first, load by load.
pub(super) fn table(rows: &[NumberRow]) -> Table {
    Table::new("numbers")
        .numbers(
            "torque_nm",
            "torque on the driven gear, of a gearbox the first one",
            rows.iter().map(|row| row.torque_nm),
        )
        .texts("number", "key of the headline", rows.iter().map(|row| row.number.clone()))
        .texts(
            "role",
            "role of the number: `goal` or `limit`",
            rows.iter().map(|row| if row.limit.is_some() { "limit" } else { "goal" }),
        )
        .numbers("before", "value at the start, in the unit of the key", rows.iter().map(|row| row.values[0]))
        .numbers("after", "value of the optimum, in the unit of the key", rows.iter().map(|row| row.values[1]))
        .numbers(
            "limit",
            "largest allowed value; `NaN` of a goal",
            rows.iter().map(|row| row.limit.unwrap_or(f64::NAN)),
        )
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

/// Name of the gear that a key such as `mesh.0.scene.pinion` stands for; `None` of a pair, whose gears have no names.
fn gear_name(machine: Option<&Machine>, place: &str) -> Option<String> {
    let Machine::Gearbox(file) = machine? else { return None };
    let (mesh, end) = place.strip_prefix("mesh.")?.split_once(".scene.")?;
    let mesh = file.meshes.get(mesh.parse::<usize>().ok()?)?;
    let gear = mesh.gears[usize::from(end.starts_with("wheel"))];
    Some(file.gears.get(gear)?.name.clone())
}

fn page(of: &NumberOptimumResult<'_>, answer: &Answer) -> Page {
    let NumberOptimumResult { plan, optimum, .. } = *of;
    let mut page = Page::of(answer, format!("optimisation of {}", counted(plan.parameters.len(), "parameter")));
    let [start, best] = of.goals();
    let unit = goal_unit(plan);
    page.push(Part::new("Before and after").closing().lines([
        Line::text(
            if plan.goals.len() > 1 { "goal: mean of the magnitudes" } else { "goal" },
            names(of).iter().map(|name| label_of(name)).collect::<Vec<_>>().join(", "),
            "",
        ),
        Line::number("goal at the start", start, 4, &unit),
        Line::number(format!("optimum, {}", counted(optimum.found.steps.len(), "evaluation")), best, 4, &unit),
    ]));
    let machine = plan.machine(&optimum.values).ok();
    let values = plan.parameters.iter().zip(&optimum.values).map(|(own, value)| (own.name(), own.start, *value));
    page.push(grind(values, |place| gear_name(machine.as_ref(), place)));
    let several = plan.loads.len() > 1;
    let outputs = plan.outputs();
    let rows = plan.loads.iter().enumerate().flat_map(|(i, load)| {
        let row = |(k, output): (usize, &PlanOutput)| {
            let limit = k.checked_sub(plan.goals.len()).map(|k| plan.limits[k].most);
            let mut row = vec![
                Cell::text(label_of(&output.name())),
                Cell::significant(optimum.before[i][k]),
                Cell::significant(optimum.after[i][k]),
                limit.map_or_else(|| Cell::count(""), Cell::significant),
            ];
            if several {
                row.insert(1, Cell::significant(load.torque_nm));
            }
            row
        };
        outputs.iter().enumerate().map(row).collect::<Vec<_>>()
    });
    let mut head = vec!["quantity", "start", "optimum", "limit"];
    if several {
        head.insert(1, "torque [N m]");
    }
    page.push(Part::new("Results").closing().grid(Grid::new(head).rows(rows)));
    let found = plan.parameters.iter().zip(&optimum.found.values).zip(&optimum.values);
    page.push(parameter_part(found.map(|((parameter, found), value)| (parameter, *found, *value))));
    let steps = optimum.found.steps.iter().enumerate();
    let goals = steps.filter_map(|(i, step)| Some(((i + 1) as f64, step.goal?))).collect();
    let goal = match &plan.goals[..] {
        [only] => label_of(&only.name()),
        _ if unit.is_empty() => "mean of the goals".to_owned(),
        _ => format!("mean of the goals [{unit}]"),
    };
    let curve = [Curve { label: "goal".to_owned(), points: goals }];
    page.push(Part::more().figures(line_chart("The search", "evaluation", &goal, &curve, false)));
    let run = format!("ale-gear run {} {} --out DIR", plan.scene_file().display(), of.settings().join(" "));
    page.push(Part::new("Run the optimum").with(Content::Plain(run)));
    page.push(cost_part(&answer.cost));
    page.push(again(of.again));
    page
}
