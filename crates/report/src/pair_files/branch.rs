//! Periodic motions along a key, around folds: pictures, page, closing table.

use analysis::{
    branch::{BranchPoint, LossName},
    lumped::{ContinuationHeadline, ContinuationResult},
};
use scene::Scene;

use super::{
    common::{Shown, key, pair_answer, pair_page},
    key_rows,
};
use crate::{
    Cost, ReportError, Written,
    charts::{Curve, dot_chart, dot_picture},
    page::Line,
    write_result,
};
use store::folder::ResultDirectory;

const TITLE: &str = "Periodic motions";
const DTE: &str = "peak-to-peak DTE [um]";

/// Dots between two motions: stable parts look like a line, unstable ones like a dotted one.
const DENSE: usize = 40;
const LOOSE: usize = 4;

/// Writes all files of periodic motions along a key; what comes back is the closing table.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub(super) fn write_continuation_result(
    scene: &Scene,
    found: &ContinuationResult,
    cost: &Cost,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let ContinuationResult { facts, in_time, headline: h, remarks, .. } = found;
    let swept = found.headline.key;
    let tables = vec![
        key_rows::branch(swept, &found.points),
        key_rows::turns(swept, &found.turns),
        key_rows::in_time(swept, &found.in_time),
    ];
    let dots: Vec<(f64, f64)> = in_time.iter().map(|p| (p.value, p.peak_to_peak_dte_um)).collect();
    if let Some(picture) = dot_picture(TITLE, h.key, DTE, &curves(found, |p| p.peak_to_peak_dte_um, &dots)) {
        results.write("branch.svg", picture.as_bytes())?;
    }
    let answer = pair_answer(scene, (facts, cost), h, remarks, tables);
    let shown = Shown {
        subtitle: format!(", periodic motions over {}", h.key),
        key: vec![
            [h.key.to_owned(), format!("{:.4} .. {:.4}", h.range[0], h.range[1])],
            ["folds".to_owned(), h.folds.len().to_string()],
            key("largest peak-to-peak DTE", h.largest.peak_to_peak_dte_um, 3, "um"),
        ],
        over: format!("Over {}", h.key),
        charts: charts(found),
        headline: lines(h),
        ..Shown::default()
    };
    let page = pair_page(scene, facts, &answer, shown)?;
    write_result(answer, &page, scene.output.parquet, results)
}

/// Both parts of the branch as rows of dots, bifurcations, and motions in time.
fn curves(found: &ContinuationResult, value: fn(&BranchPoint) -> f64, in_time: &[(f64, f64)]) -> Vec<Curve> {
    let part = |stable: bool, count: usize| -> Vec<(f64, f64)> {
        let own = found.points.windows(2).filter(|w| w[0].is_stable == stable);
        let between = |w: &[BranchPoint], k: usize| {
            let share = k as f64 / count as f64;
            let of = |f: fn(&BranchPoint) -> f64| f(&w[0]) + share * (f(&w[1]) - f(&w[0]));
            (of(|p| p.value), of(value))
        };
        own.flat_map(|w| (0..count).map(move |k| between(w, k))).collect()
    };
    let turns = |loss: LossName| {
        found.turns.iter().filter(|t| t.loss == loss).map(|t| (t.point.value, value(&t.point))).collect::<Vec<_>>()
    };
    let all = [
        ("stable", part(true, DENSE)),
        ("unstable", part(false, LOOSE)),
        ("folds", turns(LossName::Fold)),
        ("period doublings", turns(LossName::PeriodDoubling)),
        ("torus bifurcations", turns(LossName::Torus)),
        ("integrated in time", in_time.to_vec()),
    ];
    all.into_iter().map(|(label, points)| Curve { label: label.into(), points }).collect()
}

fn charts(found: &ContinuationResult) -> Vec<String> {
    let key = found.headline.key;
    let in_time: Vec<(f64, f64)> = found.in_time.iter().map(|p| (p.value, p.peak_to_peak_dte_um)).collect();
    [
        dot_chart(TITLE, key, DTE, &curves(found, |p| p.peak_to_peak_dte_um, &in_time)),
        dot_chart("Largest normal force", key, "force [N]", &curves(found, |p| p.max_normal_force_n, &[])),
        dot_chart("Smallest normal force", key, "force [N]", &curves(found, |p| p.min_normal_force_n, &[])),
        dot_chart(
            "Largest Floquet multiplier: below 1 disturbances fade",
            key,
            "size",
            &curves(found, |p| p.largest_multiplier, &[]),
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn lines(h: &ContinuationHeadline) -> Vec<Line> {
    let listed = |values: &[f64]| values.iter().map(|v| format!("{v:.6}")).collect::<Vec<_>>().join(", ");
    let mut all = vec![
        Line::text(h.key, format_args!("{:.6} .. {:.6}", h.range[0], h.range[1]), ""),
        Line::number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz"),
        Line::text("motions", h.motions, format!("{} unstable, {} mesh cycle(s) each", h.unstable, h.period_cycles)),
        Line::number(
            "largest peak-to-peak DTE",
            h.largest.peak_to_peak_dte_um,
            4,
            format!("um at {:.6}", h.largest.value),
        ),
        Line::text("folds", h.folds.len(), listed(&h.folds)),
        Line::text("period doublings", h.period_doublings.len(), listed(&h.period_doublings)),
        Line::text("torus bifurcations", h.torus_bifurcations.len(), listed(&h.torus_bifurcations)),
        Line::text("motions with loss of contact", h.parting, ""),
        Line::text("most harmonics", h.most_harmonics, ""),
        Line::text("Newton steps", h.newton_steps, ""),
        Line::science("largest difference of a motion in time", h.difference_in_time, ""),
    ];
    all.extend(h.broken.as_ref().map(|why| Line::text("the branch ends within its range", "", why)));
    all
}
