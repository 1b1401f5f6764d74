//! `report.html` of a motion and of a sweep.

use serde::Serialize;

use report::page::Rendered;

use super::{
    motion_charts::{MotionPictures, SweepPictures, motion_charts, sweep_charts},
    page::Page,
};
use crate::error::CommandError;
use crate::facts::{Cost, Facts};
use crate::motion::{MotionHeadline, SweepHeadline};
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
) -> Result<Rendered, CommandError> {
    let charts = motion_charts(pictures).map_err(CommandError::from)?;
    let page =
        Page { scene, facts, cost, headline, charts, pattern: pattern.as_deref(), view: pictures.view, warnings };
    page.render("motion.html")
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
    pictures: SweepPictures<'_>,
    warnings: &[String],
) -> Result<Rendered, CommandError> {
    let charts = sweep_charts(&pictures);
    let page = Page { scene, facts, cost, headline, charts, pattern: None, view: pictures.view, warnings };
    page.render("sweep.html")
}

/// A page with charts and the bare gears, from a template that knows its headline.
pub(super) fn render<H: Serialize>(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &H,
    name: &str,
    charts: Vec<String>,
    warnings: &[String],
) -> Result<Rendered, CommandError> {
    let page = Page { scene, facts, cost, headline, charts, pattern: None, view: None, warnings };
    page.render(name)
}
