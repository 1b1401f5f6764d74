//! Periodic motions along a key, around folds: pictures, page, closing table.

use analysis::lumped::ContinuationResult;
use answer::label_of;
use scene::Scene;
use store::folder::ResultDirectory;

use super::common::{Shown, key, pair_answer, pair_page};
use crate::{
    Cost, ReportError, Written,
    branch_files::{ShownBranch, charts, lines, picture, six_digits, tables},
    page::Line,
    write_result,
};

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
    let ContinuationResult { facts, headline: h, remarks, .. } = found;
    let branch = ShownBranch::of_pair(h.key, &found.points, &found.turns, &found.in_time);
    if let Some(picture) = picture(&branch) {
        results.write("branch.svg", picture.as_bytes())?;
    }
    let answer = pair_answer(scene, (facts, cost), h, remarks, tables(&branch).into());
    let of = &h.figures;
    let mut headline = lines(h.key, of, &[("", &h.largest)]);
    headline.insert(1, Line::number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz"));
    let shown = Shown {
        subtitle: format!(", periodic motions over {}", h.key),
        key: vec![
            [label_of(h.key), format!("{} .. {}", six_digits(of.range[0]), six_digits(of.range[1]))],
            ["folds".to_owned(), of.folds.len().to_string()],
            key("largest peak-to-peak DTE", h.largest.peak_to_peak_dte_um, 3, "um"),
        ],
        over: format!("Over {}", label_of(h.key)),
        charts: charts(&branch),
        headline,
        ..Shown::default()
    };
    let page = pair_page(scene, facts, &answer, shown)?;
    write_result(answer, &page, scene.output.parquet, results)
}
