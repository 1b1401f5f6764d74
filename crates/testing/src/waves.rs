//! Flanks by tooth with a wave that is constant along the contact lines: its order need not be a multiple of the teeth.

use std::{collections::BTreeMap, f64::consts::TAU};

use geometry::{
    FlankModification, Gear, GearModifications, Side,
    modification::{ProfileAxis, Topography, TopographyGrid},
};

/// A wave on all flanks of a gear.
///
/// ```text
/// f_k(u, z) = A cos(O [u - s (2 pi k / z + z tan b_b / r_b)] + phi)
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Wave {
    /// Per turn of the gear.
    pub order: f64,
    /// A, mm, positive where material is removed.
    pub amplitude: f64,
    /// phi, rad.
    pub phase: f64,
}

impl Wave {
    /// Depth on a tooth, mm.
    pub fn depth(&self, gear: &Gear, side: Side, tooth: i64, [u, z]: [f64; 2]) -> f64 {
        let turn = TAU * tooth as f64 / f64::from(gear.teeth()) + gear.twist() * z;
        self.amplitude * (self.order * (u - side.sign() * turn) + self.phase).cos()
    }
}

/// Grid of a depth (mm) over roll angle and height with so many lines either way over the flank, and a few beyond its edges:
/// slopes at the outermost lines are one-sided.
pub fn grid(gear: &Gear, [lines, heights]: [usize; 2], depth: impl Fn([f64; 2]) -> f64) -> TopographyGrid {
    let even = |from: f64, to: f64, count: usize| -> Vec<f64> {
        let step = (to - from) / (count - 1) as f64;
        (0..count + 6).map(|i| from + step * (i as f64 - 3.0)).collect()
    };
    let half = 0.5 * gear.face_width();
    let rolls = even(gear.profile().roll_form(), gear.profile().roll_tip(), lines);
    let z = even(-half, half, heights);
    let depths = rolls.iter().flat_map(|&u| z.iter().map(move |&z| [u, z])).map(depth).collect();
    TopographyGrid::new(ProfileAxis::Roll(rolls), z, depths).unwrap()
}

/// Lines that resolve a wave: a step is a `fine`th of a radian of it at the most.
pub fn lines(gear: &Gear, order: f64, fine: f64) -> [usize; 2] {
    let profile = gear.profile();
    let rolled = order * (profile.roll_tip() - profile.roll_form());
    let along = order * gear.twist().abs() * gear.face_width();
    [rolled, along].map(|radians| ((radians * fine).ceil() as usize).max(8) + 1)
}

/// A gear whose flanks on `side` bear depths (mm) of their own on some teeth; the others are copies.
pub fn with_flanks(
    gear: &Gear,
    side: Side,
    teeth: impl IntoIterator<Item = i64>,
    counts: [usize; 2],
    depth: impl Fn(i64, [f64; 2]) -> f64,
) -> Gear {
    let count = i64::from(gear.teeth());
    let of = |tooth: i64| (tooth.rem_euclid(count) as u32, grid(gear, counts, |at| depth(tooth, at)));
    let topography: Topography = teeth.into_iter().map(of).collect::<BTreeMap<_, _>>().into();
    let flank = FlankModification { topography: Some(topography), ..FlankModification::default() };
    let none = FlankModification::default();
    let (left, right) = if side == Side::Left { (flank, none) } else { (none, flank) };
    let all = GearModifications { left, right, pitch_errors: Vec::new() };
    gear.clone().with_modifications(all).unwrap()
}
