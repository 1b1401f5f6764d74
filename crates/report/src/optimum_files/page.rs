//! `report.html` of an optimisation.

use analysis::optimum::Optimised;
use minijinja::{context, value::Serde};

use super::OptimumResult;
use crate::{
    ReportError,
    charts::{Curve, line_chart},
    page::Rendered,
};

pub(super) fn page(of: &OptimumResult<'_>) -> Result<Rendered, ReportError> {
    let OptimumResult { optimum, told, goals, .. } = *of;
    let plan = &optimum.plan;
    let mut charts: Vec<Option<String>> = Vec::new();
    for line in &told.torques {
        let curve = |label: &str, values: &Vec<f64>| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let at = |(i, v): (usize, &f64)| (i as f64 / values.len() as f64, v - mean);
            Curve { label: label.to_owned(), points: values.iter().enumerate().map(at).collect() }
        };
        let curves = [curve("before", &line.curves[0]), curve("after", &line.curves[1])];
        let title = format!("Static transmission error less its mean, {} N m", line.torque_nm);
        charts.push(line_chart(&title, "mesh phase", "STE less its mean [um]", &curves, false));
    }
    let harris = |label: &str, of: fn(&analysis::optimum::HarrisPoint) -> Option<f64>| Curve {
        label: label.to_owned(),
        points: told.harris.iter().filter_map(|p| Some((p.torque_nm, of(p)?))).collect(),
    };
    let over_torque = [harris("before", |p| p.peak_to_peak_before_um), harris("after", |p| p.peak_to_peak_after_um)];
    charts.push(line_chart(
        "Over the torque (Harris map)",
        "torque [N m]",
        "peak-to-peak STE [um]",
        &over_torque,
        true,
    ));
    let front = Curve {
        label: "optima".to_owned(),
        points: optimum.front.iter().map(|p| (p.max_pressure_mpa, p.goal_um)).collect(),
    };
    charts.push(line_chart(
        "What a lower pressure costs",
        "largest pressure [MPa]",
        "what was made small [um]",
        &[front],
        true,
    ));
    let charts: Vec<String> = charts.into_iter().flatten().collect();
    Rendered::new(
        "optimum.html",
        context! {
            name => &plan.name,
            version => env!("CARGO_PKG_VERSION"),
            goal => Optimised::goal_words(&plan.goal),
            goals => Serde(serde_json::to_value(goals).unwrap_or_default()),
            evaluations => optimum.found.steps.len(),
            charts => charts,
            torques => Serde(serde_json::to_value(&told.torques).unwrap_or_default()),
            influences => Serde(serde_json::to_value(&told.influences).unwrap_or_default()),
            warnings => of.warnings.to_vec(),
            again => of.again,
        },
    )
}
