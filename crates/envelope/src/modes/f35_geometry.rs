//! F35: geometry that is wrong but valid.

use analysis::worse;
use geometry::{Gear, Side};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 35,
    name: "geometry wrong but valid",
    file: "F35-geometry",
    scene: scene_text!("F35-geometry"),
    fails: "Profile shift counted in the transverse module, a flank of the wrong hand: every mesh is valid, every answer wrong.",
    does: "Tooth thickness, backlash and the dimension over pins follow from the generated flanks and are held against ISO 21771's formulas.",
    naive: &[],
    look,
};

/// Diameter of the measuring ball over the module.
const BALL: f64 = 1.75;

/// inv(alpha) = tan(alpha) - alpha.
fn involute(angle: f64) -> f64 {
    angle.tan() - angle
}

/// Inverse of the involute function by Newton's method.
fn angle_of(involute_of_it: f64) -> f64 {
    let mut angle = (3.0 * involute_of_it).cbrt().clamp(0.05, 1.2);
    for _ in 0..50 {
        angle -= (involute(angle) - involute_of_it) / angle.tan().powi(2);
    }
    angle
}

/// Radius of the centre of a ball in a tooth space by the formula of ISO 21771, `shift_mm` the profile shift x m_n.
fn ball_centre_by_formula(gear: &Gear, ball_mm: f64, shift_mm: f64) -> f64 {
    let d = gear.data();
    let (alpha_n, alpha_t) = (d.normal_pressure_angle, gear.transverse_pressure_angle());
    let space = std::f64::consts::FRAC_PI_2 / f64::from(d.teeth);
    let shift = 2.0 * shift_mm * alpha_n.tan() / (d.normal_module * f64::from(d.teeth));
    let thinned = d.thickness_allowance / (d.normal_module * f64::from(d.teeth));
    let ball = ball_mm / (d.normal_module * f64::from(d.teeth) * alpha_n.cos());
    let at = angle_of(involute(alpha_t) + ball - space + shift - thinned);
    gear.base_radius() / at.cos()
}

/// Centre of the ball from the surfaces: it moves outwards along the middle of a space, at mid-face, until both flanks are as
/// far from its centre as its radius.
fn ball_centre_by_flanks(gear: &Gear, ball_mm: f64) -> f64 {
    let flanks = [gear.flank_of(Side::Left, 0), gear.flank_of(Side::Right, 1)];
    let middle = 0.5 * gear.pitch_angle();
    let gap = |radius: f64| {
        let centre = geometry::Vec3::new(radius * middle.cos(), radius * middle.sin(), 0.0);
        let nearest = flanks.iter().filter_map(|f| f.locate(&centre)).map(|p| p.distance.abs());
        nearest.fold(f64::INFINITY, f64::min) - 0.5 * ball_mm
    };
    let (mut low, mut high) = (gear.base_radius(), gear.tip_radius() + 2.0 * ball_mm);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if gap(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let pair = bench.scene(&AS_IT_IS)?.gear_pair()?;
    let mut worst = [0.0f64; 2];
    for gear in [&pair.pinion, &pair.wheel] {
        let d = gear.data();
        let ball = BALL * d.normal_module;
        let measured = ball_centre_by_flanks(gear, ball);
        let right = ball_centre_by_formula(gear, ball, d.profile_shift * d.normal_module);
        let wrong = ball_centre_by_formula(gear, ball, d.profile_shift * gear.transverse_module());
        worst = [worse(worst[0], (measured - right).abs()), worse(worst[1], (measured - wrong).abs())];
    }
    // Normal backlash at the working centre distance, from the working tooth thicknesses.
    let [r1, r2] = pair.working_radii();
    let alpha = pair.working_pressure_angle();
    let thickness = |gear: &Gear, radius: f64| 2.0 * radius * (gear.profile().base_half_angle() - involute(alpha));
    let pitch = r1 * pair.pinion.pitch_angle();
    let circular = pitch - thickness(&pair.pinion, r1) - thickness(&pair.wheel, r2);
    let result = bench.at_rest(&AS_IT_IS)?;
    let off = (result.pair.backlash() - circular * alpha.cos()).abs();
    Ok(vec![
        Figure::new("radius of a ball's centre between two flanks against ISO 21771, um; naive: profile shift in the transverse module", Shown::at_most(1e3 * worst[0], 1e-3))
            .beside(Shown::at_least(1e3 * worst[1], 10.0)),
        Figure::new("backlash on the transverse line of action against the tooth thicknesses, um", Shown::at_most(1e3 * off, 1e-6)),
    ])
}
