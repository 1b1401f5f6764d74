//! Headline numbers of a branch, as a page and the closing table have them.

use analysis::branch::{BranchFigures, BranchPoint};

use crate::page::Line;

/// Figures of a branch over a key; `largest`: of each mesh its name and the motion with the largest peak to peak.
pub(crate) fn lines(key: &str, of: &BranchFigures, largest: &[(&str, &BranchPoint)]) -> Vec<Line> {
    let listed = |values: &[f64]| values.iter().map(|v| six_digits(*v)).collect::<Vec<_>>().join(", ");
    let peaks = largest.iter().map(|(name, point)| {
        let label =
            if name.is_empty() { "largest peak-to-peak DTE".to_owned() } else { format!("{name}: largest p-p DTE") };
        Line::number(label, point.peak_to_peak_dte_um, 4, format!("um at {}", six_digits(point.value)))
    });
    let cycles = format!("{} unstable, {} mesh cycle(s) each", of.unstable, of.period_cycles);
    let mut all = vec![
        Line::text(key, format_args!("{} .. {}", six_digits(of.range[0]), six_digits(of.range[1])), ""),
        Line::text("motions", of.motions, cycles),
    ];
    all.extend(peaks);
    all.extend([
        Line::text("folds", of.folds.len(), listed(&of.folds)),
        Line::text("period doublings", of.period_doublings.len(), listed(&of.period_doublings)),
        Line::text("torus bifurcations", of.torus_bifurcations.len(), listed(&of.torus_bifurcations)),
        Line::text("motions with loss of contact", of.parting, ""),
        Line::text("most harmonics", of.most_harmonics, ""),
        Line::text("Newton steps", of.newton_steps, ""),
        Line::science("largest difference of a motion in time", of.difference_in_time, ""),
    ]);
    all.extend(of.broken.as_ref().map(|why| Line::text("the branch ends within its range", "", why)));
    all
}

/// A value of the key with six significant digits, no zeros behind them.
pub(crate) fn six_digits(value: f64) -> String {
    let places = (5.0 - value.abs().max(1e-9).log10().floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{value:.places$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
