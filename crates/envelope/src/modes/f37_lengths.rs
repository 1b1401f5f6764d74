//! F37: lengths in the code where the problem has none.

use analysis::{StaticResult, worse};
use geometry::{ModifiedFlank, Side};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, errors_um, farthest, largest},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 37,
    name: "lengths of the code's own",
    file: "F37-lengths",
    scene: scene_text!("F37-lengths"),
    fails: "A band, a step or a tolerance in mm: where flanks are modified a pair of another size has another answer, and nobody asks for a size.",
    does: "Lengths are parts of the normal module: all lengths times a number, torque times its cube, and dimensionless results stay.",
    naive: &[],
    look,
};

/// Sizes over the scene's.
const SIZES: [f64; 2] = [0.1, 10.0];
/// Half of a band of contact that does not follow the size, mm.
const OWN_BAND_MM: f64 = 0.1;

fn sized(size: f64) -> [String; 4] {
    [
        format!("pair.normal_module_mm={:?}", 3.0 * size),
        format!("pair.face_width_mm={:?}", 20.0 * size),
        format!("operation.torque_nm={:?}", 150.0 * size.powi(3)),
        format!("pinion.modification.tip_relief_um={:?}", 20.0 * size),
    ]
}

/// Curvature that a relief adds where it starts, as a band (mm, half) sees it, 1/mm.
fn added_curvature(flank: &ModifiedFlank, start: f64, band: f64) -> f64 {
    let arc = flank.nominal().base_radius * start;
    let slope = |way: f64| flank.depth(start + way / arc, 0.0).by_roll;
    (slope(band) - slope(-band)) / (2.0 * band * arc)
}

fn pressures(result: &StaticResult) -> Vec<f64> {
    result.history.positions.iter().map(|p| p.max_pressure).collect()
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let one = bench.at_rest(&AS_IT_IS)?;
    let (errors, pressure) = (errors_um(&one), pressures(&one));
    let curvature = |size: f64, own: bool| -> Result<f64, EnvelopeError> {
        let flank = bench.scene(&sized(size))?.gear_pair()?.pinion.modified_flank(Side::Left, 0);
        let band = if own { OWN_BAND_MM } else { flank.band() };
        Ok(size * added_curvature(&flank, 24f64.to_radians(), band))
    };
    let (mut answers, mut robust, mut naive) = (0.0, 0.0, 0.0);
    for size in SIZES {
        let other = bench.at_rest(&sized(size))?;
        let per_size: Vec<f64> = errors_um(&other).iter().map(|e| e / size).collect();
        answers = worse(answers, farthest(&per_size, &errors) / largest(errors.iter().copied()));
        answers = worse(answers, farthest(&pressures(&other), &pressure) / largest(pressure.iter().copied()));
        robust = worse(robust, (curvature(size, false)? / curvature(1.0, false)? - 1.0).abs());
        naive = worse(naive, (curvature(size, true)? / curvature(1.0, true)? - 1.0).abs());
    }
    Ok(vec![
        Figure::new(
            "curvature at the start of a tip relief of 1/10 and of 10 times the size, parts off; naive: a band of 0.1 mm",
            Shown::at_most(robust, 1e-9),
        )
        .beside(Shown::at_least(naive, 0.5)),
        Figure::new(
            "transmission error and largest pressure of 1/10 and of 10 times the size, parts off",
            Shown::at_most(answers, 1e-9),
        ),
    ])
}
