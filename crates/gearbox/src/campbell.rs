//! Natural frequencies over speed: the Campbell diagram of coupled shafts.

use crate::{GearboxError, Rotors, WhirlModes};

impl Rotors {
    /// Natural modes at each of `speeds` (rad/s) of a reference shaft. Shaft i spins at `ratios[i]` times that speed;
    /// the ratio is negative if it rotates in the opposite sense. Modes are in ascending frequency at each speed;
    /// `study::campbell` finds their intersections with excitation lines.
    ///
    /// # Errors
    /// The errors of [`Rotors::whirl_modes`].
    pub fn campbell(&self, ratios: &[f64], speeds: &[f64]) -> Result<Vec<WhirlModes>, GearboxError> {
        let at = |speed: &f64| self.whirl_modes(&ratios.iter().map(|r| r * speed).collect::<Vec<_>>());
        speeds.iter().map(at).collect()
    }
}
