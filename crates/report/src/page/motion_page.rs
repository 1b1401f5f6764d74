//! `report.html` of a motion and of a sweep.

use analysis::{
    facts::Facts,
    motion::{MotionHeadline, SweepHeadline},
};
use scene::Scene;
use serde::Serialize;

use super::{Rendered, RunPage};
use crate::{
    Cost, ReportError,
    motion_files::{MotionPictures, SweepPictures, motion_charts, sweep_charts},
};

/// The report of one motion; `pattern` is the picture of the contact pattern.
///
/// # Errors
/// [`ReportError`] if the template cannot be filled; that would be a fault of this program.
pub fn write_motion_report(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &MotionHeadline,
    pictures: &MotionPictures<'_>,
    pattern: Option<String>,
    warnings: &[String],
) -> Result<Rendered, ReportError> {
    let charts = motion_charts(pictures)?;
    let page =
        RunPage { scene, facts, cost, headline, charts, pattern: pattern.as_deref(), view: pictures.view, warnings };
    page.render("motion.html")
}

/// The report of a sweep.
///
/// # Errors
/// As above.
pub fn write_sweep_report(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &SweepHeadline,
    pictures: SweepPictures<'_>,
    warnings: &[String],
) -> Result<Rendered, ReportError> {
    let charts = sweep_charts(&pictures);
    let page = RunPage { scene, facts, cost, headline, charts, pattern: None, view: pictures.view, warnings };
    page.render("sweep.html")
}

/// A page with charts and the bare gears, from a template that knows its headline.
///
/// # Errors
/// As above.
pub fn render_run<H: Serialize>(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &H,
    name: &str,
    charts: Vec<String>,
    warnings: &[String],
) -> Result<Rendered, ReportError> {
    let page = RunPage { scene, facts, cost, headline, charts, pattern: None, view: None, warnings };
    page.render(name)
}
