//! `report.html` and closing table of an optimisation.

use analysis::optimum::{HarrisPoint, Optimised};
use answer::Answer;
use scene::optimum::DesignParameter;

use super::{Goals, OptimumResult};
use crate::{
    charts::{Curve, line_chart},
    page::{Cell, Grid, Line, Page, Part, again, cost_part, counted},
};

pub(super) fn page(of: &OptimumResult<'_>, answer: &Answer) -> Page {
    let OptimumResult { optimum, summary, .. } = *of;
    let plan = &optimum.plan;
    let mut page = Page::of(answer, format!("optimisation of {}", counted(plan.parameters.len(), "parameter")));
    page.push(goal(of));
    page.push(parameters(of));
    page.push(torques(summary));
    page.push(Part::more().figures(charts(of)));
    page.push(influences(summary));
    page.push(cost_part(&answer.cost));
    page.push(again(of.again));
    page
}

fn goal(of: &OptimumResult<'_>) -> Part {
    let optimum = of.optimum;
    let goals = Goals::of(optimum);
    Part::new("Before and after").closing().lines([
        Line::text("goal", Optimised::goal_words(&optimum.plan.goal), ""),
        Line::number("goal at the start", goals.goal_start_um, 4, "um"),
        Line::number(
            format!("found in {}", counted(optimum.found.steps.len(), "evaluation")),
            goals.goal_found_um,
            4,
            "um",
        ),
        Line::number("with values that a machine can be set to", goals.goal_optimum_um, 4, "um"),
    ])
}

fn parameters(of: &OptimumResult<'_>) -> Part {
    let all = of.optimum.plan.parameters.iter().zip(&of.summary.influences);
    parameter_part(all.map(|(parameter, i)| (parameter, i.found, i.value)))
}

/// Parameters with the values of the search and those that a machine can be set to.
pub(super) fn parameter_part<'a>(all: impl Iterator<Item = (&'a DesignParameter, f64, f64)>) -> Part {
    let rows = all.map(|(parameter, found, value)| {
        vec![
            Cell::text(parameter.name()),
            Cell::number(parameter.bounds[0], 3),
            Cell::number(parameter.bounds[1], 3),
            Cell::number(parameter.start, 3),
            Cell::number(found, 3),
            Cell::number(value, 3),
            Cell::text(at_bound(parameter, value)),
        ]
    });
    let head = ["parameter", "lower bound", "upper bound", "start", "found", "set to", ""];
    Part::new("Parameters").closing().grid(Grid::new(head).rows(rows))
}

/// Which bound a value lies on.
fn at_bound(parameter: &DesignParameter, value: f64) -> &'static str {
    let [low, high] = parameter.bounds;
    let near = 1e-6 * (high - low);
    match () {
        () if value - low <= near => "at its lower bound",
        () if high - value <= near => "at its upper bound",
        () => "",
    }
}

fn torques(summary: &Optimised) -> Part {
    let rows = summary.torques.iter().map(|t| {
        vec![
            Cell::number(t.torque_nm, 1),
            Cell::number(t.peak_to_peak_before_um, 4),
            Cell::number(t.peak_to_peak_after_um, 4),
            Cell::number(t.max_pressure_before_mpa, 1),
            Cell::number(t.max_pressure_after_mpa, 1),
        ]
    });
    let head = ["torque N m", "p-p STE um", "optimum um", "largest MPa", "optimum MPa"];
    Part::new("Torques that count").closing().grid(Grid::new(head).rows(rows)).note(
        "Peak to peak of the static transmission error and largest contact pressure at the start and of the optimum, as \
         the drawing says and without deviations.",
    )
}

fn charts(of: &OptimumResult<'_>) -> Vec<String> {
    let OptimumResult { optimum, summary, .. } = *of;
    let over_phase = summary.torques.iter().filter_map(|line| {
        let curve = |label: &str, values: &Vec<f64>| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let at = |(i, v): (usize, &f64)| (i as f64 / values.len() as f64, v - mean);
            Curve { label: label.to_owned(), points: values.iter().enumerate().map(at).collect() }
        };
        let curves = [curve("start", &line.curves[0]), curve("optimum", &line.curves[1])];
        let title = format!("Static transmission error less its mean, {} N m", line.torque_nm);
        line_chart(&title, "mesh phase", "STE less its mean [um]", &curves, false)
    });
    let harris = |label: &str, value: fn(&HarrisPoint) -> Option<f64>| Curve {
        label: label.to_owned(),
        points: summary.harris.iter().filter_map(|p| Some((p.torque_nm, value(p)?))).collect(),
    };
    let over_torque = [harris("start", |p| p.peak_to_peak_before_um), harris("optimum", |p| p.peak_to_peak_after_um)];
    let front = optimum.front.iter().map(|p| (p.max_pressure_mpa, p.goal_um)).collect();
    let front = [Curve { label: "optima".to_owned(), points: front }];
    let last = [
        line_chart("Over the torque (Harris map)", "torque [N m]", "peak-to-peak STE [um]", &over_torque, true),
        line_chart("What a lower pressure costs", "largest pressure [MPa]", "goal [um]", &front, true),
    ];
    over_phase.chain(last.into_iter().flatten()).collect()
}

fn influences(summary: &Optimised) -> Part {
    let rows = summary.influences.iter().map(|i| {
        vec![
            Cell::text(&i.key),
            Cell::number(i.step, 3),
            Cell::number(i.goal_change_less_um, 4),
            Cell::number(i.goal_change_more_um, 4),
        ]
    });
    let head = ["parameter", "step", "goal, step less um", "goal, step more um"];
    Part::new("What a step of the machine changes")
        .grid(Grid::new(head).rows(rows))
        .note("Changes of the goal by a step are of first order, from the derivatives at the optimum.")
}
