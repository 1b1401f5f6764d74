//! Heat of flanks that slide: Blok's flash temperature and what of a material decides it. ISO/TS 6336-20.

use crate::{Material, RatingError, RollingPlace};

impl Material {
    /// B_M, thermal contact coefficient, N/(mm s^0.5 K).
    ///
    /// ```text
    /// B_M = sqrt(1e-6 lambda rho c)
    /// ```
    /// lambda thermal conductivity, W/(m K); c specific heat, J/(kg K); `density` rho, kg/m^3. Source: ISO/TS 6336-20, thermal contact coefficient.
    ///
    /// # Errors
    /// [`RatingError::MaterialLacks`] where the material does not state one of them.
    pub fn thermal_contact_coefficient(&self, density: f64) -> Result<f64, RatingError> {
        let stated = |value: Option<f64>, key: &'static str| {
            let lacks = || RatingError::MaterialLacks {
                material: self.name.clone(),
                key,
                clause: "the thermal contact coefficient of ISO/TS 6336-20",
            };
            value.ok_or_else(lacks)
        };
        let conductivity = stated(self.thermal_conductivity_w_per_m_k, "thermal_conductivity_w_per_m_k")?;
        let heat = stated(self.specific_heat_j_per_kg_k, "specific_heat_j_per_kg_k")?;
        Ok((1e-6 * conductivity * density * heat).sqrt())
    }
}

/// Reduced modulus of both gears, MPa: `E_r = 2/[(1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2]`, twice the effective modulus of Hertz. Source: ISO/TS 6336-20 and -22.
pub(crate) fn reduced_modulus(young: [f64; 2], poisson: [f64; 2]) -> f64 {
    2.0 / [0, 1].map(|i| (1.0 - poisson[i].powi(2)) / young[i]).iter().sum::<f64>()
}

/// Flash temperature of a place, K: how much warmer than the bulk the contact is.
///
/// ```text
/// theta_fl = C mu w |v_1 - v_2| / [sqrt(2 b_H) (B_M1 sqrt(v_1) + B_M2 sqrt(v_2))] = C pi/4 mu p |v_1 - v_2| sqrt(2 b_H) / [..],   b_H = 4 rho_n p/E_r
/// ```
/// `pressure` p, MPa; `friction` mu; `contact` B_M of both gears; `constant` C: 1.11 in ISO/TS 6336-20, 2/sqrt(pi) in ISO/TS 6336-22. Source: H. Blok, Proc. Inst. Mech. Eng. 2 (1937) 222; a heat source with the pressure of Hertz.
pub(crate) fn flash_temperature(
    place: &RollingPlace,
    pressure: f64,
    friction: f64,
    contact: [f64; 2],
    reduced_modulus: f64,
    constant: f64,
) -> f64 {
    let half_width = 4.0 * place.relative_radius * pressure / reduced_modulus;
    let carried = contact[0] * place.speeds[0].sqrt() + contact[1] * place.speeds[1].sqrt();
    // The root of a metre over a millimetre: speeds are in m/s.
    let heat = 1000f64.sqrt() * constant * std::f64::consts::FRAC_PI_4 * friction * pressure * place.sliding_speed();
    heat * (2.0 * half_width).sqrt() / carried
}

/// Torque on the pinion of the scuffing test FZG A/8.3/90 at a load stage, N m; between stages linear. Source: ISO 14635-1, table of load stages.
pub(crate) fn test_torque(stage: f64) -> Option<f64> {
    const TORQUES: [f64; 14] =
        [3.3, 13.7, 35.3, 60.8, 94.1, 135.3, 183.4, 239.3, 302.0, 372.6, 450.1, 534.5, 626.9, 714.2];
    if !(1.0..=TORQUES.len() as f64).contains(&stage) {
        return None;
    }
    let below = (stage.floor() as usize).min(TORQUES.len() - 1);
    let [low, high] = [TORQUES[below - 1], TORQUES[below]];
    Some(low + (high - low) * (stage - below as f64))
}
