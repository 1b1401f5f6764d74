//! F34: signs of hand, sense and driver.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, errors_um, farthest, mean},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 34,
    name: "signs of hand and sense",
    file: "F34-signs",
    scene: scene_text!("F34-signs"),
    fails: "Hand, sense, driver and axial force follow conventions that do not agree with each other.",
    does: "One document of signs; mirrored scenes have mirrored answers.",
    naive: &[],
    look,
};

/// Axial force on the pinion at the first position, N.
fn axial_force(result: &analysis::StaticResult) -> f64 {
    result.history.positions[0].wrench[0].force[2]
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let [right, left, mirror] =
        [&[][..], &["pinion.helix_angle_deg=-20"], &["pinion.helix_angle_deg=-20", "operation.rotation=cw"]]
            .map(|settings: &[&str]| bench.at_rest(settings));
    let (right, left, mirror) = (right?, left?, mirror?);
    let te = errors_um(&right);
    let off = farthest(&te, &errors_um(&mirror)) / mean(&te);
    let pair = bench.scene(&AS_IT_IS)?.gear_pair()?;
    let base_force = 1e3 * 150.0 / pair.wheel.base_radius();
    let wanted = base_force * pair.base_helix_angle().tan();
    Ok(vec![
        Figure::new("mirror image: transmission error, parts off", Shown::at_most(off, 1e-8)),
        Figure::new(
            "mirror image: axial force, parts off",
            Shown::at_most((axial_force(&mirror) / axial_force(&right) - 1.0).abs(), 1e-6),
        ),
        Figure::new(
            "other hand alone: axial force over that of this hand, plus 1; naive: from the angle without its sign",
            Shown::at_most((axial_force(&left) / axial_force(&right) + 1.0).abs(), 1e-3),
        )
        .beside(Shown::at_least(axial_force(&left).abs() / axial_force(&right).abs() + 1.0, 1.9)),
        Figure::new(
            "axial force over torque / r_b tan beta_b, less 1",
            Shown::at_most((axial_force(&right).abs() / wanted - 1.0).abs(), 1e-3),
        ),
    ])
}
