//! Loads too light for the round-off of flank positions; they are rejected before the solution.

use geometry::GearPair;
use ltca::{GUESSED_LINE_STIFFNESS, round_off_of_places};
use scene::Scene;

use crate::{AnalysisError, error::place_in, loaded_pair::LoadedPair, refused::Refusal, static_certificate::ROUND_OFF};

/// What the guessed stiffness may be off by.
const GUESS: f64 = 3.0;
/// Effective modulus of two steel flanks, MPa, which the guessed stiffness is of.
const STEEL_MPA: f64 = 2.06e5 / (2.0 * (1.0 - 0.3 * 0.3));

/// Refuses a torque under which teeth come nearer by less than places are known: the certificate of the result would not
/// hold ([`ROUND_OFF`]). Without a torque there is nothing to lose.
///
/// ```text
/// share = 16 eps a/(F_bt/(c' b)),   c' = 14 N/(mm um), in proportion to the modulus of the flanks
/// ```
///
/// # Errors
/// [`AnalysisError::Refused`] at the torque's place in the scene.
pub(crate) fn check(scene: &Scene, pair: &GearPair) -> Result<(), AnalysisError> {
    let loaded = LoadedPair::of(scene, pair);
    let force = loaded.base_force();
    if force == 0.0 {
        return Ok(());
    }
    let stiffness = GUESSED_LINE_STIFFNESS * loaded.effective_modulus() / STEEL_MPA * pair.face_width();
    let (approach, places) = (force / stiffness, round_off_of_places(pair.centre_distance().abs()));
    let share = places / approach;
    if share <= GUESS * ROUND_OFF {
        return Ok(());
    }
    let torque = scene.operation.torque_nm;
    // A digit that says so: twice what the guess may be off by.
    let enough = torque * share / ROUND_OFF * 2.0 * GUESS;
    let refusal = Refusal::input(
        format!(
            "{torque:e} N·m is too small for this pair: the teeth deflect {approach:.0e} mm, and positions of flanks \
             are known to {places:.0e} mm (round_off_share {share:.2}, limit {ROUND_OFF})",
        ),
        format!("take `torque_nm = {enough:.0e}` or more, or 0 for the unloaded pair"),
    );
    Err(AnalysisError::from(refusal).at(place_in(scene, &["operation.torque_nm"])))
}
