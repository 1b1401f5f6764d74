//! Natural frequencies over speed: the Campbell diagram of coupled shafts.

use crate::{GearboxError, Rotors, WhirlModes};

impl Rotors {
    /// Natural motions at each of `speeds` (rad/s) of a shaft that the others follow: shaft i spins at `ratios[i]`
    /// times that, negative where it turns the other way. Ascending in frequency at each speed;
    /// `study::campbell` finds where lines of excitation meet them.
    ///
    /// # Errors
    /// As [`Rotors::whirl_modes`].
    pub fn campbell(&self, ratios: &[f64], speeds: &[f64]) -> Result<Vec<WhirlModes>, GearboxError> {
        let at = |speed: &f64| self.whirl_modes(&ratios.iter().map(|r| r * speed).collect::<Vec<_>>());
        speeds.iter().map(at).collect()
    }
}
