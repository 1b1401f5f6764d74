//! `report.html` and closing table of an optimisation.

use analysis::optimum::{HarrisPoint, Optimised};
use answer::{Answer, label_of, shown_units, unit_of};
use scene::optimum::DesignParameter;

use super::{Goals, OptimumResult};
use crate::{
    charts::{Curve, line_chart},
    page::{Cell, Grid, Line, Page, Part, again, cost_part, counted},
    plan_files::plain,
};

pub(super) fn page(of: &OptimumResult<'_>, answer: &Answer) -> Page {
    let OptimumResult { optimum, summary, .. } = *of;
    let plan = &optimum.plan;
    let mut page = Page::of(answer, format!("optimisation of {}", counted(plan.parameters.len(), "parameter")));
    page.push(goal(of));
    let values = plan.parameters.iter().zip(&optimum.values);
    page.push(grind(values.map(|(own, value)| (own.name(), own.start, *value)), |_| None));
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
        Line::number("rounded to machine settings", goals.goal_optimum_um, 4, "um"),
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
            Cell::text(label_of(parameter.name())),
            Cell::significant(parameter.bounds[0]),
            Cell::significant(parameter.bounds[1]),
            Cell::significant(parameter.start),
            Cell::significant(found),
            Cell::significant(value),
            Cell::text(at_bound(parameter, value)),
        ]
    });
    let head = ["parameter", "lower bound", "upper bound", "start", "found", "rounded", ""];
    Part::new("Parameters").closing().grid(Grid::new(head).rows(rows))
}

/// Modifications of the optimum, gear by gear, for the workshop; empty if no parameter is one. `parameters`: key, value
/// at the start, value of the optimum; `gear`: name of the gear with keys of a prefix, `None` for its place in the pair.
pub(super) fn grind<'a>(
    parameters: impl Iterator<Item = (&'a str, f64, f64)>,
    gear: impl Fn(&str) -> Option<String>,
) -> Part {
    let rows = parameters.filter_map(|(key, before, value)| {
        let (place, name) = key.split_once(".modification.")?;
        let (flanks, name) = match name.split_once('.') {
            Some(("drive", name)) => ("driving", name),
            Some(("coast", name)) => ("coast", name),
            _ => ("both", name),
        };
        let label = label_of(name);
        Some(vec![
            Cell::text(gear(place).unwrap_or_else(|| place.replace('.', " "))),
            Cell::text(flanks),
            Cell::text(plain(&label)),
            Cell::significant(before),
            Cell::significant(value),
            Cell::text(shown_units(&unit_of(name))),
        ])
    });
    let head = ["gear", "flanks", "modification", "before", "grind", ""];
    let part = Part::new("Grind this").closing().grid(Grid::new(head).rows(rows));
    if part.contents.is_empty() {
        return part;
    }
    part.note("Values are rounded to machine settings. A positive lead slope removes more material at +z than at -z.")
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
            Cell::significant(t.torque_nm),
            Cell::significant(t.peak_to_peak_before_um),
            Cell::significant(t.peak_to_peak_after_um),
            Cell::significant(t.max_pressure_before_mpa),
            Cell::significant(t.max_pressure_after_mpa),
        ]
    });
    let head = ["torque [N m]", "STE at start [um]", "optimum [um]", "pressure at start [MPa]", "optimum [MPa]"];
    Part::new("Results by torque").closing().grid(Grid::new(head).rows(rows)).note(
        "Peak to peak of the static transmission error (STE) and largest contact pressure, for the nominal design without \
         deviations.",
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
        line_chart(
            "Transmission error over torque (Harris map)",
            "torque [N m]",
            "peak-to-peak STE [um]",
            &over_torque,
            true,
        ),
        line_chart("Goal against a lower pressure limit", "largest pressure [MPa]", "goal [um]", &front, true),
    ];
    over_phase.chain(last.into_iter().flatten()).collect()
}

fn influences(summary: &Optimised) -> Part {
    let rows = summary.influences.iter().map(|i| {
        vec![
            Cell::text(label_of(&i.key)),
            Cell::significant(i.step),
            Cell::significant(i.goal_change_less_um),
            Cell::significant(i.goal_change_more_um),
        ]
    });
    let head = ["parameter", "step", "goal change, step down [um]", "step up [um]"];
    Part::new("Sensitivity to machine settings")
        .grid(Grid::new(head).rows(rows))
        .note("First-order change of the goal by one step of the machine, from the derivatives at the optimum.")
}
