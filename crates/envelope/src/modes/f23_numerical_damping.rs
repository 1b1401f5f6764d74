//! F23: damping of the method itself.

use integrate::Scheme;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
    pieces::clearance::Clearance,
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

/// Speeds over the natural frequency.
const SPEEDS: usize = 31;
const FROM: f64 = 0.5;
const TO: f64 = 1.1;

/// Share of the speeds at which a run up and a run down differ: the band with two answers.
fn band(scheme: Scheme, steps: usize) -> Result<f64, EnvelopeError> {
    let speed = |i: usize| FROM + (TO - FROM) * i as f64 / (SPEEDS - 1) as f64;
    let mut up = Vec::new();
    let mut oscillator = Clearance::at_rest(scheme);
    for i in 0..SPEEDS {
        up.push(oscillator.peak_to_peak(speed(i), steps)?);
    }
    let mut differ = 0;
    for i in (0..SPEEDS).rev() {
        let down = oscillator.peak_to_peak(speed(i), steps)?;
        differ += usize::from((down / up[i] - 1.0).abs() > 0.05);
    }
    Ok(differ as f64 / SPEEDS as f64)
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let exact = band(Scheme::Energy, 256)?;
    let usual = band(Scheme::Energy, 32)?;
    let rho = |rho| Scheme::GeneralisedAlpha { rho };
    let (mild, harsh) = (band(rho(0.9), 32)?, band(rho(0.0), 12)?);
    let motion = bench.in_motion(&AS_IT_IS)?;
    Ok(vec![
        Figure::new(
            "oscillator with clearance: share of the speeds with coexisting solutions, 256 steps a period",
            Shown::at_least(exact, 0.05),
        ),
        Figure::new(
            "change of that band with 32 steps a period, parts; naive: generalised-alpha of radius 0, 12 steps",
            Shown::at_most((usual / exact - 1.0).abs(), 0.15),
        )
        .beside(Shown::at_least((harsh / exact - 1.0).abs(), 0.3)),
        Figure::new("the same with spectral radius 0.9, 32 steps", Shown::at_most((mild / exact - 1.0).abs(), 0.15)),
        Figure::new(
            "pair at resonance: losses of contact",
            Shown::at_least(motion.headline.certificate.flanks.contact_losses as f64, 1.0),
        ),
    ])
}
