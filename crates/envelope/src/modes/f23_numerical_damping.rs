//! F23: damping of the method itself.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 23,
    name: "numerical damping",
    file: "F23-numerical-damping",
    scene: scene_text!("F23-numerical-damping"),
    fails: "A method that takes high frequencies away takes jumps, separation and chaos with them, and looks all the smoother.",
    does: "The default method has no damping of its own; the one of generalised-alpha is stated, and warned of where steps are coarse.",
    naive: &[
        "motion.method=generalised-alpha",
        "motion.spectral_radius=0",
        "motion.steps_per_resonance=0",
        "motion.steps_per_mesh_cycle=12",
    ],
    look,
};

/// Peak to peak of the vibration near its resonance, by spectral radius and step.
fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let size =
        |settings: &[&str]| Ok::<_, EnvelopeError>(bench.unchecked_motion(settings)?.headline.peak_to_peak_dte_um);
    let fine = size(&["motion.steps_per_mesh_cycle=512"])?;
    let off = |x: f64| 100.0 * (x / fine - 1.0).abs();
    let usual = bench.in_motion(&AS_IT_IS)?.headline.peak_to_peak_dte_um;
    let mut radii = Vec::new();
    for radius in ["0", "0.5", "0.9"] {
        radii.push(off(size(&["motion.method=generalised-alpha", &format!("motion.spectral_radius={radius}")])?));
    }
    let falls = radii.windows(2).all(|w| w[1] <= w[0] + 0.5);
    let naive = bench.unchecked_motion(&bench.naive(&[]))?;
    Ok(vec![
        Figure::new("peak to peak at resonance against 512 steps a mesh cycle, % off", Shown::at_most(off(usual), 2.0))
            .beside(Shown::at_least(off(naive.headline.peak_to_peak_dte_um), 10.0)),
        Figure::new("spectral radius 0.9 at the usual steps, % off", Shown::at_most(radii[2], 5.0)),
        Figure::new(
            "spectral radii of 0, 0.5, 0.9 whose error does not fall",
            Shown::at_most(f64::from(u8::from(!falls)), 0.0),
        ),
    ])
}
