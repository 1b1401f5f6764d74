//! Data of which no gear, or no running pair, can be made: each refused with its number and a hint.

use geometry::{Gear, GearData, GearPair, GeometryError, Side};

fn data(teeth: u32) -> GearData {
    GearData { teeth, bore_diameter: 1.5 * f64::from(teeth), ..GearData::default() }
}

fn mate(data: GearData) -> GearData {
    GearData { helix_angle: -data.helix_angle, ..data }
}

fn pair_of(pinion: GearData, wheel: GearData, distance: Option<f64>) -> Result<GearPair, GeometryError> {
    GearPair::new(Gear::new(pinion)?, Gear::new(mate(wheel))?, distance)
}

fn refused(pinion: &GearData, wheel: &GearData, distance: Option<f64>, said: &str) {
    let error = pair_of(pinion.clone(), wheel.clone(), distance).err().unwrap_or_else(|| panic!("not refused: {said}"));
    let text = error.to_string();
    assert!(text.contains(said), "`{text}` does not say `{said}`");
    assert!(text.chars().any(|c| c.is_ascii_digit()), "`{text}` has no number");
    assert!(error.hint().is_some_and(|h| h.len() > 10), "`{text}` has no hint");
}

#[test]
fn physical_nonsense_has_a_number_and_a_way_out() {
    let d = data(30);
    refused(&d, &d, Some(80.0), "is too small");
    refused(&d, &d, Some(95.0), "jam");
    refused(&d, &d, Some(103.0), "no path of contact");
    let spur = GearData { helix_angle: 0.0, ..d.clone() };
    refused(&spur, &spur, Some(93.0), "below 1");
    refused(&GearData { profile_shift: 1.4, ..data(12) }, &d, None, "pointed");
    refused(&GearData { profile_shift: -1.5, thickness_allowance: 1.5, ..d.clone() }, &d, None, "no thickness");
    refused(&GearData { bore_diameter: 92.0, ..d.clone() }, &d, None, "no rim");
    refused(&GearData { root_radius_coefficient: 0.6, ..d.clone() }, &d, None, "too large");
    let long = GearData { addendum_coefficient: 1.24, ..data(120) };
    let d = GearData { root_radius_coefficient: 0.45, ..d };
    refused(&d, &long, None, "interference at the root: the wheel's tip enters the fillet of the pinion");
    refused(&long, &d, None, "interference at the root: the pinion's tip enters the fillet of the wheel");
    refused(&GearData { addendum_coefficient: 1.3, ..d.clone() }, &d, None, "root circle");
}

/// The depth of a tip in the other gear's fillet, against both gears turned step by step.
#[test]
fn interference_is_what_turning_the_gears_shows() {
    for (z, longer) in [([30, 120], 1.25), ([20, 60], 1.25), ([25, 80], 1.25), ([40, 200], 1.2)] {
        // The tip is cut off as late as possible: a pair that is made first, and asked then, must not be refused.
        let long = GearData { addendum_coefficient: longer, dedendum_coefficient: 1.3, ..data(z[1]) };
        let own = GearData { dedendum_coefficient: 1.3, root_radius_coefficient: 0.45, ..data(z[0]) };
        let error =
            pair_of(own.clone(), long.clone(), None).err().unwrap_or_else(|| panic!("z {z:?}: no interference"));
        let GeometryError::Interference { depth_mm, .. } = error else { panic!("z {z:?}: {error}") };
        let turned = deepest(&Gear::new(own).unwrap(), &Gear::new(mate(long)).unwrap());
        assert!((depth_mm - turned).abs() <= 0.02 * turned + 1e-5, "z {z:?}: {depth_mm} mm, turned {turned} mm");
    }
}

/// The deepest place of the wheel's tip corners within the pinion's teeth over a turn by three pitches, nominal
/// distance, no backlash.
fn deepest(pinion: &Gear, wheel: &Gear) -> f64 {
    // A pair with shorter tips stands at the same distance and turns alike.
    let short = |g: &Gear| Gear::new(GearData { addendum_coefficient: 0.8, ..g.data().clone() }).unwrap();
    let pair = GearPair::new(short(pinion), short(wheel), None).unwrap();
    let (pitch, a) = (pinion.pitch_angle(), pair.centre_distance());
    let corner = wheel.profile().half_angle(wheel.profile().roll_tip());
    let outline = outline(pinion);
    let steps = 3000;
    let mut worst = 0.0_f64;
    for i in 0..steps {
        let turn = 3.0 * pitch * (f64::from(i) / f64::from(steps) - 0.5);
        let other = pair.wheel_angle(Side::Left, turn);
        for tooth in -2..=2 {
            for side in [-corner, corner] {
                let angle = other + f64::from(tooth) * wheel.pitch_angle() + side;
                let (x, y) = (a + wheel.tip_radius() * angle.cos(), wheel.tip_radius() * angle.sin());
                let (r, own) = (x.hypot(y), y.atan2(x) - turn);
                if r < pinion.root_radius() || r >= pinion.tip_radius() {
                    continue;
                }
                let off = own - (own / pitch).round() * pitch;
                worst = worst.max(r * (half_angle(&outline, r) - off.abs()));
            }
        }
    }
    worst
}

/// Radii (ascending) and half tooth angles from root to tip.
fn outline(gear: &Gear) -> Vec<(f64, f64)> {
    let (p, n) = (gear.profile(), 20_000);
    let part = |i: i32| f64::from(i) / f64::from(n);
    let fillet = (0..=n).map(|i| p.fillet(part(i)));
    let roll = |i: i32| p.roll_form() + part(i) * (p.roll_tip() - p.roll_form());
    let flank = (1..=n).map(|i| (p.radius(roll(i)), p.half_angle(roll(i))));
    fillet.chain(flank).collect()
}

fn half_angle(outline: &[(f64, f64)], radius: f64) -> f64 {
    outline[outline.partition_point(|p| p.0 < radius).min(outline.len() - 1)].1
}

/// At the limit of undercut the involute reaches down to the base circle; below it the rack cuts some away.
#[test]
fn undercut_begins_at_its_limit() {
    for (teeth, helix_deg) in [(12, 0.0_f64), (14, 20.0), (10, 30.0)] {
        let at = |x: f64| {
            Gear::new(GearData { profile_shift: x, helix_angle: helix_deg.to_radians(), ..data(teeth) }).unwrap()
        };
        let limit = at(0.3).undercut_limit();
        assert!(!at(limit + 1e-6).profile().is_undercut(), "z {teeth}: undercut above {limit}");
        assert!(at(limit - 1e-3).profile().is_undercut(), "z {teeth}: no undercut below {limit}");
        assert!(at(limit + 1e-6).profile().roll_form() < 1e-4);
        // However little the rack cuts away, round-off of the limit included: the involute is continuous there, and begins
        // where half of what the rack is too deep is lost.
        let too_deep =
            at(limit).data().normal_module / (at(limit).base_radius() * at(limit).transverse_pressure_angle().sin());
        for power in 3..=16 {
            let below = 10f64.powi(-power);
            let found = at(limit - below).profile().roll_form();
            let wanted = 0.5 * too_deep * below;
            assert!((found - wanted).abs() < 0.05 * wanted + 3e-8, "z {teeth}, {below} below: {found}, not {wanted}");
        }
    }
    // 17 (1 - (1.25 - 0.38 (1 - sin 20 deg)) = 0.9999...) is the textbook's count of teeth.
    let spur = Gear::new(GearData { helix_angle: 0.0, ..data(17) }).unwrap();
    assert!(spur.undercut_limit().abs() < 0.01, "{}", spur.undercut_limit());
}
