//! What a sweep of a cheaper model shows: diagrams, page, closing table.

use analysis::{
    facts::Facts,
    lumped::{SweepHeadline, SweepPoint},
};
use scene::{Scene, SweepWay};

use super::SweepPage;
use crate::{
    Cost, ReportError,
    charts::{Curve, dot_chart, dot_picture, line_chart},
    page::{Rendered, render_run},
    tables::Lines,
};

const WAYS: [(SweepWay, &str); 3] =
    [(SweepWay::Apart, "each value by itself"), (SweepWay::Up, "upwards"), (SweepWay::Down, "downwards")];

const BIFURCATION: &str = "Bifurcation diagram: section of the motion";

/// Values of each way as a curve; a point of the sweep may have several.
fn by_way(points: &[SweepPoint], values: impl Fn(&SweepPoint) -> Vec<f64>) -> Vec<Curve> {
    let curve = |(way, label): &(SweepWay, &str)| {
        let own = points.iter().filter(|p| p.way == *way);
        let points = own.flat_map(|p| values(p).into_iter().map(|y| (p.value, y)).collect::<Vec<_>>()).collect();
        Curve { label: (*label).into(), points }
    };
    WAYS.iter().map(curve).collect()
}

/// The bifurcation diagram as SVG; `None` without points.
pub fn bifurcation_picture(key: &str, of: &str, points: &[SweepPoint]) -> Option<String> {
    dot_picture(BIFURCATION, key, of, &by_way(points, |p| p.points.clone()))
}

/// Bifurcation diagram first, then what goes with it.
fn bifurcation_charts(key: &str, of: &str, points: &[SweepPoint]) -> Vec<String> {
    let exponent = by_way(points, |p| p.lyapunov.iter().map(|l| l.exponent).collect());
    [
        dot_chart(BIFURCATION, key, of, &by_way(points, |p| p.points.clone())),
        line_chart("Peak to peak", key, of, &by_way(points, |p| vec![p.peak_to_peak()]), true),
        line_chart("Largest Lyapunov exponent: above zero in chaos", key, "exponent [1/s]", &exponent, true),
        line_chart("Smallest normal force", key, "force [N]", &by_way(points, |p| vec![p.normal_force_n[0]]), true),
        line_chart("Mean", key, of, &by_way(points, |p| vec![p.mean]), false),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The report of a sweep.
///
/// # Errors
/// If the template cannot be filled; that would be a fault of this program.
pub fn write_lumped_sweep_report(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    page: &SweepPage<'_>,
    points: &[SweepPoint],
    warnings: &[String],
) -> Result<Rendered, ReportError> {
    let charts = bifurcation_charts(&page.headline.key, &page.headline.section_of, points);
    render_run(scene, facts, cost, page, "ladder_sweep.html", charts, warnings)
}

/// A few values as text, ascending and each once, the rest as dots.
fn listed(mut values: Vec<f64>) -> String {
    const SHOWN: usize = 6;
    values.sort_by(f64::total_cmp);
    values.dedup();
    let mut text: Vec<String> = values.iter().take(SHOWN).map(ToString::to_string).collect();
    if values.len() > SHOWN {
        text.push("...".into());
    }
    if text.is_empty() { String::new() } else { format!("at {}", text.join(", ")) }
}

/// The table at the end of a sweep.
pub fn lumped_sweep_table(scene: &Scene, facts: &Facts, cost: &Cost, s: &SweepHeadline, warnings: &[String]) -> String {
    let mut t = Lines::new(facts);
    t.text(&s.key, format_args!("{} .. {}", s.range[0], s.range[1]), &format!("{} values", s.values));
    for p in &s.largest {
        let way = WAYS.iter().find(|(way, _)| *way == p.way).map_or("", |(_, name)| name);
        let unit = format!("({}) at {}", s.section_of, p.value);
        t.number(&format!("largest peak to peak, {way}"), p.peak_to_peak(), 4, &unit);
    }
    t.text("sections of one point", format_args!("{} of {}", s.period_one, s.points), "");
    t.text("sections of a few points", s.subharmonic.len(), "");
    t.text("sections that do not come back", s.not_periodic.len(), "");
    if let Some(chaotic) = &s.chaotic {
        let values: Vec<f64> = chaotic.iter().map(|(_, v)| *v).collect();
        t.text("chaotic (exponent above 0)", chaotic.len(), &listed(values));
    }
    if let Some(bands) = &s.hysteresis {
        let text: Vec<String> = bands.iter().map(|[a, b]| format!("{a} .. {b}")).collect();
        t.text("coexisting solutions", bands.len(), &text.join(", "));
    }
    t.text("points at which flanks part", s.parting, "");
    if !s.failed.is_empty() {
        let values: Vec<f64> = s.failed.iter().map(|(_, v, _)| *v).collect();
        t.text("points without a solution", s.failed.len(), &listed(values));
    }
    t.framed(scene, cost, warnings)
}
