//! Features of a solved pair on which the magnitude of its errors depends.

use geometry::GearPair;
use lumped::iso::rim_ratio;
use scene::{Quantity, Scene};

use super::{Sample, WholeForce};

/// Number of features.
pub const FEATURES: usize = 14;

/// Features of a solved cycle for error laws, each of order one. Theory (64).
pub type Features = [f64; FEATURES];

/// Where the logarithm of a share ends.
const LEAST_SHARE: f64 = 1e-4;
/// Where the logarithm of a share of the contact lines ends.
const LEAST_BARE: f64 = 1e-3;
/// Distance from the whole force, over it, up to which one pair carries all: round-off.
const ALONE: f64 = 1e-5;

/// Features of a scene, its pair and a sample of its cycle.
///
/// | number | what |
/// |---|---|
/// | 0 | 1 |
/// | 1 | tan^2 beta |
/// | 2 | (alpha_n - 20 deg) / 8 deg |
/// | 3 | 1 / eps_alpha |
/// | 4 | tooth height over thickness of the rim, 3 at the most, mean of both gears |
/// | 5 | 17 / z, mean of both gears |
/// | 6 | ln of the peak to peak over the mean deflection |
/// | 7 | ln of the share of the force that is not on the most loaded pair |
/// | 8 | eps_beta / (1 + eps_beta) |
/// | 9 | 1 with tip relief |
/// | 10 | 1 with crowning or misalignment |
/// | 11 | ln of b / (10 m_n) |
/// | 12 | 1 where one pair carries the whole force somewhere in the cycle: it does so on every mesh |
/// | 13 | ln of the unloaded share of the contact lines |
pub fn features(scene: &Scene, pair: &GearPair, sample: &Sample) -> Features {
    let helix = scene.pinion.helix_angle();
    let gears = [&pair.pinion, &pair.wheel];
    let mean = |of: [f64; 2]| 0.5 * (of[0] + of[1]);
    let rim = mean(gears.map(|gear| (1.0 / rim_ratio(gear).max(1e-3)).min(3.0)));
    let teeth = mean([&scene.pinion, &scene.wheel].map(|gear| 17.0 / f64::from(gear.teeth)));
    let overlap = pair.overlap_ratio();
    let logarithm = |share: f64| share.clamp(LEAST_SHARE, 10.0).ln();
    let of = |quantity| sample.get(quantity).unwrap_or(0.0);
    let on_others = WholeForce::of(scene, pair).left(of(Quantity::MaxPairForce));
    let bare = 1.0 - of(Quantity::ContactLineLength) / pair.mean_contact_line_length();
    let flanks = [&scene.pinion, &scene.wheel].map(|gear| &gear.modification.drive);
    let given = |um: Option<f64>| um.is_some_and(|um| um != 0.0);
    let flag = |is: bool| f64::from(u8::from(is));
    let relief = flanks.iter().any(|f| given(f.tip_relief_um) || given(f.root_relief_um));
    let crowned = flanks.iter().any(|f| given(f.lead_crowning_um)) || !scene.pair.misalignment.is_none();
    [
        1.0,
        helix.tan().powi(2),
        (scene.pair.normal_pressure_angle_deg - 20.0) / 8.0,
        1.0 / pair.transverse_contact_ratio(),
        rim,
        teeth,
        logarithm(of(Quantity::PeakToPeakSte) / sample.deflection()),
        logarithm(on_others),
        overlap / (1.0 + overlap),
        flag(relief),
        flag(crowned),
        (pair.face_width() / (10.0 * scene.pair.normal_module_mm)).ln(),
        flag(on_others.abs() < ALONE),
        bare.max(LEAST_BARE).ln(),
    ]
}

/// Whether these are features of a spur pair, which has no overlap.
pub fn is_spur(x: &Features) -> bool {
    x[8] == 0.0
}

/// Share of the force beside the most loaded pair that many pairs have.
pub(super) const USUAL_LEFT: f64 = 0.3;

/// Features before anything is solved: of what only a solved cycle knows, what many pairs have.
pub(super) fn features_before(scene: &Scene, pair: &GearPair) -> Features {
    let mut all = features(scene, pair, &Sample::new(|_| None, 1.0));
    [all[6], all[7], all[12], all[13]] = [0.1f64.ln(), USUAL_LEFT.ln(), 0.0, 0.1f64.ln()];
    all
}
