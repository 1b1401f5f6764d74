//! F44: the rigid bore of a planet or a thin ring.

use analysis::AnalysisError;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{Bench, errors_um, mean},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 44,
    name: "rigid bore of a thin ring",
    file: "F44-rigid-bore",
    scene: scene_text!("F44-rigid-bore"),
    fails: "What holds a ring is rigid: a thinner rim makes the teeth stiffer, where it bends more on its bearing.",
    does: "The outside stands on springs, bolts or rollers, and the body between them and the teeth is elastic.",
    naive: &[
        "wheel.bore.radial_n_per_mm3=1e9",
        "wheel.bore.tangential_n_per_mm3=1e9",
        "wheel.bore.axial_n_per_mm3=1e9",
    ],
    look,
};

/// Outer diameters of the ring with some 2 and 9 modules between root and outside, mm.
const OUTSIDES: [f64; 2] = [298.0, 340.0];

/// Mean transmission error with a thin rim over that with a thick one.
fn thinned(bench: &Bench, settings: &[String]) -> Result<f64, AnalysisError> {
    let of = |outside: f64| -> Result<f64, AnalysisError> {
        let diameter = format!("wheel.bore_diameter_mm={outside}");
        Ok(mean(&errors_um(&bench.at_rest(&[settings, &[diameter]].concat())?)))
    };
    Ok(of(OUTSIDES[0])? / of(OUTSIDES[1])?)
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let [robust, naive] = [thinned(bench, &[])?, thinned(bench, &bench.naive(&[]))?];
    Ok(vec![
        Figure::new(
            "mean transmission error with 2 modules of rim over that with 9; naive: a rigid outside",
            Shown::at_least(robust, 1.05),
        )
        .beside(Shown::at_most(naive, 1.0)),
    ])
}
