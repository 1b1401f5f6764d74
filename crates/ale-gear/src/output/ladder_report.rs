//! `report.html` of a cheaper model in motion.

use super::{
    Rendered,
    charts::{Curve, line_chart},
    motion_charts::{MotionPictures, motion_charts},
    motion_report::render,
};
use crate::error::CommandError;
use crate::facts::{Cost, Facts};
use crate::ladder::LadderHeadline;
use crate::motion::Columns;
use crate::scene::Scene;

/// Displacements that have a phase portrait where the model has them; their rates are named alike.
const PORTRAITS: [(&str, &str); 6] = [
    ("pinion_along", "Phase portrait of the pinion along the line of action"),
    ("wheel_along", "Phase portrait of the wheel along the line of action"),
    ("pinion_y", "Phase portrait of the pinion along y"),
    ("wheel_y", "Phase portrait of the wheel along y"),
    ("pinion_z", "Phase portrait of the pinion along its axis"),
    ("wheel_z", "Phase portrait of the wheel along its axis"),
];

/// The report of one run.
///
/// # Errors
/// Exit status 1 if the template cannot be filled; that would be a fault of this program.
pub(crate) fn write_ladder_report(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &LadderHeadline,
    pictures: &MotionPictures<'_>,
    warnings: &[String],
) -> Result<Rendered, CommandError> {
    let mut charts = motion_charts(pictures);
    charts.extend(PORTRAITS.iter().filter_map(|(name, title)| portrait(pictures.rows, name, title)));
    render(scene, facts, cost, headline, "ladder.html", charts, warnings)
}

/// Velocity over displacement.
fn portrait(rows: &Columns, name: &str, title: &str) -> Option<String> {
    let (x, v) = (rows.get(&format!("{name}_um")), rows.get(&format!("{name}_rate_um_per_s")));
    let points = x.iter().zip(v).map(|(x, v)| (*x, 1e-3 * v)).collect();
    let curve = Curve { label: name.replace('_', " "), points };
    line_chart(title, "displacement [um]", "velocity [mm/s]", &[curve], false)
}
