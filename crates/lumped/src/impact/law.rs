//! Force of an impact by overlap and its rate. Theory (55), (57).

use serde::{Deserialize, Serialize};

use crate::{
    LumpedError,
    error::{finite, not_negative, positive},
};

/// The impact function.
///
/// ```text
/// F = max(0, K delta^e + C s(delta/d) delta'),   s(x) = x^2 (3 - 2 x) for 0 <= x <= 1, 1 beyond;   F = 0 for delta <= 0
/// ```
/// delta overlap (mm), delta' its rate (mm/s). The step lets damping begin without a jump, and flanks that part never
/// pull.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ImpactLaw {
    /// K, N/mm^e: of a tooth pair that touches over its whole face width.
    pub stiffness: f64,
    /// e, at least 1.
    pub exponent: f64,
    /// C, N s/mm: likewise.
    pub damping: f64,
    /// d, mm: overlap from which damping is whole, > 0.
    pub depth: f64,
}

/// Force of the law at one overlap.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ImpactForce {
    /// K delta^e, N.
    pub elastic: f64,
    /// What damping adds, N; not less than the elastic part taken away.
    pub damping: f64,
    /// dF/d delta, N/mm.
    pub by_overlap: f64,
    /// dF/d delta', N s/mm.
    pub by_rate: f64,
    /// Potential of the elastic part, K delta^(e+1) / (e+1), mJ.
    pub potential: f64,
}

impl ImpactLaw {
    /// The law at an overlap (mm) and its rate (mm/s).
    pub fn at(&self, overlap: f64, rate: f64) -> ImpactForce {
        if overlap <= 0.0 {
            return ImpactForce::default();
        }
        let elastic = self.stiffness * overlap.powf(self.exponent);
        let x = (overlap / self.depth).min(1.0);
        let share = x * x * (3.0 - 2.0 * x);
        let share_slope = 6.0 * x * (1.0 - x) / self.depth;
        let damping = self.damping * share * rate;
        let potential = elastic * overlap / (self.exponent + 1.0);
        if elastic + damping <= 0.0 {
            return ImpactForce { elastic, damping: -elastic, potential, ..ImpactForce::default() };
        }
        let by_overlap = self.exponent * elastic / overlap + self.damping * share_slope * rate;
        ImpactForce { elastic, damping, by_overlap, by_rate: self.damping * share, potential }
    }

    pub(super) fn check(&self) -> Result<(), LumpedError> {
        positive("impact stiffness, N/mm^e", self.stiffness)?;
        finite("impact exponent", self.exponent)?;
        if self.exponent < 1.0 {
            return Err(LumpedError::OutOfRange {
                quantity: "impact exponent",
                value: self.exponent,
                method: "the impact function",
                allowed: "1 or more",
            });
        }
        not_negative("impact damping, N s/mm", self.damping)?;
        positive("depth of full impact damping, mm", self.depth)
    }
}

impl ImpactForce {
    /// F, N; never below zero.
    pub fn total(&self) -> f64 {
        self.elastic + self.damping
    }
}

/// Stiffness of the contact of two gears, as the seed takes it from Hertz's theory of two balls, N/mm^1.5.
///
/// ```text
/// K = 4/3 sqrt(R) E*,   1/E* = sum of (1 - nu^2)/E,   R = i d_1 cos a_t tan a_t' / (2 (1 + i) cos b_b)
/// ```
/// d_1 reference diameter of the driving gear (mm), i = z_2/z_1, a_t transverse pressure angle, a_t' that of the mesh,
/// b_b base helix angle; R is the relative normal radius of curvature at the pitch point. Both gears of one material; E
/// in MPa. The formula belongs to the exponent 1.5 of two balls; the seed uses its number with 2.2.
///
/// # Errors
/// [`LumpedError::NotPositive`] when the result is no stiffness.
pub fn contact_stiffness(
    pair: &geometry::GearPair,
    driver: geometry::Driver,
    young: f64,
    poisson: f64,
) -> Result<f64, LumpedError> {
    positive("Young's modulus, MPa", young)?;
    finite("Poisson's ratio", poisson)?;
    let gears = match driver {
        geometry::Driver::Pinion => [&pair.pinion, &pair.wheel],
        geometry::Driver::Wheel => [&pair.wheel, &pair.pinion],
    };
    let ratio = f64::from(gears[1].teeth()) / f64::from(gears[0].teeth());
    let along = 2.0 * gears[0].reference_radius() * gears[0].transverse_pressure_angle().cos();
    let radius =
        ratio * along * pair.working_pressure_angle().tan() / (2.0 * (1.0 + ratio) * pair.base_helix_angle().cos());
    let modulus = young / (2.0 * (1.0 - poisson * poisson));
    let stiffness = 4.0 / 3.0 * radius.sqrt() * modulus;
    positive("impact stiffness, N/mm^e", stiffness)?;
    Ok(stiffness)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: ImpactLaw = ImpactLaw { stiffness: 1.35e6, exponent: 2.2, damping: 50.0, depth: 0.1 };

    /// Nothing apart, no jump at first touch and where damping becomes whole, never a pull.
    #[test]
    fn force_is_continuous_and_never_pulls() {
        for rate in [-1e6, -100.0, 0.0, 100.0] {
            assert_eq!(LAW.at(0.0, rate).total(), 0.0);
            assert_eq!(LAW.at(-1.0, rate).total(), 0.0);
            assert!(LAW.at(1e-9, rate).total() < 1e-3, "at {rate} mm/s");
            for x in [0.1, 0.05, 0.3] {
                let jump = LAW.at(x * (1.0 + 1e-12), rate).total() - LAW.at(x * (1.0 - 1e-12), rate).total();
                assert!(jump.abs() < 1e-4, "{x} mm, {rate} mm/s: jump of {jump} N");
            }
            assert!((0..200).all(|i| LAW.at(0.005 * f64::from(i), rate).total() >= 0.0), "pull at {rate} mm/s");
        }
    }

    #[test]
    fn slopes_are_derivatives() {
        for overlap in [0.02, 0.09, 0.4] {
            for rate in [-20.0, 0.0, 50.0] {
                let (h, here) = (1e-6, LAW.at(overlap, rate));
                let total = |x: f64, v: f64| LAW.at(x, v).total();
                let by_overlap = (total(overlap + h, rate) - total(overlap - h, rate)) / (2.0 * h);
                let by_rate = (total(overlap, rate + h) - total(overlap, rate - h)) / (2.0 * h);
                let elastic = (LAW.at(overlap + h, rate).potential - LAW.at(overlap - h, rate).potential) / (2.0 * h);
                assert!((here.by_overlap - by_overlap).abs() < 1e-6 * by_overlap.abs().max(1.0));
                assert!((here.by_rate - by_rate).abs() < 1e-3);
                assert!((here.elastic - elastic).abs() < 1e-6 * elastic.max(1.0), "potential at {overlap} mm");
            }
        }
    }
}
