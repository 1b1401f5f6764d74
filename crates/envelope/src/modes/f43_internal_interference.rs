//! F43: interference of internal gears in motion.

use std::f64::consts::{PI, TAU};

use analysis::worse;
use geometry::{Gear, GeometryError, TransverseProfile};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 43,
    name: "interference of internal gears",
    file: "F43-internal-interference",
    scene: scene_text!("F43-internal-interference"),
    fails: "A path of contact, tip clearance and backlash are looked for: they are there, and the tips of pinion and ring run into each other beyond that path.",
    does: "Involute and trochoid interference are refused with their amount; a pinion that cannot be put in radially is told of.",
    naive: &["wheel.teeth=-44"],
    look,
};

/// Positions of the gears over a pitch.
const POSITIONS: u32 = 64;

/// Half angle (rad) of a tooth at a radius without sign, mm; that of the root form circle beyond it.
fn half_angle(profile: &TransverseProfile, sign: f64, radius: f64) -> f64 {
    let roll = ((radius / profile.radius(0.0)).powi(2) - 1.0).max(0.0).sqrt();
    let roll = sign * (sign * roll).max(sign * profile.roll_form());
    profile.half_angle(roll).abs()
}

/// Largest arc (mm) by which a tip corner of one gear is inside a tooth of the other over a whole mesh, all teeth, each tooth in the middle
/// of its space; `distance` of the axes without sign, mm. Places beyond the mate's tip circle are free.
fn overlap(pinion: &Gear, ring: &Gear, distance: f64) -> f64 {
    let (z1, z2) = (f64::from(pinion.teeth()), f64::from(ring.teeth()));
    let corner = |gear: &Gear| (gear.tip_radius().abs(), gear.profile().half_angle(gear.profile().roll_tip()).abs());
    let ((r1, half1), (r2, half2)) = (corner(pinion), corner(ring));
    let nearest = |angle: f64, pitch: f64| (angle / pitch - (angle / pitch).round()) * pitch;
    let mut worst = 0.0f64;
    for step in 0..POSITIONS {
        let turned = TAU / z1 * f64::from(step) / f64::from(POSITIONS);
        for (k, side) in (0..pinion.teeth()).flat_map(|k| [(k, 1.0), (k, -1.0)]) {
            let angle = turned + TAU / z1 * f64::from(k) + side * half1;
            let [x, y] = [distance + r1 * angle.cos(), r1 * angle.sin()];
            let radius = x.hypot(y);
            if radius >= r2 {
                // Teeth of the ring are half a pitch from the spaces.
                let off = nearest(y.atan2(x) - turned * z1 / z2 - PI / z2, TAU / z2).abs();
                worst = worse(worst, radius * (half_angle(ring.profile(), -1.0, radius) - off));
            }
        }
        for (k, side) in (0..ring.teeth()).flat_map(|k| [(k, 1.0), (k, -1.0)]) {
            let angle = turned * z1 / z2 + TAU / z2 * (f64::from(k) + 0.5) + side * half2;
            let [x, y] = [r2 * angle.cos() - distance, r2 * angle.sin()];
            let radius = x.hypot(y);
            if radius <= r1 {
                let off = nearest(y.atan2(x) - turned, TAU / z1).abs();
                worst = worse(worst, radius * (half_angle(pinion.profile(), 1.0, radius) - off));
            }
        }
    }
    worst
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let sound = bench.scene(&AS_IT_IS)?.gear_pair()?;
    let refused = bench.scene(&bench.naive(&[]))?;
    let bare = |gear: &Gear, teeth: u32| -> Result<Gear, GeometryError> {
        let data = gear.data().clone();
        let bore_diameter = data.bore_diameter + data.normal_module * (f64::from(gear.teeth()) - f64::from(teeth));
        let profile_shift = data.shaper.map_or(0.0, |shaper| shaper.profile_shift);
        Gear::new(geometry::GearData { teeth, bore_diameter, ..data }.with_usual_shaper(profile_shift))
    };
    let ring = bare(&sound.wheel, refused.wheel.teeth).map_err(EnvelopeError::of("ring"))?;
    let nominal = ring.reference_radius().abs() - sound.pinion.reference_radius();
    let found =
        [overlap(&sound.pinion, &sound.wheel, sound.centre_distance().abs()), overlap(&sound.pinion, &ring, nominal)];
    let solved = bench.at_rest(&AS_IT_IS)?;
    Ok(vec![
        Figure::new(
            "largest overlap of teeth over a whole mesh by brute force, um; naive: a ring of 44 teeth",
            Shown::at_most(1e3 * found[0], 1e-3),
        )
        .beside(Shown::at_least(1e3 * found[1], 50.0)),
        Figure::new("what is said of that ring", Shown::refused(&refused.gear_pair(), "trochoid interference")),
        Figure::new(
            "what is said of a ring of 52 teeth, into which the pinion cannot be put radially",
            Shown::warned(&solved.history.remarks, "cannot be put into the ring radially"),
        ),
    ])
}
