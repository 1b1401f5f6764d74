//! F14: tolerances that bear a length.

use analysis::worse;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, errors_um, farthest, mean},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 14,
    name: "dependence on units",
    file: "F14-units",
    scene: scene_text!("F14-units"),
    fails: "A tolerance with a length in it: the same pair in other units, or of another size, has another answer.",
    does: "All tolerances are relative; a mesh in metres or inches is noticed by its size and told.",
    naive: &["pair.normal_module_mm=0.003", "pair.face_width_mm=0.02", "operation.torque_nm=150e-9"],
    look,
};

/// Sizes over the scene's.
const SIZES: [f64; 2] = [0.01, 50.0];

/// Lengths times s and torque times s^3 make the transmission error times s.
fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let one = errors_um(&bench.at_rest(&AS_IT_IS)?);
    let mut worst = 0.0f64;
    for size in SIZES {
        let scaled = bench.at_rest(&[
            format!("pair.normal_module_mm={:?}", 3.0 * size),
            format!("pair.face_width_mm={:?}", 20.0 * size),
            format!("operation.torque_nm={:?}", 150.0 * size.powi(3)),
        ])?;
        let per_size: Vec<f64> = errors_um(&scaled).iter().map(|e| e / size).collect();
        worst = worse(worst, farthest(&per_size, &one) / mean(&one));
    }
    let metres = bench.at_rest(&bench.naive(&[]));
    Ok(vec![
        Figure::new(
            "a pair of 1/100 and of 50 times the size, transmission error over size, parts off",
            Shown::at_most(worst, 1e-9),
        )
        .beside(Shown::refused(&metres, "allowed is 0.01")),
    ])
}
