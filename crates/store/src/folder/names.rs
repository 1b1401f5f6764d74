//! Names of all files that a result may hold: what a killed run has left is known by them, since it has no record yet.

/// Every file that a result may hold, beside those whose names depend on what is in them.
const OURS: [&str; 64] = [
    "summary.json",
    "history.csv",
    "history.parquet",
    "report.html",
    "report.json.gz",
    "contact_lines.csv",
    "contact_pattern_pinion.csv",
    "contact_pattern_wheel.csv",
    "contact_pattern.svg",
    "root_pattern_pinion.csv",
    "root_pattern_wheel.csv",
    "te_orders.csv",
    "te_shares.csv",
    "energy.csv",
    "spectrum.csv",
    "section.csv",
    "waterfall.csv",
    "cycles.csv",
    "order_cuts.csv",
    "resonance.csv",
    "campbell.csv",
    "sweep.csv",
    "bifurcation.csv",
    "bifurcations.csv",
    "basins.csv",
    "basins.svg",
    "attractors.csv",
    "branch.csv",
    "branch.svg",
    "in_time.csv",
    "bifurcation.svg",
    "study.csv",
    "positions.csv",
    "shafts.csv",
    "modes.csv",
    "crossings.csv",
    "response.csv",
    "rms.csv",
    "bearing_forces.csv",
    "bearing_forces.uff",
    "line_load.csv",
    "motion.csv",
    "motion_orders.csv",
    "cases.csv",
    "cases.parquet",
    "optimum.toml",
    "steps.csv",
    "harris.csv",
    "influences.csv",
    "numbers.csv",
    "front.csv",
    "torques.csv",
    "chart.csv",
    "motion_precision.csv",
    "motion_precision.svg",
    "resonance_curves.csv",
    "resonance_curves.svg",
    "resonance_precision.csv",
    "resonance_precision.svg",
    "envelope.csv",
    "maps.csv",
    "work_precision.svg",
    "compare.csv",
    "compare_curves.csv",
];

/// Whether a run of this program writes a file of that name into a result.
pub(super) fn is_ours(name: &str) -> bool {
    OURS.contains(&name)
        || name.ends_with(".vtu")
        || name.ends_with(".pvd")
        // The rows of any file with commas, column by column.
        || name.strip_suffix(".parquet").is_some_and(|stem| OURS.contains(&format!("{stem}.csv").as_str()))
        || (name.starts_with("compare_") && name.ends_with(".svg"))
}
