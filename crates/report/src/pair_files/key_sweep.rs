//! Motions at many values of a key: diagrams, page, closing table.

use analysis::lumped::{BifurcationAnalysis, SweepHeadline, SweepOptions, SweepPoint};
use answer::label_of;
use scene::SweepWay;

use super::{
    common::{Shown, pair_answer, pair_page},
    key_rows,
};
use crate::{
    Cost, ReportError, Written,
    charts::{Curve, dot_chart, dot_picture, line_chart},
    page::Line,
    plan_files::plain,
    write_result,
};
use store::folder::ResultDirectory;

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

/// Writes all files of motions at many values of a key; `again`: the command that makes them again. What comes
/// back is the closing table.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_key_sweep_result(
    options: &SweepOptions,
    found: &BifurcationAnalysis,
    again: Option<&str>,
    cost: &Cost,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let BifurcationAnalysis { scene, facts, points, headline: h, remarks } = found;
    let tables = vec![key_rows::sweep(options, points), key_rows::bifurcation(options, points)];
    let diagram = by_way(points, |p| p.points.clone());
    if let Some(picture) =
        dot_picture(BIFURCATION, &label_of(&options.key), &label_of(&options.quantity.name), &diagram)
    {
        results.write("bifurcation.svg", picture.as_bytes())?;
    }
    let h = &SweepHeadline { again: again.map(str::to_owned), ..h.clone() };
    let answer = pair_answer(scene, (facts, cost), h, remarks, tables);
    let shown = Shown {
        subtitle: format!(", motion over {}", plain(&label_of(&h.key))),
        key: vec![
            [label_of(&h.key), format!("{} .. {}", h.range[0], h.range[1])],
            ["sections of one point".to_owned(), format!("{} of {}", h.period_one, h.points)],
        ],
        over: format!("Over {}", label_of(&h.key)),
        charts: bifurcation_charts(&label_of(&h.key), &label_of(&h.section_of), points),
        headline: lines(h),
        again: again.map(str::to_owned),
        ..Shown::default()
    };
    let page = pair_page(scene, facts, &answer, shown)?;
    write_result(answer, &page, scene.output.parquet, results)
}

/// Bifurcation diagram first, then what goes with it.
fn bifurcation_charts(key: &str, of: &str, points: &[SweepPoint]) -> Vec<String> {
    let quantity = plain(of);
    let exponent = by_way(points, |p| p.lyapunov.iter().map(|l| l.exponent).collect());
    [
        dot_chart(BIFURCATION, key, of, &by_way(points, |p| p.points.clone())),
        line_chart(&format!("Peak to peak of {quantity}"), key, of, &by_way(points, |p| vec![p.peak_to_peak()]), true),
        line_chart("Largest Lyapunov exponent: above zero in chaos", key, "exponent [1/s]", &exponent, true),
        line_chart("Smallest normal force", key, "force [N]", &by_way(points, |p| vec![p.normal_force_n[0]]), true),
        line_chart(&format!("Mean of {quantity}"), key, of, &by_way(points, |p| vec![p.mean]), false),
    ]
    .into_iter()
    .flatten()
    .collect()
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

fn lines(s: &SweepHeadline) -> Vec<Line> {
    let mut all = vec![Line::text(
        label_of(&s.key),
        format_args!("{} .. {}", s.range[0], s.range[1]),
        format!("{} values", s.values),
    )];
    all.extend(s.largest.iter().map(|p| {
        let way = WAYS.iter().find(|(way, _)| *way == p.way).map_or("", |(_, name)| name);
        let unit = format!("({}) at {}", label_of(&s.section_of), p.value);
        Line::number(format!("largest peak to peak, {way}"), p.peak_to_peak(), 4, unit)
    }));
    all.push(Line::text("sections of one point", format_args!("{} of {}", s.period_one, s.points), ""));
    all.push(Line::text("sections of a few points", s.subharmonic.len(), ""));
    let within = format!("(within {:.1e})", s.periodic_tolerance);
    all.push(Line::text("sections that do not come back", s.not_periodic.len(), within));
    if let Some(chaotic) = &s.chaotic {
        let values: Vec<f64> = chaotic.iter().map(|(_, v)| *v).collect();
        all.push(Line::text("chaotic (exponent above 0)", chaotic.len(), listed(values)));
    }
    if let Some(bands) = &s.hysteresis {
        let text: Vec<String> = bands.iter().map(|[a, b]| format!("{a} .. {b}")).collect();
        all.push(Line::text("coexisting solutions", bands.len(), text.join(", ")));
    }
    all.push(Line::text("points with loss of contact", s.parting, ""));
    if !s.failed.is_empty() {
        let values: Vec<f64> = s.failed.iter().map(|(_, v, _)| *v).collect();
        all.push(Line::text("points without a solution", s.failed.len(), listed(values)));
    }
    all
}
