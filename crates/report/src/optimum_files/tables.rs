//! `steps.csv`, `harris.csv`, `influences.csv`, `front.csv`, and the closing table.

use std::fmt::Write;

use analysis::optimum::Optimised;
use scene::optimum::{DesignParameter, Optimisation};

use super::OptimumResult;
use crate::csv::quoted;

/// Empty where there is no number.
fn cell(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(String::new, |v| v.to_string())
}

fn keys(plan: &Optimisation) -> String {
    plan.parameters.iter().map(|p| format!(",{}", quoted(p.name()))).collect()
}

fn values(list: &[f64]) -> String {
    list.iter().map(|v| format!(",{v}")).collect()
}

/// A row an evaluation of the search.
pub(super) fn steps_csv(of: &OptimumResult<'_>) -> String {
    let mut t = format!("evaluation,goal_um,over_limits,taken{}\n", keys(&of.optimum.plan));
    for (i, step) in of.optimum.found.steps.iter().enumerate() {
        let (goal, over) = (cell(step.goal), cell(Some(step.over_limits)));
        // Writing to a String cannot fail.
        let _ = writeln!(t, "{},{goal},{over},{}{}", i + 1, step.taken, values(&step.values));
    }
    t
}

/// A row a torque.
pub(super) fn harris_csv(of: &OptimumResult<'_>) -> String {
    let mut t = "torque_nm,peak_to_peak_before_um,peak_to_peak_after_um\n".to_owned();
    for point in &of.told.harris {
        let [before, after] = [point.peak_to_peak_before_um, point.peak_to_peak_after_um].map(cell);
        let _ = writeln!(t, "{},{before},{after}", point.torque_nm);
    }
    t
}

/// A row a parameter.
pub(super) fn influences_csv(of: &OptimumResult<'_>) -> String {
    let mut t = "key,lowest,highest,start,found,value,step,goal_change_less_um,goal_change_more_um\n".to_owned();
    for i in &of.told.influences {
        let numbers =
            [i.lowest, i.highest, i.start, i.found, i.value, i.step, i.goal_change_less_um, i.goal_change_more_um];
        let _ = writeln!(t, "{}{}", quoted(&i.key), values(&numbers));
    }
    t
}

/// A row a limit of the pressure.
pub(super) fn front_csv(of: &OptimumResult<'_>) -> String {
    let mut t = format!("limit_mpa,max_pressure_mpa,goal_um{}\n", keys(&of.optimum.plan));
    for point in &of.optimum.front {
        let limit = cell(point.limit_mpa);
        let _ = writeln!(t, "{limit},{},{}{}", point.max_pressure_mpa, point.goal_um, values(&point.values));
    }
    t
}

/// What a user reads when it is done.
pub(super) fn closing_table(of: &OptimumResult<'_>) -> String {
    let OptimumResult { optimum, told, cost, goals, .. } = *of;
    let plan = &optimum.plan;
    let mut t = format!("{} ({} parameters)\n\n", plan.name, plan.parameters.len());
    let _ = writeln!(t, "  {}, um", Optimised::goal_words(&plan.goal));
    let _ = writeln!(t, "  {:<44} {:>10.4}", "start", goals.start_um);
    let _ =
        writeln!(t, "  {:<44} {:>10.4}", format!("found in {} evaluations", optimum.found.steps.len()), goals.found_um);
    let _ = writeln!(t, "  {:<44} {:>10.4}", "with values that a machine can be set to", goals.optimum_um);
    let _ = writeln!(t, "\n  {:<44} {:>10} {:>10} {:>10}", "parameter", "start", "found", "set to");
    for (parameter, influence) in plan.parameters.iter().zip(&told.influences) {
        let name = parameter.name();
        let at = bound(parameter, influence.value);
        let _ = writeln!(
            t,
            "  {name:<44} {:>10.3} {:>10.3} {:>10.3}{at}",
            influence.start, influence.found, influence.value
        );
    }
    let _ = writeln!(t, "\n  {:>12} {:>24} {:>28}", "torque [N m]", "peak to peak STE [um]", "largest pressure [MPa]");
    for line in &told.torques {
        let _ = writeln!(
            t,
            "  {:>12} {:>11.4} -> {:>9.4} {:>14.1} -> {:>10.1}",
            line.torque_nm,
            line.peak_to_peak_before_um,
            line.peak_to_peak_after_um,
            line.max_pressure_before_mpa,
            line.max_pressure_after_mpa
        );
    }
    for warning in of.warnings {
        let _ = writeln!(t, "\n  warning: {warning}");
    }
    let _ = writeln!(t, "\n  wall time {:.2} s", cost.wall_s);
    t
}

fn bound(parameter: &DesignParameter, value: f64) -> &'static str {
    let [low, high] = parameter.bounds;
    let near = 1e-6 * (high - low);
    if value - low <= near {
        "  lowest"
    } else if high - value <= near {
        "  highest"
    } else {
        ""
    }
}
