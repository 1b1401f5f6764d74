//! F7: quasi-static elasticity beyond its limit.

use super::FailureMode;
use crate::{EnvelopeError, Figure, Shown, bench::Bench};

pub(super) const MODE: FailureMode = FailureMode {
    number: 7,
    name: "quasi-static elasticity beyond its limit",
    file: "F07-low-frequency",
    scene: scene_text!("F07-low-frequency"),
    fails: "Elasticity without inertia is taken up to frequencies at which teeth and bodies vibrate themselves.",
    does: "Every motion states what elastic inertia may change, and warns with the remedy; normal modes are an option.",
    naive: &["analysis.model=reduced"],
    look,
};

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let modes =
        |count: &str| bench.in_motion(&["analysis.model=reduced+modes".to_owned(), format!("modes.count={count}")]);
    let (with, more) = (modes("6")?, modes("14")?);
    let without = bench.in_motion(&bench.naive(&[]))?;
    let size = |r: &analysis::motion::MotionResult| r.headline.peak_to_peak_dte_um;
    let off = |r: &analysis::motion::MotionResult| 100.0 * (size(r) / size(&more) - 1.0).abs();
    Ok(vec![
        Figure::new(
            "peak to peak of the DTE against 14 modes, %; 6 modes; naive: none",
            Shown::at_most(off(&with), 5.0),
        )
        .beside(Shown::at_least(off(&without), 5.0)),
        Figure::new("what is said without modes", Shown::warned(&without.remarks, "elasticity is quasi-static there")),
        Figure::new(
            "change that is foreseen without modes, over the one found",
            Shown::at_least(100.0 * without.headline.elasticity.change_over_peak_to_peak / off(&without), 0.5),
        ),
    ])
}
