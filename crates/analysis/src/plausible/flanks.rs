//! Amount of material removed from the flanks of a gear.

use geometry::{Gear, Side};

/// Places along the profile and along the face that are looked at.
const PLACES: usize = 17;

/// Largest depth of the micro-geometry of one side of a gear either way, mm, pitch errors left out.
pub(super) fn largest_depth(gear: &Gear, side: Side) -> f64 {
    let [low, high] = [gear.profile().roll_form(), gear.profile().roll_tip()];
    let width = gear.face_width();
    let part = |i: usize| i as f64 / (PLACES - 1) as f64;
    let places =
        (0..PLACES * PLACES).map(|k| (low + part(k / PLACES) * (high - low), width * (part(k % PLACES) - 0.5)));
    places.map(|(u, z)| own_depth(gear, side, u, z).abs()).fold(0.0, f64::max)
}

/// Thickness of the tip in the middle of the face and at both ends that micro-geometry leaves, at its least, over the
/// nominal one.
pub(super) fn tip_left(gear: &Gear) -> f64 {
    let tip = gear.profile().roll_tip();
    let nominal = 2.0 * gear.tip_radius() * gear.profile().half_angle(tip);
    // Depths are normal to the flank, which is inclined against the circle about the axis by its pressure angle there.
    let cos = (gear.base_radius() / gear.tip_radius()).clamp(0.0, 1.0) * gear.base_helix_angle().cos();
    let gone = |z: f64| [Side::Left, Side::Right].map(|side| own_depth(gear, side, tip, z)).iter().sum::<f64>() / cos;
    let half = 0.5 * gear.face_width();
    let most = [-half, 0.0, half].map(gone).into_iter().fold(0.0, f64::max);
    1.0 - most / nominal
}

/// Depth without the pitch error of the tooth, mm.
fn own_depth(gear: &Gear, side: Side, u: f64, z: f64) -> f64 {
    gear.depth(side, 0, u, z).value - gear.pitch_depth(side, 0)
}
