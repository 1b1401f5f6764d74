//! Rows of an optimisation.

use analysis::optimum::{FrontPoint, HarrisPoint, Influence, TorqueLine};
use answer::Table;
use design::TakenStep;
use scene::optimum::DesignParameter;

const OF_PARAMETER: &str = "value of this parameter, in the unit of its key";

/// With a column a parameter, whose values are those of a row at its place.
fn with_parameters<'a>(
    mut table: Table,
    parameters: &[DesignParameter],
    rows: impl Iterator<Item = &'a Vec<f64>> + Clone,
) -> Table {
    for (k, parameter) in parameters.iter().enumerate() {
        table.push_numbers(parameter.name().to_owned(), OF_PARAMETER, rows.clone().map(|row| row[k]));
    }
    table
}

/// A row an evaluation of the search.
pub(super) fn steps(parameters: &[DesignParameter], steps: &[TakenStep], goal: &'static str) -> Table {
    let table = Table::new("steps")
        .numbers("evaluation", "number of the evaluation, from 1", (1..=steps.len()).map(|i| i as f64))
        .numbers(goal, "value of the goal; `NaN` without a result", steps.iter().map(|s| s.goal.unwrap_or(f64::NAN)))
        .numbers("over_limits", "largest share by which a limit is passed", steps.iter().map(|s| s.over_limits))
        .texts(
            "taken",
            "`true` where the search went on from this evaluation",
            steps.iter().map(|s| s.taken.to_string()),
        );
    with_parameters(table, parameters, steps.iter().map(|s| &s.values))
}

/// A row a torque that counts.
pub(super) fn torques(lines: &[TorqueLine]) -> Table {
    let column = |of: fn(&TorqueLine) -> f64| lines.iter().map(of);
    let (ste, pressure) = ("peak to peak of the STE", "largest contact pressure");
    let edge = "largest contact pressure at end faces and tip edges";
    Table::new("torques")
        .numbers("torque_nm", "torque of the driven gear", column(|t| t.torque_nm))
        .numbers("peak_to_peak_before_um", format!("{ste} at the start"), column(|t| t.peak_to_peak_before_um))
        .numbers("peak_to_peak_after_um", format!("{ste} of the optimum"), column(|t| t.peak_to_peak_after_um))
        .numbers("max_pressure_before_mpa", format!("{pressure} at the start"), column(|t| t.max_pressure_before_mpa))
        .numbers("max_pressure_after_mpa", format!("{pressure} of the optimum"), column(|t| t.max_pressure_after_mpa))
        .numbers("max_edge_pressure_before_mpa", format!("{edge}, start"), column(|t| t.max_edge_pressure_before_mpa))
        .numbers("max_edge_pressure_after_mpa", format!("{edge}, optimum"), column(|t| t.max_edge_pressure_after_mpa))
}

/// A row a torque.
pub(super) fn harris(points: &[HarrisPoint]) -> Table {
    let known = |of: fn(&HarrisPoint) -> Option<f64>| points.iter().map(move |p| of(p).unwrap_or(f64::NAN));
    Table::new("harris")
        .numbers("torque_nm", "torque of the driven gear", points.iter().map(|p| p.torque_nm))
        .numbers(
            "peak_to_peak_before_um",
            "peak to peak of the STE at the start; `NaN` without a result",
            known(|p| p.peak_to_peak_before_um),
        )
        .numbers(
            "peak_to_peak_after_um",
            "peak to peak of the STE of the optimum; `NaN` without a result",
            known(|p| p.peak_to_peak_after_um),
        )
}

/// A row a parameter.
pub(super) fn influences(all: &[Influence]) -> Table {
    let column = |of: fn(&Influence) -> f64| all.iter().map(of);
    Table::new("influences")
        .texts("key", "key of the parameter", all.iter().map(|i| i.key.clone()))
        .numbers("lowest", "lower bound", column(|i| i.lowest))
        .numbers("highest", "upper bound", column(|i| i.highest))
        .numbers("start", "value at the start", column(|i| i.start))
        .numbers("found", "value that the search found", column(|i| i.found))
        .numbers("value", "value that a machine can be set to", column(|i| i.value))
        .numbers(
            "step",
            "step of the two changes of the goal: that of the machine, else a hundredth of the bounds",
            column(|i| i.step),
        )
        .numbers(
            "goal_change_less_um",
            "change of the goal with one step less, to first order",
            column(|i| i.goal_change_less_um),
        )
        .numbers(
            "goal_change_more_um",
            "change of the goal with one step more, to first order",
            column(|i| i.goal_change_more_um),
        )
}

/// A row a limit of the pressure.
pub(super) fn front(parameters: &[DesignParameter], front: &[FrontPoint]) -> Table {
    let table = Table::new("front")
        .numbers(
            "limit_mpa",
            "limit of the pressure; `NaN` without one",
            front.iter().map(|p| p.limit_mpa.unwrap_or(f64::NAN)),
        )
        .numbers("max_pressure_mpa", "largest contact pressure", front.iter().map(|p| p.max_pressure_mpa))
        .numbers("goal_um", "value of the goal", front.iter().map(|p| p.goal_um));
    with_parameters(table, parameters, front.iter().map(|p| &p.values))
}
