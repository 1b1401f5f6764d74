//! Interference of a tip with the fillet of the other gear.

use std::f64::consts::PI;

use crate::roots::bisect;
use crate::{Gear, GearPair};

/// Positions at which the tip edge is looked at on its way through the tooth space.
const SAMPLES: u32 = 240;

impl GearPair {
    /// Largest depth (mm, along the arc in the transverse section) to which the mate's tip edge enters a tooth of the
    /// pinion (0) or the wheel (1), with the driving flanks touching along the line of action. 0: no interference.
    ///
    /// ```text
    /// corner in the gear's frame   R(s / r_b) [ (a, 0) + r_a,m e(psi_0 + s / |r_b,m|) ]
    ///                              s from the tip's contact onwards
    /// its tooth                    |angle - centre line| <= half angle at that radius, involute or fillet
    /// ```
    /// After the tip corner has touched, it moves on towards the line of centres, deeper into the tooth space, and out
    /// again.
    pub fn interference(&self, gear: usize) -> f64 {
        let (own, mate) = if gear == 0 { (&self.pinion, &self.wheel) } else { (&self.wheel, &self.pinion) };
        let (rb, rb_mate, a) = (own.base_radius(), mate.base_radius(), self.centre_distance());
        let a_wt = self.working_pressure_angle();
        // Roll angle of this gear where the mate's tip touches; negative beyond the tangent point.
        let touch = (self.tangent_length() - rb_mate * mate.profile().roll_tip()) / rb;
        let (sin, cos) = a_wt.sin_cos();
        let contact = [rb * (cos + touch * sin), rb * (sin - touch * cos)];
        // Signed as the mate's radii are: its teeth that reach into this gear are about pi.
        let inside = mate.sign();
        let start = (inside * contact[1]).atan2(inside * (contact[0] - a));
        let centre_line = a_wt - touch + own.profile().base_half_angle();
        let outline = Outline::new(own);
        let (own_sign, own_tip, mate_tip) = (own.sign(), own.tip_radius(), mate.tip_radius());
        // From a little before the tip touches until the corner is well past the line of centres.
        let to_centres = (start.rem_euclid(2.0 * PI) - PI).abs();
        let depth = |k: u32| {
            let turn = inside * to_centres * (2.5 * f64::from(k) / f64::from(SAMPLES) - 0.25);
            let (s, c) = (start + turn).sin_cos();
            let (x, y) = (a + mate_tip * c, mate_tip * s);
            let radius = own_sign * x.hypot(y);
            if radius > own_tip {
                return 0.0;
            }
            let angle = (own_sign * y).atan2(own_sign * x) + turn * rb_mate / rb;
            let off = (angle - centre_line + PI).rem_euclid(2.0 * PI) - PI;
            if off.abs() >= outline.widest_from(radius) {
                0.0
            } else {
                radius.abs() * (half_angle(own, radius) - off.abs())
            }
        };
        (0..=SAMPLES).map(depth).fold(0.0, f64::max)
    }
}

/// Places on a fillet, ends included.
const PLACES: usize = 65;

/// How wide a tooth is at most: radii (mm, signed) of places on its fillet, from the root land on, and the largest half angle
/// (rad) from each of them to the tip.
struct Outline([(f64, f64); PLACES]);

impl Outline {
    fn new(gear: &Gear) -> Self {
        let profile = gear.profile();
        let mut places: [_; PLACES] = std::array::from_fn(|i| profile.fillet(i as f64 / (PLACES - 1) as f64));
        let sign = gear.sign();
        let mut widest = sign * profile.half_angle(profile.roll_form());
        for (_, half) in places.iter_mut().rev() {
            widest = widest.max(sign * *half);
            *half = widest;
        }
        Self(places)
    }

    /// Bound of the half angle at a radius (mm) and beyond. A tooth narrows outwards, but for one waist above an
    /// undercut: between two places it is nowhere wider than at one of them.
    fn widest_from(&self, radius: f64) -> f64 {
        self.0[self.0.partition_point(|(r, _)| *r <= radius).saturating_sub(1)].1
    }
}

/// Half tooth angle, without sign, at a signed radius (mm), on the involute or on the fillet; -pi beyond the tip and below the root.
fn half_angle(gear: &Gear, radius: f64) -> f64 {
    let profile = gear.profile();
    if radius > gear.tip_radius() || radius < profile.fillet(0.0).0 {
        return -PI;
    }
    if radius >= gear.form_radius() {
        let u = crate::profile::roll_angle(radius, gear.base_radius()).unwrap_or(0.0);
        return gear.sign() * profile.half_angle(u);
    }
    let t = bisect(0.0, 1.0, |t| radius - profile.fillet(t).0);
    gear.sign() * profile.fillet(t).1
}

#[cfg(test)]
mod tests {
    use super::{Outline, half_angle};
    use crate::{Gear, GearData};

    /// The bound lets no place of a tooth be passed over, undercut teeth among them.
    #[test]
    fn no_tooth_is_wider_than_its_bound() {
        let mut seen = 0;
        for teeth in [6, 8, 13, 17, 30, 100] {
            for profile_shift in [-0.4, 0.0, 0.5] {
                let data = GearData { teeth, profile_shift, bore_diameter: f64::from(teeth), ..GearData::default() };
                let Ok(gear) = Gear::new(data) else { continue };
                seen += 1;
                let (outline, root) = (Outline::new(&gear), gear.profile().fillet(0.0).0);
                for k in 0..=500 {
                    let radius = root + (gear.tip_radius() - root) * f64::from(k) / 500.0;
                    let (own, bound) = (half_angle(&gear, radius), outline.widest_from(radius));
                    assert!(own <= bound + 1e-12, "z {teeth}, x {profile_shift}, r {radius}: {own} against {bound}");
                }
            }
        }
        assert!(seen >= 12, "only {seen} gears could be made");
    }
}
