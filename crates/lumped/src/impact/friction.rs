//! Friction by sliding speed: sticking and slipping without a jump. Theory (56).

use serde::{Deserialize, Serialize};

use crate::{
    LumpedError,
    error::{not_negative, positive},
};

/// Coefficient of friction by sliding speed.
///
/// ```text
/// mu(v) = mu_s (3 x - x^3) / 2                    x = v/v_s,  0 <= v <= v_s
///       = mu_s + (mu_d - mu_s) y^2 (3 - 2 y)      y = (v - v_s)/(v_d - v_s),  v_s <= v <= v_d;   mu_d beyond
/// ```
/// Cubic steps, from -mu_s at -v_s to mu_s at v_s and on to mu_d: slopes do not jump. Below v_s flanks creep where they
/// should stick.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StickSlip {
    /// mu_s.
    pub static_coefficient: f64,
    /// mu_d.
    pub dynamic_coefficient: f64,
    /// v_s, mm/s, > 0.
    pub static_speed: f64,
    /// v_d, mm/s, > v_s.
    pub dynamic_speed: f64,
}

impl StickSlip {
    /// mu and dmu/dv (s/mm) at a sliding speed v >= 0, mm/s.
    pub fn at(&self, speed: f64) -> [f64; 2] {
        let Self { static_coefficient: mu_s, dynamic_coefficient: mu_d, static_speed: v_s, dynamic_speed: v_d } = *self;
        if speed <= v_s {
            let x = speed / v_s;
            return [0.5 * mu_s * x * (3.0 - x * x), 1.5 * mu_s * (1.0 - x * x) / v_s];
        }
        let y = ((speed - v_s) / (v_d - v_s)).min(1.0);
        [mu_s + (mu_d - mu_s) * y * y * (3.0 - 2.0 * y), (mu_d - mu_s) * 6.0 * y * (1.0 - y) / (v_d - v_s)]
    }

    pub(super) fn check(&self) -> Result<(), LumpedError> {
        not_negative("static coefficient of friction", self.static_coefficient)?;
        not_negative("dynamic coefficient of friction", self.dynamic_coefficient)?;
        positive("sliding speed of static friction, mm/s", self.static_speed)?;
        positive(
            "sliding speed of dynamic friction above that of static friction, mm/s",
            self.dynamic_speed - self.static_speed,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The seed's numbers: 0 at rest, 0.08 at 0.1 mm/s, 0.05 from 10 mm/s on, smooth in between.
    #[test]
    fn coefficient_rises_and_falls_without_a_jump() {
        let law =
            StickSlip { static_coefficient: 0.08, dynamic_coefficient: 0.05, static_speed: 0.1, dynamic_speed: 10.0 };
        let [at_rest, sticking, slipping, fast] = [0.0, 0.1, 10.0, 1e4].map(|v| law.at(v)[0]);
        assert_eq!([at_rest, sticking], [0.0, 0.08]);
        assert!((slipping - 0.05).abs() < 1e-15 && (fast - 0.05).abs() < 1e-15);
        for i in 1..300 {
            let v = 0.04 * f64::from(i) + 1e-4;
            let h = 1e-7;
            let difference = (law.at(v + h)[0] - law.at(v - h)[0]) / (2.0 * h);
            assert!((law.at(v)[1] - difference).abs() < 1e-6, "at {v} mm/s: {difference}, not {}", law.at(v)[1]);
        }
    }
}
