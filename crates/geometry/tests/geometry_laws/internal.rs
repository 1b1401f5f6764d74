//! Internal pairs: reference case, laws of random ones, interference against profiles in motion.

use std::f64::consts::PI;

use geometry::{Gear, GearData, GearPair, GeometryError, Shaper, Side, Vec3};

/// The planet and the ring of the second stage of NREL's 5 MW reference gearbox (KISSsoft report 03/2017): z 36/-93, m_n 21, alpha_n 20, x .5039/.1171, a -584; tip shortening of the planet -1.75 mm.
fn nrel(with_distance: bool) -> GearPair {
    let data = GearData {
        normal_module: 21.0,
        helix_angle: 0.0,
        face_width: 550.0,
        thickness_allowance: 0.0,
        ..GearData::default()
    };
    let planet = GearData {
        teeth: 36,
        profile_shift: 0.5039,
        bore_diameter: 400.0,
        tip_diameter: Some(36.0 * 21.0 + 2.0 * (21.0 * 1.5039 - 1.75)),
        ..data.clone()
    };
    let ring = GearData {
        teeth: 93,
        profile_shift: 0.1171,
        bore_diameter: -2200.0,
        root_radius_coefficient: 0.3,
        shaper: Some(Shaper { teeth: 30, profile_shift: 0.0 }),
        ..data
    };
    GearPair::new(Gear::new(planet).unwrap(), Gear::new(ring).unwrap(), with_distance.then_some(-584.0)).unwrap()
}

/// To the printed digits, and to what the rounding of the printed profile shifts leaves: 5e-5 each, 2 um of a diameter, 1e-3 deg of a_wt.
#[track_caller]
fn printed(what: &str, value: f64, wanted: f64, slack: f64) {
    assert!((value - wanted).abs() <= slack, "{what}: {value}, not {wanted}");
}

#[test]
fn the_published_planet_and_ring() {
    for sheet in [nrel(true).sheet(), nrel(false).sheet()] {
        printed("a", sheet.centre_distance_mm, -584.0, 1e-3);
        printed("a_wt", sheet.working_pressure_angle_deg, 15.630, 1e-3);
        printed("d_a2", sheet.wheel.tip_diameter_mm, -1906.081, 2e-3);
        printed("d_f2", sheet.wheel.root_diameter_mm, -2000.581, 2e-3);
        printed("d_Ff2", sheet.wheel.root_form_diameter_mm, -1987.879, 2e-3);
        printed("d_Nf1", sheet.pinion.start_of_active_profile_diameter_mm, 738.082, 2e-3);
        printed("d_Nf2", sheet.wheel.start_of_active_profile_diameter_mm, -1969.750, 2e-3);
        printed("g_alpha", sheet.path_of_contact_mm, 100.284, 4e-3);
        printed("eps_alpha", sheet.eps_alpha, 1.618, 5e-4);
        let ring = sheet.ring.unwrap();
        assert_eq!(ring.tip_diameter_magnitude_mm, -sheet.wheel.tip_diameter_mm);
        assert_eq!(ring.centre_distance_magnitude_mm, -sheet.centre_distance_mm);
        assert!(sheet.wheel.balls.is_some() && sheet.wheel.span.is_none());
    }
}

/// Numbers between 0 and 1, the same in every run.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }

    fn whole(&mut self, low: u32, high: u32) -> u32 {
        (self.between(f64::from(low), f64::from(high) + 1.0)).floor() as u32
    }
}

/// Data of a random pinion and ring; not every one makes a pair.
fn random(r: &mut Random) -> [GearData; 2] {
    let pinion = r.whole(14, 60);
    let ring = pinion + r.whole(10, 90);
    let module = r.between(0.5, 20.0);
    let data = GearData {
        normal_module: module,
        normal_pressure_angle: r.between(17.0, 26.0).to_radians(),
        helix_angle: if r.whole(0, 2) == 0 { 0.0 } else { r.between(-30.0, 30.0).to_radians() },
        face_width: module * r.between(4.0, 12.0),
        thickness_allowance: module * r.between(0.0, 0.03),
        root_radius_coefficient: r.between(0.15, 0.3),
        addendum_coefficient: r.between(0.8, 1.0),
        ..GearData::default()
    };
    let [x1, x2] = [r.between(-0.1, 0.6), r.between(-0.4, 0.4)];
    [
        GearData { teeth: pinion, profile_shift: x1, bore_diameter: 0.3 * module * f64::from(pinion), ..data.clone() },
        GearData { teeth: ring, profile_shift: x2, bore_diameter: -1.3 * module * (f64::from(ring) + 10.0), ..data }
            .with_usual_shaper(0.0),
    ]
}

fn pair_of([pinion, wheel]: [GearData; 2], distance: Option<f64>) -> Result<GearPair, GeometryError> {
    GearPair::new(Gear::new(pinion)?, Gear::new(wheel)?, distance)
}

/// A ring with minus its profile shift at the distance of the right one is told with the shift that was meant, whether it jams or is loose; the right pair is not.
#[test]
fn a_shift_of_the_other_convention_is_told() {
    let mut r = Random(45);
    let mut seen = [0; 2];
    for _ in 0..10_000 {
        let data = random(&mut r);
        let (shift, module) = (data[1].profile_shift, data[0].normal_module);
        let Ok(meant) = pair_of(data.clone(), None) else { continue };
        let distance = meant.centre_distance();
        assert_eq!(meant.ring_shift_of_other_sign(), None);
        let [pinion, ring] = data;
        let written = [pinion, GearData { profile_shift: -shift, ..ring }];
        let apart = pair_of(written.clone(), None).map(|other| (other.centre_distance() - distance).abs() / module);
        if !apart.is_ok_and(|apart| apart > 0.1) {
            continue;
        }
        match pair_of(written, Some(distance)) {
            Err(GeometryError::Jammed { ring_shift, .. }) => {
                assert_eq!(ring_shift, Some(shift));
                seen[0] += 1;
            }
            Ok(loose) => {
                assert_eq!(loose.ring_shift_of_other_sign(), Some(shift));
                seen[1] += 1;
            }
            // Teeth of another shift may run into each other.
            Err(_) => {}
        }
    }
    assert!(seen.into_iter().all(|count| count > 100), "{seen:?}");
}

fn turned(v: Vec3, angle: f64) -> Vec3 {
    let (s, c) = angle.sin_cos();
    Vec3::new(v.x * c - v.y * s, v.x * s + v.y * c, v.z)
}

/// 1,000 random internal pairs have flanks that touch along every contact line at 1e-9 mm, whichever side, with opposite normals; both turn the same way, by the ratio of the teeth; the mean length of the contact lines is eps_alpha b / cos b_b to 1e-9; and in the middle of a line the curvature of the pinion exceeds that of the ring.
#[test]
fn random_internal_pairs_are_conjugate() {
    let mut r = Random(44);
    let mut made = 0;
    for _ in 0..10_000 {
        if made == 1000 {
            break;
        }
        let data = random(&mut r);
        let distance = pair_of(data.clone(), None).map(|pair| pair.centre_distance());
        let moved = r.between(0.0, 0.1) * data[0].normal_module;
        // Axes that are nearer to each other than without backlash: a ring then has more.
        let Ok(pair) = distance.and_then(|a| pair_of(data, Some(a + moved))) else { continue };
        made += 1;
        let [pinion, ring] = [&pair.pinion, &pair.wheel];
        let side = if made % 2 == 0 { Side::Left } else { Side::Right };
        let angle = r.between(-3.0, 3.0);
        let wheel_angle = pair.wheel_angle(side, angle);
        let step = 0.01;
        let ratio = (pair.wheel_angle(side, angle + step) - wheel_angle) / step;
        let wanted = f64::from(pinion.teeth()) / f64::from(ring.teeth());
        assert!((ratio - wanted).abs() < 1e-10, "{made}: {ratio} for {wanted}");
        let lines = pair.contact_lines(side, angle);
        assert!(!lines.is_empty(), "{made}: no contact");
        for line in &lines {
            let [flank, other] = [pinion.flank_of(side, line.tooth), ring.flank_of(side, -line.tooth)];
            for f in [0.0, 0.37, 1.0] {
                let z = line.z[0] + f * (line.z[1] - line.z[0]);
                let u = pair.path_coordinate(side, angle, line.tooth, z) / pinion.base_radius();
                let world = turned(flank.point(u, z), angle);
                let foot =
                    other.locate(&turned(world - Vec3::new(pair.centre_distance(), 0.0, 0.0), -wheel_angle)).unwrap();
                assert!(foot.distance.abs() < 1e-9, "{made}: gap {} at z = {z}", foot.distance);
                let [low, high] = other.roll_range();
                assert!(foot.roll > low - 1e-9 && foot.roll < high + 1e-9, "{made}: {} in {low} .. {high}", foot.roll);
                let normals = turned(flank.normal(u, z), angle) + turned(other.normal(foot.roll, foot.z), wheel_angle);
                assert!(normals.norm() < 1e-10, "{made}: normals {normals}");
                assert!(other.curvatures(foot.roll)[0] < 0.0, "a concave flank");
                assert!(flank.curvatures(u)[0] + other.curvatures(foot.roll)[0] > 0.0, "{made}: the ring is flatter");
            }
        }
        // Lengths are linear between the angles at which an end of a line passes a corner of the plane of action.
        let pitch = pinion.pitch_angle();
        let base = pinion.base_radius();
        let corners = pair.common_face().map(|z| pair.path_coordinate(side, 0.0, 0, z));
        let mut breaks = vec![0.0, pitch];
        for xi in pair.path_of_contact() {
            breaks.extend(corners.map(|corner| (side.sign() * (xi - corner) / base).rem_euclid(pitch)));
        }
        breaks.sort_unstable_by(f64::total_cmp);
        let middles = breaks.windows(2).map(|w| (w[1] - w[0]) * pair.contact_line_length(side, 0.5 * (w[0] + w[1])));
        let mean = middles.sum::<f64>() / pitch;
        let closed = pair.mean_contact_line_length();
        assert!((mean / closed - 1.0).abs() < 1e-9, "{made}: mean length {mean}, closed form {closed}");
    }
    assert_eq!(made, 1000, "random pairs");
}

/// The surface of a ring's flank: normals across the tangents and out of the tooth, foot points, curvature; left is the clockwise side.
#[test]
fn the_flank_of_a_ring_is_consistent() {
    let mut r = Random(7);
    let mut made = 0;
    while made < 20 {
        let [_, data] = random(&mut r);
        let Ok(ring) = Gear::new(data) else { continue };
        made += 1;
        for (side, tooth) in [(Side::Left, 0), (Side::Right, 3), (Side::Left, -2)] {
            let flank = ring.flank_of(side, tooth);
            let [low, high] = flank.roll_range();
            assert_eq!([low, high], [flank.roll_tip, flank.roll_form]);
            let centre = tooth as f64 * ring.pitch_angle();
            for f in [0.1, 0.5, 0.9] {
                let (u, z) = (low + f * (high - low), ring.face_width() * (0.4 * f - 0.3));
                let [du, dz] = flank.tangents(u, z);
                let h = 1e-6;
                let size = ring.base_radius().abs();
                let by_u = (flank.point(u + h, z) - flank.point(u - h, z)) / (2.0 * h);
                let by_z = (flank.point(u, z + h) - flank.point(u, z - h)) / (2.0 * h);
                assert!((du - by_u).norm() < 1e-7 * size && (dz - by_z).norm() < 1e-6, "tangents {du} {by_u}");
                let n = flank.normal(u, z);
                assert!(n.dot(&du).abs() < 1e-10 * size && n.dot(&dz).abs() < 1e-10, "normal");
                let on_tooth = turned(flank.point(u, z), -(centre + ring.twist() * z));
                assert!(on_tooth.x > 0.0 && on_tooth.y * side.sign() < 0.0, "{side:?} is at {on_tooth}");
                let outside = turned(flank.point(u, z) + 0.01 * n, -(centre + ring.twist() * z));
                assert!(outside.y.abs() > on_tooth.y.abs(), "normal points out of the tooth");
                for d in [-0.02, 0.0, 0.05] {
                    let foot = flank.locate(&(flank.point(u, z) + d * n)).unwrap();
                    assert!((foot.distance - d).abs() < 1e-9, "{d} {}", foot.distance);
                    assert!((foot.roll - u).abs() < 1e-9 && (foot.z - z).abs() < 1e-9, "{foot:?}");
                }
                let turned = (flank.normal(u + h, z) - flank.normal(u - h, z)) / (2.0 * h);
                let curvature = turned.dot(&du) / du.norm_squared();
                assert!((curvature * size - flank.curvatures(u)[0] * size).abs() < 1e-6, "{curvature}");
            }
        }
    }
}

/// A ring's fillet, as its shaper makes it: it joins the involute with a common point and tangent, ends on the root circle, has its tangents, and the cutter's tip, turned with the ring, never enters the ring.
#[test]
fn a_shaper_makes_the_fillet() {
    let mut r = Random(3);
    let mut made = 0;
    while made < 40 {
        let [_, data] = random(&mut r);
        let Ok(ring) = Gear::new(data) else { continue };
        made += 1;
        let p = *ring.profile();
        let (radius, angle) = p.fillet(1.0);
        assert!((radius - p.radius(p.roll_form())).abs() < 1e-9 * radius.abs(), "{radius} {}", p.radius(p.roll_form()));
        assert!((angle - p.half_angle(p.roll_form())).abs() < 1e-9, "{angle} {}", p.half_angle(p.roll_form()));
        assert!((p.fillet(0.0).0 - ring.root_radius()).abs() < 1e-9 * radius.abs());
        assert!(p.half_angle(p.roll_tip()) < 0.0 && p.fillet(0.0).1 > -PI / f64::from(ring.teeth()));
        let point = |t: f64| {
            let (r, angle) = p.fillet(t);
            [r * angle.cos(), r * angle.sin()]
        };
        assert!((p.fillet_tangent(0.0) - (0.5 * PI - p.fillet(0.0).1)).abs() < 1e-9);
        for t in [0.1, 0.4, 0.7, 0.95] {
            let ([x0, y0], [x1, y1]) = (point(t - 1e-6), point(t + 1e-6));
            let by_difference = (y0 - y1).atan2(x1 - x0);
            let angle = p.fillet_tangent(t);
            assert!((angle - by_difference).abs() < 1e-5, "t = {t}: {angle} rad, not {by_difference}");
        }
        // The involute's tangent at the form circle: its normal is tangent to the base circle.
        let at_form = p.fillet_tangent(1.0);
        let of_involute = p.half_angle(p.roll_form()) - p.roll_form().atan();
        assert!((at_form + of_involute).abs() < 1e-9, "{at_form} and {of_involute}");
    }
}

/// A ring and a gear with very many teeth are the same rack to a pinion: both limits agree to what 1e5 teeth leave.
#[test]
fn ring_and_gear_have_one_rack_between_them() {
    let of = |teeth: u32, helix: f64, shift: f64| {
        let data =
            GearData { helix_angle: helix, profile_shift: shift, thickness_allowance: 0.0, ..GearData::default() };
        let pinion = Gear::new(data.clone()).unwrap();
        let outer = GearData { teeth, profile_shift: -shift, bore_diameter: 1e3, helix_angle: -helix, ..data.clone() };
        let ring = GearData {
            bore_diameter: -4e5,
            helix_angle: helix,
            root_radius_coefficient: 0.3,
            shaper: Some(Shaper { teeth: 40, profile_shift: 0.0 }),
            ..outer.clone()
        };
        [outer, ring].map(|wheel| GearPair::new(pinion.clone(), Gear::new(wheel).unwrap(), None).unwrap())
    };
    for (helix, shift) in [(0.0, 0.0), (0.3, 0.2), (-0.2, -0.1)] {
        let mut off = Vec::new();
        for teeth in [10_000, 100_000] {
            let [outer, ring] = of(teeth, helix, shift);
            let [a, b] = [&outer, &ring].map(|pair| {
                let [start, end] = pair.path_of_contact();
                let length = pair.contact_line_length(Side::Left, 0.01);
                [start, end, pair.transverse_contact_ratio(), pair.working_pressure_angle(), length]
            });
            off.push((0..5).map(|i| (a[i] / b[i] - 1.0).abs()).fold(0.0, f64::max));
        }
        assert!(off[1] < 5e-4, "{off:?}");
        assert!(off[1] < 0.11 * off[0], "the difference falls as 1/z: {off:?}");
    }
}

/// Half tooth angle, positive, at a radius (magnitude, mm) of a gear: involute, or a table of the fillet; none outside of the tooth's height.
struct Section {
    fillet: Vec<[f64; 2]>,
    form: f64,
    tip: f64,
    base: f64,
    sigma: f64,
    sign: f64,
}

impl Section {
    fn new(gear: &Gear) -> Self {
        let profile = gear.profile();
        let fillet = (0..=4000).map(|i| {
            let (r, angle) = profile.fillet(f64::from(i) / 4000.0);
            [r.abs(), angle.abs()]
        });
        Self {
            fillet: fillet.collect(),
            form: gear.form_radius().abs(),
            tip: gear.tip_radius().abs(),
            base: gear.base_radius().abs(),
            sigma: profile.base_half_angle(),
            sign: gear.sign(),
        }
    }

    /// Arc by which a place is in a tooth whose centre line is `off` rad away, mm; negative outside.
    fn depth(&self, radius: f64, off: f64) -> f64 {
        if (radius - self.tip) * self.sign > 0.0 {
            return f64::NEG_INFINITY;
        }
        let half = if (radius - self.form) * self.sign >= 0.0 {
            let u = ((radius / self.base).powi(2) - 1.0).max(0.0).sqrt();
            self.sign * (self.sigma - (u - u.atan()))
        } else {
            let i = self.fillet.partition_point(|[r, _]| (radius - r) * self.sign > 0.0);
            match (i.checked_sub(1).and_then(|i| self.fillet.get(i)), self.fillet.get(i)) {
                (Some([r0, a0]), Some([r1, a1])) => a0 + (a1 - a0) * (radius - r0) / (r1 - r0),
                // In the root: the wall of the space is beyond.
                _ => return f64::INFINITY,
            }
        };
        radius * (half - off.abs())
    }
}

/// Largest arc (mm) by which a corner of any tip enters the other gear, centres `distance` apart (signed), at angles of the gears.
fn overlap(gears: [&Gear; 2], sections: &[Section; 2], distance: f64, angles: [f64; 2]) -> f64 {
    let pitches = gears.map(|gear| 2.0 * PI / f64::from(gear.teeth()));
    let mut most = f64::NEG_INFINITY;
    for (own, mate) in [(0, 1), (1, 0)] {
        let profile = gears[own].profile();
        let half = profile.half_angle(profile.roll_tip()).abs();
        let from = if own == 0 { -distance } else { distance };
        // Beyond this angle the tip circle is outside of the other gear's.
        let [r1, r2, a] = [sections[0].tip, sections[1].tip, distance.abs()];
        let cos =
            if own == 0 { (r2 * r2 - r1 * r1 - a * a) / r1 } else { (a * a + r2 * r2 - r1 * r1) / r2 } / (2.0 * a);
        let reach = cos.clamp(-1.0, 1.0).acos() + half;
        let [first, last] = [-reach, reach].map(|end| ((end - angles[own]) / pitches[own]).floor() as i32);
        for tooth in first..=last {
            let centre = angles[own] + f64::from(tooth) * pitches[own];
            for corner in [centre - half, centre + half] {
                let (x, y) = (from + sections[own].tip * corner.cos(), sections[own].tip * corner.sin());
                let radius = x.hypot(y);
                // Farther off than the other gear's tips.
                if (radius - sections[mate].tip) * sections[mate].sign > 0.0 {
                    continue;
                }
                let off = (y.atan2(x) - angles[mate]) / pitches[mate];
                most = most.max(sections[mate].depth(radius, (off - off.round()) * pitches[mate]));
            }
        }
    }
    most
}

/// Overlap of two gears in motion, drive flanks touching as those of `pair` do, mm.
fn overlap_in_motion(pair: &GearPair, gears: [&Gear; 2], steps: u32) -> f64 {
    let sections = gears.map(Section::new);
    let at = |i: u32| {
        let angle = pair.pinion.pitch_angle() * f64::from(i) / f64::from(steps);
        overlap(gears, &sections, pair.centre_distance(), [angle, pair.wheel_angle(Side::Left, angle)])
    };
    (0..steps).map(at).fold(f64::NEG_INFINITY, f64::max)
}

/// Least room (mm) that a tip corner of the pinion has beside the ring's corner that it passes when the pinion is put in along the line of centres, at any angle: the corner keeps its distance from that line.
fn room_on_the_way(pair: &GearPair, gears: [&Gear; 2], steps: u32) -> f64 {
    let tips = gears.map(|gear| gear.tip_radius().abs());
    let halves = gears.map(|gear| gear.profile().half_angle(gear.profile().roll_tip()).abs());
    let at = |i: u32| {
        let angle = 0.5 * PI * f64::from(i) / f64::from(steps);
        let corners = [angle + halves[0], pair.wheel_angle(Side::Left, angle) - halves[1]];
        let [[x1, y1], [x2, y2]] = [0, 1].map(|k| [tips[k] * corners[k].cos(), tips[k] * corners[k].sin()]);
        // Only where it ends up beyond the ring's corner, from before its own widest place.
        if x1 > 0.0 && x1 - pair.centre_distance() > x2 { y2 - y1 } else { f64::INFINITY }
    };
    (0..steps).map(at).fold(f64::INFINITY, f64::min)
}

/// A ring with few more teeth than its pinion, low teeth and no backlash: a pair that runs, and its gear data.
fn close_pair(r: &mut Random) -> Option<(GearPair, [GearData; 2])> {
    let pinion = r.whole(16, 70);
    let ring = pinion + r.whole(6, 16);
    let data = GearData {
        normal_module: 2.0,
        helix_angle: 0.0,
        normal_pressure_angle: r.between(18.0, 28.0).to_radians(),
        face_width: 20.0,
        thickness_allowance: 0.0,
        root_radius_coefficient: 0.1,
        dedendum_coefficient: 1.4,
        addendum_coefficient: r.between(0.4, 0.6),
        ..GearData::default()
    };
    let [x1, x2] = [r.between(0.0, 0.3), r.between(-0.3, 0.0)];
    let pinion = GearData { teeth: pinion, profile_shift: x1, bore_diameter: 5.0, ..data.clone() };
    let ring = GearData { teeth: ring, profile_shift: x2, bore_diameter: -2.0 * f64::from(ring) - 20.0, ..data }
        .with_usual_shaper(0.0);
    let pair = pair_of([pinion.clone(), ring.clone()], None).ok()?;
    Some((pair, [pinion, ring]))
}

/// Tip diameters of one gear, the last that is free and the first that is not, of a verdict that changes between its own and a taller tooth's.
fn limit(data: &GearData, apart: f64, free: impl Fn(&Gear) -> Option<bool>) -> Option<[Gear; 2]> {
    let of = |tip: f64| Gear::new(GearData { tip_diameter: Some(tip), ..data.clone() }).ok();
    let own = Gear::new(data.clone()).ok()?;
    let step = 0.05 * data.normal_module;
    let mut good = 2.0 * own.tip_radius();
    if !free(&own)? {
        return None;
    }
    while free(&of(good + step)?)? {
        good += step;
    }
    let mut bad = good + step;
    for _ in 0..60 {
        let middle = 0.5 * (good + bad);
        if free(&of(middle)?)? { good = middle } else { bad = middle }
    }
    Some([of(good - apart)?, of(bad + apart)?])
}

/// The formulas of trochoid interference, of interference at the pinion's root and at the ring's, and of radial assembly say what
/// profiles in motion show, on both sides of their limits: 300 pairs, 75 of a kind.
mod verdicts_of_interference_are_those_of_profiles_in_motion {
    #[test]
    fn trochoids() {
        super::verdicts(0);
    }
    #[test]
    fn root_of_the_pinion() {
        super::verdicts(1);
    }
    #[test]
    fn root_of_the_ring() {
        super::verdicts(2);
    }
    #[test]
    fn radial_assembly() {
        super::verdicts(3);
    }
}

fn verdicts(kind: usize) {
    const PAIRS: usize = 75;
    let (mut r, mut seen) = (Random(300 + kind as u64), 0);
    for _ in 0..20_000 {
        let Some((pair, [pinion, ring])) = close_pair(&mut r) else { continue };
        if seen == PAIRS {
            break;
        }
        let distance = Some(pair.centre_distance());
        let taken = 1e-3 * pinion.normal_module;
        let with = |gears: [&Gear; 2]| GearPair::new(gears[0].clone(), gears[1].clone(), distance);
        // What is looked at: none where the tooth fails for another reason.
        let own = usize::from(kind == 1);
        let fixed = if own == 0 { &pair.wheel } else { &pair.pinion };
        let gears =
            |changed: &Gear| if own == 0 { [changed.clone(), fixed.clone()] } else { [fixed.clone(), changed.clone()] };
        let free = |changed: &Gear| {
            let [a, b] = gears(changed);
            match (kind, with([&a, &b])) {
                (0, Err(GeometryError::Trochoid { margin, .. })) => Some(margin >= 0.0),
                (1, Err(GeometryError::Involute { .. }))
                | (2, Err(GeometryError::Interference { tip: "pinion", .. })) => Some(false),
                (3, Ok(pair)) => Some(pair.trimming_margin()? >= 0.0),
                (_, Ok(_)) => Some(true),
                _ => None,
            }
        };
        let apart = 2e-3 * pinion.normal_module;
        let Some(ends) = limit(if own == 0 { &pinion } else { &ring }, apart, free) else { continue };
        for (end, is_free) in ends.iter().zip([true, false]) {
            let [a, b] = gears(end);
            let depth = match kind {
                3 => -room_on_the_way(&pair, [&a, &b], 20_000),
                _ => overlap_in_motion(&pair, [&a, &b], 1000),
            };
            let shown = depth <= if matches!(kind, 1 | 2) { taken } else { 1e-9 };
            assert_eq!(shown, is_free, "kind {kind}, z {} in {}: overlap {depth} mm", pinion.teeth, ring.teeth);
        }
        seen += 1;
    }
    assert_eq!(seen, PAIRS, "pairs around the limits");
}

/// At 20 degrees and x = 0, z_2 - z_1 >= 9 runs for z_1 >= 30, and radial assembly fails up to 16, of 60 teeth up to 15.
#[test]
fn differences_of_teeth_that_run() {
    let of = |teeth: u32, more: u32| {
        // A low root of the pinion, so that tips alone decide.
        let data = GearData {
            helix_angle: 0.0,
            thickness_allowance: 0.0,
            bore_diameter: 5.0,
            root_radius_coefficient: 0.2,
            ..GearData::default()
        };
        let ring =
            GearData { teeth: teeth + more, bore_diameter: -3.0 * f64::from(teeth + more) - 30.0, ..data.clone() };
        let pinion = GearData { teeth, dedendum_coefficient: 1.6, root_radius_coefficient: 0.1, ..data };
        pair_of([pinion, ring.with_usual_shaper(0.0)], None)
    };
    for teeth in [30, 40, 60] {
        for more in [6, 7, 8] {
            let error = of(teeth, more).unwrap_err();
            assert!(matches!(error, GeometryError::Trochoid { .. }), "{teeth} and {more} more: {error}");
        }
        for more in 9..=if teeth < 60 { 16 } else { 15 } {
            assert!(of(teeth, more).unwrap().trimming_margin().unwrap() < 0.0, "{teeth} and {more} more");
        }
        assert!(of(teeth, 18).unwrap().trimming_margin().unwrap() >= 0.0, "{teeth} and 18 more");
    }
}

/// Every refusal of a ring has its number and a hint that, where it names a value, cures it.
#[test]
fn hints_cure_interference() {
    let data = GearData {
        helix_angle: 0.0,
        bore_diameter: 5.0,
        dedendum_coefficient: 1.4,
        root_radius_coefficient: 0.1,
        ..GearData::default()
    };
    let ring = |teeth: u32, shaper: u32| GearData {
        teeth,
        bore_diameter: -3.0 * f64::from(teeth) - 30.0,
        shaper: Some(Shaper { teeth: shaper, profile_shift: 0.0 }),
        ..data.clone()
    };
    let pinion = |teeth: u32| GearData { teeth, ..data.clone() };
    let error = pair_of([pinion(40), ring(47, 24)], None).unwrap_err();
    let GeometryError::Trochoid { pinion_tip_mm: Some(tip), .. } = error else { panic!("{error}") };
    assert!(error.hint().unwrap().contains(&tip.to_string()));
    pair_of([GearData { tip_diameter: Some(tip), ..pinion(40) }, ring(47, 24)], None).unwrap();
    let high_root = GearData { dedendum_coefficient: 1.25, root_radius_coefficient: 0.38, ..pinion(20) };
    let ring = |teeth: u32, shaper: u32| GearData { dedendum_coefficient: 1.25, ..ring(teeth, shaper) };
    let error = pair_of([high_root.clone(), ring(44, 24)], None).unwrap_err();
    let GeometryError::Involute { ring_tip_mm: Some(tip), .. } = error else { panic!("{error}") };
    pair_of([high_root, GearData { tip_diameter: Some(tip), ..ring(44, 24) }], None).unwrap();
    for shaper in [8, 47] {
        let error = Gear::new(ring(50, shaper)).unwrap_err();
        let GeometryError::ShaperInterference { cure: Some(teeth), .. } = error else { panic!("{error}") };
        Gear::new(ring(50, teeth)).unwrap();
    }
    let own = Gear::new(ring(40, 24)).unwrap();
    assert!(matches!(GearPair::new(own.clone(), own, None), Err(GeometryError::InternalPinion)));
    assert!(matches!(pair_of([pinion(40), ring(40, 24)], None), Err(GeometryError::OutOfRange { .. })));
    assert!(matches!(Gear::new(GearData { bore_diameter: -100.0, ..ring(40, 24) }), Err(GeometryError::Bore { .. })));
    let rounded = GearData { root_radius_coefficient: 0.9, ..ring(40, 24) };
    let error = Gear::new(rounded.clone()).unwrap_err();
    let GeometryError::RootRadius { largest, .. } = error else { panic!("{error}") };
    Gear::new(GearData { root_radius_coefficient: largest - 1e-6, ..rounded }).unwrap();
}
