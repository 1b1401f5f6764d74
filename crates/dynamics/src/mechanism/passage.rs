//! Whether the teeth of a pair are where teeth can be.

use super::PairMechanism;
use crate::{COORDINATES, Displacement};
use ale::Station;
use ltca::StaticError;

impl PairMechanism {
    /// How far displacements bring the flanks nearer at the pitch point, along the transverse line of action, mm.
    ///
    /// ```text
    /// x = n . (u_1 - u_2) + s (r_b1 theta_1 + r_b2 theta_2),   n = (sin a_wt, s cos a_wt, 0)
    /// ```
    /// s: the side that drives. Theory (45).
    pub(super) fn approach(&self, d: &Displacement) -> f64 {
        let side = self.options.statics.side().sign();
        let (sin, cos) = self.pair.working_pressure_angle().sin_cos();
        let base = [self.pair.pinion.base_radius(), self.pair.wheel.base_radius()];
        let turns: f64 = (0..2).map(|g| base[g] * d[COORDINATES * (g + 1) - 1]).sum();
        sin * (d[0] - d[COORDINATES]) + side * (cos * (d[1] - d[COORDINATES + 1]) + turns)
    }

    /// Refuses a state in which teeth are nearer by half a base pitch than flanks that touch, or farther apart by the
    /// backlash and as much again: on their line of action teeth are half a base pitch thick, so that they have gone
    /// through each other. A step that leaps so far finds an equilibrium between other teeth, and nothing else would
    /// tell.
    ///
    /// # Errors
    /// [`StaticError::PassedThrough`].
    pub(super) fn check_passage(&self, t: f64, d: &Displacement) -> Result<(), StaticError> {
        let (distance_mm, thickness_mm) = (self.approach(d), 0.5 * self.pair.transverse_base_pitch());
        let apart = thickness_mm + self.pair.backlash().max(0.0);
        if distance_mm < thickness_mm && distance_mm > -apart {
            return Ok(());
        }
        let Station { cycle, phase, .. } = Station::at_cycles(self.cycles(t));
        Err(StaticError::PassedThrough { cycle, phase, distance_mm, thickness_mm })
    }
}
