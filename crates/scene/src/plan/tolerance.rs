//! Deviations within a tolerance class of ISO 1328-1, as axes of a plan.

use cases::{Axis, Distribution, around_a_circle, spread};
use geometry::{FlankTolerances, Gear};

use super::word;
use crate::{Scene, SceneError, Setting};

/// Key of a gear's pitch deviations.
const PITCH_ERRORS: &str = "pitch_errors_um";

/// Pitch deviations of one gear; each draw is one manufactured gear.
#[derive(Debug, Clone, PartialEq)]
pub struct PitchTolerance {
    /// Key of the pitch errors, with dots.
    key: String,
    /// f_pT and F_pT, um: between neighbours, and between any two teeth.
    limits_um: [f64; 2],
    /// What the scene says, one number a tooth, um.
    nominal_um: Vec<f64>,
}

impl PitchTolerance {
    /// Cumulative deviations of the gear that a draw (0 .. 1) makes, um: those of the scene, and those within the
    /// tolerance.
    fn errors_um(&self, draw: f64) -> Vec<f64> {
        let drawn = around_a_circle(draw, self.nominal_um.len() as u32, self.limits_um);
        self.nominal_um.iter().zip(drawn).map(|(nominal, own)| nominal + own).collect()
    }

    /// Tolerances f_pT and F_pT, um: between neighbours, and between any two teeth.
    pub fn limits_um(&self) -> [f64; 2] {
        self.limits_um
    }

    /// Total cumulative deviation F_p of that gear, um: what tables tell of it.
    pub(super) fn total_um(&self, draw: f64) -> f64 {
        spread(&self.errors_um(draw))
    }

    /// The setting that makes a scene's gear that one.
    ///
    /// # Errors
    /// [`SceneError::NoKey`], which would be a fault of this program.
    pub(crate) fn setting(&self, draw: f64) -> Result<Setting, SceneError> {
        Setting::of(&self.key, &toml::Value::from(self.errors_um(draw)))
    }
}

/// Whether a key is that of pitch deviations.
pub(super) fn is_pitch(key: &str) -> bool {
    key.rsplit('.').next() == Some(PITCH_ERRORS)
}

/// How a key deviates in a tolerance class of ISO 1328-1 about `mean`; `None` where the standard has no tolerance of
/// it, or the scene no such gear.
///
/// A workshop that keeps its class has its deviations within a third of the tolerance, mostly.
pub(crate) fn classed(
    scene: &Scene,
    key: &str,
    class: u32,
    mean: Option<f64>,
) -> Option<(Option<PitchTolerance>, Axis)> {
    let pair = scene.gear_pair().ok()?;
    let gear = match key.split('.').next()? {
        "pinion" => &pair.pinion,
        "wheel" => &pair.wheel,
        _ => return None,
    };
    let tolerances = FlankTolerances::new(gear, class);
    if is_pitch(key) {
        let limits_um = [tolerances.single_pitch_um, tolerances.total_pitch_um];
        let pitch = PitchTolerance { key: key.to_owned(), limits_um, nominal_um: nominal_um(gear) };
        return Some((Some(pitch), Axis::Drawn(Distribution::Uniform { from: 0.0, to: 1.0 })));
    }
    let (mean, most) = (mean?, tolerances.of_key(key)?);
    Some((None, word::normal(mean, most / 3.0, [mean - most, mean + most])))
}

/// Cumulative pitch deviations that a gear has, um.
fn nominal_um(gear: &Gear) -> Vec<f64> {
    match &gear.modifications().pitch_errors[..] {
        [] => vec![0.0; gear.teeth() as usize],
        errors => errors.iter().map(|e| 1e3 * e).collect(),
    }
}
