//! Deflection and pressure of a pair under its torque in closed form.

use crate::{loaded_pair::LoadedPair, nominal_pressure::nominal_pressure};

/// Stiffness where ISO 6336-1 has none, of steel: its own mean value, N/(mm um).
const MEAN_STIFFNESS: f64 = 20.0;
/// Young's modulus of that steel, MPa.
const STEEL: f64 = 2.06e5;

/// Closed-form estimates of a loaded pair.
///
/// ```text
/// deflection = F_bt / (b c_gamma_alpha)   (ISO 6336-1, bodies left out),   pressure: Hertz at the pitch point
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadEstimate {
    /// Mean deflection of the teeth along the line of action, divided by the normal module.
    pub modules: f64,
    /// Mean deflection of the teeth along the line of action, mm.
    pub deflection_mm: f64,
    /// Largest nominal Hertz pressure, MPa.
    pub pressure_mpa: f64,
    /// The largest pressure divided by the effective modulus E* of both materials. Half the width of a Hertz band
    /// divided by the radius of the flanks is twice this value.
    pub pressure_over_modulus: f64,
}

impl LoadEstimate {
    /// Mean deflection of the teeth along the line of action, mm.
    pub(crate) fn deflection_mm(loaded: &LoadedPair<'_>) -> f64 {
        let (force, young) = (loaded.base_force(), loaded.young());
        if force <= 0.0 {
            return 0.0;
        }
        let mean = 2.0 * young[0] * young[1] / (young[0] + young[1]);
        let stiffness = loaded.iso_stiffness().map_or(MEAN_STIFFNESS * mean / STEEL, |iso| iso.c_mesh);
        1e-3 * force / (loaded.pair.face_width() * stiffness)
    }

    /// Estimate of a loaded pair.
    pub(crate) fn of(loaded: &LoadedPair<'_>) -> Self {
        let (pair, deflection_mm) = (loaded.pair, Self::deflection_mm(loaded));
        let points = nominal_pressure(loaded).hertz;
        let pressure_mpa = points.iter().map(|p| p.pressure_mpa).filter(|p| p.is_finite()).fold(0.0, f64::max);
        Self {
            modules: deflection_mm / pair.pinion.data().normal_module,
            deflection_mm,
            pressure_mpa,
            pressure_over_modulus: pressure_mpa / loaded.effective_modulus(),
        }
    }
}
