//! `report.html` of a cheaper model in motion.

use analysis::{
    facts::Facts,
    lumped::{LumpedCampbell, LumpedHeadline},
};
use scene::Scene;
use study::Columns;

use crate::{
    Cost, ReportError,
    charts::{Curve, campbell_chart, dot_chart, line_chart},
    motion_files::{MotionPictures, SHOWN_CYCLES, motion_charts},
    page::{Rendered, render_run},
};

/// Displacements that have a phase portrait where the model has them; their rates are named alike.
const PORTRAITS: [(&str, &str); 6] = [
    ("pinion_along", "the pinion along the line of action"),
    ("wheel_along", "the wheel along the line of action"),
    ("pinion_y", "the pinion along y"),
    ("wheel_y", "the wheel along y"),
    ("pinion_z", "the pinion along its axis"),
    ("wheel_z", "the wheel along its axis"),
];

/// What the charts of a run are drawn from.
#[derive(Debug, Clone, Copy)]
pub struct LumpedPictures<'a> {
    /// Those of every motion.
    pub motion: MotionPictures<'a>,
    /// One row a mesh cycle.
    pub section: &'a Columns,
    /// Natural frequencies over speed, of a linear model.
    pub campbell: Option<&'a LumpedCampbell>,
}

/// The report of one run.
///
/// # Errors
/// For rows without a column that every motion has, and if the template cannot be filled.
pub fn write_lumped_report(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &LumpedHeadline,
    pictures: &LumpedPictures<'_>,
    warnings: &[String],
) -> Result<Rendered, ReportError> {
    let mut charts = motion_charts(&pictures.motion)?;
    for (name, whose) in PORTRAITS {
        charts.extend(displacement(&pictures.motion, name, whose));
        charts.extend(portrait(pictures.motion.rows, pictures.section, name, whose));
    }
    charts.extend(pictures.campbell.and_then(|c| campbell_chart(&c.diagram, &c.names, &[])));
    render_run(scene, facts, cost, headline, "ladder.html", charts, warnings)
}

/// Displacement (um) with its velocity (mm/s), row by row; nothing where the model has none of that name.
fn plane(rows: &Columns, name: &str) -> Vec<(f64, f64)> {
    let of = |unit: &str| rows.find(&format!("{name}_{unit}")).unwrap_or_default();
    let (x, v) = (of("um"), of("rate_um_per_s"));
    x.iter().zip(v).map(|(x, v)| (*x, 1e-3 * v)).collect()
}

/// Displacement over time, the last mesh cycles.
fn displacement(of: &MotionPictures<'_>, name: &str, whose: &str) -> Option<String> {
    let (time, x) = (of.rows.find("time_s")?, of.rows.find(&format!("{name}_um"))?);
    let first = x.len().saturating_sub(SHOWN_CYCLES * of.per_cycle);
    let begin = time.get(first).copied().unwrap_or(0.0);
    let points: Vec<(f64, f64)> = time.iter().zip(x).skip(first).map(|(t, x)| (1e3 * (t - begin), *x)).collect();
    let curve = Curve { label: name.replace('_', " "), points };
    line_chart(&format!("Motion of {whose}"), "time [ms], last mesh cycles", "displacement [um]", &[curve], false)
}

/// Velocity over displacement, and the same once a mesh cycle: phase portrait with its Poincare section.
fn portrait(rows: &Columns, section: &Columns, name: &str, whose: &str) -> Option<String> {
    let motion = Curve { label: "motion".into(), points: plane(rows, name) };
    let once = Curve { label: "once a mesh cycle".into(), points: plane(section, name) };
    let title = format!("Phase portrait of {whose}, and its Poincare section");
    dot_chart(&title, "displacement [um]", "velocity [mm/s]", &[motion, once])
}
