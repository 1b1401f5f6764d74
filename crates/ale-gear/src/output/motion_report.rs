//! `report.html` of a motion and of a sweep.

use minijinja::{context, value::Serde};
use serde::Serialize;

use super::{
    motion_charts::{MotionPictures, motion_charts, sweep_charts},
    page,
    table::model_name,
};
use crate::error::CommandError;
use crate::facts::{Cost, Facts};
use crate::motion::{MotionHeadline, SweepHeadline, SweepRow};
use crate::scene::Scene;

/// The report of one motion; `pattern` is the picture of the contact pattern.
///
/// # Errors
/// Exit status 1 if the template cannot be filled; that would be a fault of this program.
pub(crate) fn write_motion_report(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &MotionHeadline,
    pictures: &MotionPictures<'_>,
    pattern: Option<String>,
    warnings: &[String],
) -> Result<String, CommandError> {
    let mut charts = motion_charts(pictures);
    charts.extend(pattern);
    render(scene, facts, cost, headline, ("motion.html", include_str!("motion.html")), charts, warnings)
}

/// The report of a sweep.
///
/// # Errors
/// As above.
pub(crate) fn write_sweep_report(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &SweepHeadline,
    rows: &[SweepRow],
    warnings: &[String],
) -> Result<String, CommandError> {
    render(scene, facts, cost, headline, ("sweep.html", include_str!("sweep.html")), sweep_charts(rows), warnings)
}

/// A page with charts, from a template that knows its headline.
pub(super) fn render<H: Serialize>(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &H,
    (name, template): (&str, &str),
    charts: Vec<String>,
    warnings: &[String],
) -> Result<String, CommandError> {
    let context = context! {
        name => &scene.name,
        model => model_name(scene),
        version => env!("CARGO_PKG_VERSION"),
        scene => scene.to_toml(),
        scene_file => scene.file.display().to_string(),
        set => &scene.set,
        vtu => false,
        headline => Serde(headline),
        facts => Serde(facts),
        cost => Serde(cost),
        charts => charts,
        warnings => warnings.to_vec(),
    };
    page::render(name, template, context)
}
