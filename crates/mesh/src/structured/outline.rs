//! Boundary of one tooth's transverse section, divided into element lengths.

use std::f64::consts::FRAC_PI_4;

use geometry::{Gear, TransverseProfile};

use super::options::StructuredOptions;

/// A point in polar coordinates: radius (mm), angle from the tooth's centre line (rad).
pub(super) type Polar = [f64; 2];

/// The counter-clockwise half of the section's boundary at lattice resolution (element ends, and middles for order 2).
pub(super) struct Outline {
    /// From the tip circle to the root form circle, on the involute, then down the fillet to the neck.
    pub side: Vec<Polar>,
    /// From the neck to the middle of the tooth space.
    pub foot: Vec<Polar>,
}

impl Outline {
    /// Divides each of flank, throat (form circle to neck) and foot into equal arc lengths.
    pub fn new(gear: &Gear, options: &StructuredOptions) -> Self {
        let profile = gear.profile();
        let order = options.order as usize;
        let along = options.elements_profile as usize * order;
        let (form, tip) = (profile.roll_form(), profile.roll_tip());
        let mut side: Vec<Polar> = (0..=along)
            .map(|i| {
                // arc length of an involute is r_b u^2 / 2
                let part = i as f64 / along as f64;
                let u = if i == along { form } else { (tip * tip + part * (form * form - tip * tip)).sqrt() };
                [profile.radius(u), profile.half_angle(u)]
            })
            .collect();

        let curve = FilletCurve::new(profile, gear.root_radius(), 0.5 * gear.pitch_angle());
        let total = options.elements_fillet as usize;
        let neck = curve.neck(total);
        let share = (total as f64 * neck / curve.length()).round() as usize;
        let throat = share.clamp(1, total - 1) * order;
        let rest = total * order - throat;
        side.extend((1..=throat).map(|i| curve.at(neck * i as f64 / throat as f64)));
        let foot = (0..=rest).map(|i| curve.at(neck + (curve.length() - neck) * i as f64 / rest as f64)).collect();
        Self { side, foot }
    }

    /// The neck: where tooth block and rim block meet the fillet.
    pub fn neck(&self) -> Polar {
        self.foot[0]
    }
}

/// Fillet and half the root land by arc length from the root form circle.
struct FilletCurve<'a> {
    profile: &'a TransverseProfile,
    root_radius: f64,
    land_start: f64,
    land_length: f64,
    /// Arc length at fillet parameter t = 1 - i / SAMPLES.
    reached: Vec<f64>,
}

/// Tangent at the neck against the circumference, rad (65 deg).
///
/// Tension in the fillet is greatest where the tangent makes 40 to 60 deg with the circumference. Three blocks meet at
/// the neck, so that elements are worst there: at 45 deg default meshes were 4 % (values from Gauss points: 17 %) short
/// of the settled stress, at 65 deg 1 %.
const NECK: f64 = 65.0 * std::f64::consts::PI / 180.0;
/// Fillets of large gears begin flatter than 75 deg; the neck keeps below their beginning.
const NECK_SHARE: f64 = 0.85;
/// With fewer elements than this along the fillet the neck stays at 45 deg (at half of the first slope of flat ones):
/// farther up it would leave nearly the whole fillet to one element, and the tooth 0.2 % stiffer.
const NECK_ELEMENTS: usize = 4;

/// Fine enough that arc lengths are good to 1e-5; points themselves are exact.
const SAMPLES: usize = 512;

impl<'a> FilletCurve<'a> {
    fn new(profile: &'a TransverseProfile, root_radius: f64, half_pitch: f64) -> Self {
        let mut reached = vec![0.0];
        for i in 0..SAMPLES {
            let (dr, arc) = step(profile, i);
            reached.push(reached[i] + dr.hypot(arc));
        }
        let land_start = profile.root_land_start();
        Self { profile, root_radius, land_start, land_length: root_radius * (half_pitch - land_start), reached }
    }

    fn length(&self) -> f64 {
        self.reached[SAMPLES] + self.land_length
    }

    /// Arc length at which the tangent has turned to [`NECK`] from the circumference (to [`NECK_SHARE`] of its first
    /// slope, where the fillet begins flatter), for a fillet of so many elements.
    fn neck(&self, elements: usize) -> f64 {
        let slope = |i| {
            let (dr, arc) = step(self.profile, i);
            dr.atan2(arc)
        };
        let (angle, share) = if elements < NECK_ELEMENTS { (FRAC_PI_4, 0.5) } else { (NECK, NECK_SHARE) };
        let target = angle.min(share * slope(0));
        let turned = (1..SAMPLES).find(|&i| slope(i) <= target).unwrap_or(SAMPLES / 2);
        self.reached[turned]
    }

    fn at(&self, s: f64) -> Polar {
        let fillet = self.reached[SAMPLES];
        if s >= fillet {
            let part = if self.land_length > 0.0 { (s - fillet) / self.root_radius } else { 0.0 };
            return [self.root_radius, self.land_start + part];
        }
        let i = self.reached.partition_point(|&r| r <= s).clamp(1, SAMPLES);
        let (a, b) = (self.reached[i - 1], self.reached[i]);
        let t = 1.0 - (i as f64 - 1.0 + (s - a) / (b - a)) / SAMPLES as f64;
        let (r, angle) = self.profile.fillet(t);
        [r, angle]
    }
}

/// Way down and around (mm) over sample interval i.
fn step(profile: &TransverseProfile, i: usize) -> (f64, f64) {
    let at = |i: usize| profile.fillet(1.0 - i as f64 / SAMPLES as f64);
    let ((r0, a0), (r1, a1)) = (at(i), at(i + 1));
    (r0 - r1, 0.5 * (r0 + r1) * (a1 - a0))
}
