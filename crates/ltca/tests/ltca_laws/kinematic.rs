//! Unloaded, modified, misaligned flanks: the angle at which they just touch against the closed form in the plane of
//! action.
//!
//! The closed form takes the gap of two flanks along their nominal contact line to be the sum of the depths. Flanks
//! that are tilted against each other by G touch beside that line, R G^2 / 2 earlier (R: relative radius of curvature):
//! a few nanometres for depths of a micrometre, and half a micrometre in the middle of a relief of 30 um. The search
//! finds the true place.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use ale::Station;
use contact::{Misalignment, Offset};
use geometry::{
    Driver, FlankModification, Gear, GearData, GearModifications, GearPair, Sense, Side,
    modification::{EndRelief, ProfilePlace, Relief, ReliefShape},
};
use ltca::{StaticOptions, kinematic_transmission_error};
use nalgebra::{Rotation3, Vector3};

fn pair(beta_deg: f64, modifications: [GearModifications; 2]) -> GearPair {
    let data = GearData { helix_angle: beta_deg.to_radians(), ..GearData::default() };
    let wheel = GearData { teeth: 37, helix_angle: -data.helix_angle, bore_diameter: 70.0, ..data.clone() };
    let [a, b] = modifications;
    let pinion = Gear::new(data).unwrap().with_modifications(a).unwrap();
    GearPair::new(pinion, Gear::new(wheel).unwrap().with_modifications(b).unwrap(), None).unwrap()
}

fn options(pair: &GearPair) -> StaticOptions {
    StaticOptions::new(0.0, pair)
}

/// One modification on both sides of both gears: tips relieved by `amount` (mm) over the last part of the profile from
/// `from` on.
fn flanks(
    beta_deg: f64,
    from: f64,
    amount: f64,
    shape: ReliefShape,
    rest: &FlankModification,
) -> [FlankModification; 2] {
    let plain = pair(beta_deg, Default::default());
    [&plain.pinion, &plain.wheel].map(|gear| {
        let (form, tip) = (gear.profile().roll_form(), gear.profile().roll_tip());
        let start = ProfilePlace::Roll(form + from * (tip - form));
        FlankModification { tip_relief: Some(Relief { amount, start, shape }), ..rest.clone() }
    })
}

/// Values of one turn or so that no tooth pair repeats, between -1 and 1.
fn scatter(teeth: u32) -> Vec<f64> {
    (0..teeth).map(|k| (f64::from(k * k) * 0.7 + f64::from(k)).sin()).collect()
}

/// A mesh cycle, or one after the other at eight stations each.
fn stations(count: usize) -> impl Iterator<Item = Station> {
    let each = if count == 16 { 16 } else { 8 };
    (0..count).map(move |i| Station { cycle: (i / each) as i64, phase: (i % each) as f64 / each as f64 })
}

/// TE(phi) = min over all points of the contact lines of (h_1 + h_2 - R G^2 / 2) / cos b_b, in the plane of action
/// alone.
///
/// G is the slope of h_1 + h_2 along the profile and R the relative radius of curvature: flanks that are tilted against
/// each other touch a little beside the nominal line. That term is the only one of second order; `second_order` leaves
/// it out or in.
fn closed_form(pair: &GearPair, options: &StaticOptions, station: Station, second_order: bool) -> f64 {
    let side = options.side();
    let sign = options.contact.sense.sign();
    let theta = pair.middle_angle(side) + sign as f64 * (station.phase - 0.5) * pair.pinion.pitch_angle();
    let middle = -sign * station.cycle;
    let (rb1, rb2) = (pair.pinion.base_radius(), pair.wheel.base_radius());
    let cos_b = pair.base_helix_angle().cos();
    let centres = [Vector3::zeros(), Vector3::x() * pair.centre_distance()];
    let tilts = options.contact.offsets.map(|o| Vector3::new(o.tilt_x, o.tilt_y, 0.0));
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), theta);
    let length = pair.tangent_length();
    let mut least = f64::INFINITY;
    for line in pair.contact_lines(side, theta) {
        let running = middle + line.tooth;
        let depth = |z: f64| {
            let xi = pair.path_coordinate(side, theta, line.tooth, z);
            let [h1, h2] = [
                pair.pinion.depth(side, running, xi / rb1, z),
                pair.wheel.depth(side, -running, (length - xi) / rb2, z),
            ];
            // Along the profile a step ds turns the roll angles by ds / (r_b u) against each other's sense.
            let slope = h1.by_roll / xi - h2.by_roll / (length - xi);
            let radius = xi * (length - xi) / (length * cos_b);
            let gain = if second_order { 0.5 * radius * slope * slope } else { 0.0 };
            // Tilted gears: the wheel's material moves away along the pinion's normal, or the pinion's comes nearer.
            let flank = pair.pinion.flank_of(side, line.tooth);
            let (place, normal) = (turn * flank.point(xi / rb1, z), turn * flank.normal(xi / rb1, z));
            let moved = [0, 1].map(|i| tilts[i].cross(&(place - centres[i])).dot(&normal));
            h1.value + h2.value - gain + moved[1] - moved[0]
        };
        let n = 2000;
        let at = |i: usize| line.z[0] + (line.z[1] - line.z[0]) * i as f64 / n as f64;
        let best = (0..=n).min_by(|&a, &b| depth(at(a)).total_cmp(&depth(at(b)))).unwrap();
        let (mut a, mut b) = (at(best.saturating_sub(1)), at((best + 1).min(n)));
        for _ in 0..80 {
            let (x, y) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if depth(x) <= depth(y) { b = y } else { a = x }
        }
        least = least.min(depth(at(best))).min(depth(0.5 * (a + b)));
    }
    least / cos_b
}

/// Largest deviations (um) of the kinematic TE from the closed form of first and of second order, and its peak to peak.
fn deviations(pair: &GearPair, options: &StaticOptions, count: usize) -> [f64; 3] {
    let (mut worst, mut low, mut high) = ([0.0f64; 2], f64::INFINITY, f64::NEG_INFINITY);
    for station in stations(count) {
        let te = kinematic_transmission_error(pair, &options.contact, station).unwrap();
        for (k, w) in worst.iter_mut().enumerate() {
            *w = w.max(1e3 * (te - closed_form(pair, options, station, k == 1)).abs());
        }
        (low, high) = (low.min(te), high.max(te));
    }
    [worst[0], worst[1], 1e3 * (high - low)]
}

/// Each kind of modification alone on top of a little tip relief, and all of them, mm, half a micrometre or less; none
/// moves the place of first touch past the relief.
fn kinds() -> Vec<(&'static str, FlankModification)> {
    use ReliefShape::{Linear, Parabolic};
    let none = FlankModification::default;
    let um = 0.5e-3;
    let end = |amount: f64, shape| Some(EndRelief { amount: amount * um, length: 4.0, shape });
    let all = FlankModification {
        profile_crowning: 0.2 * um,
        profile_slope: 0.1 * um,
        lead_crowning: 0.5 * um,
        lead_slope: 0.3 * um,
        end_relief: [end(0.5, Parabolic), end(0.7, Parabolic)],
        bias: 0.2 * um,
        ..none()
    };
    vec![
        ("tip relief alone", none()),
        ("profile crowning", FlankModification { profile_crowning: 0.4 * um, ..none() }),
        ("profile slope", FlankModification { profile_slope: 0.4 * um, ..none() }),
        ("lead crowning", FlankModification { lead_crowning: um, ..none() }),
        ("lead slope", FlankModification { lead_slope: um, ..none() }),
        ("end relief", FlankModification { end_relief: [end(1.0, Linear), end(0.5, Parabolic)], ..none() }),
        ("bias", FlankModification { bias: 0.4 * um, ..none() }),
        ("all", all),
    ]
}

/// Every kind of modification and pitch errors, spur and helical, either hand: the geometric transmission error within
/// 1e-3 um.
#[test]
fn kinematic_te_is_the_geometric_one() {
    for beta in [0.0f64, 12.0, -20.0] {
        for (k, (name, rest)) in kinds().into_iter().enumerate() {
            let shape = [ReliefShape::Linear, ReliefShape::Parabolic][(k + beta.abs() as usize / 10) % 2];
            // Pitch errors with the first and the last of them.
            let pitches: &[f64] = if matches!(k, 0 | 7) { &[0.0, 0.08e-3] } else { &[0.0] };
            for &pitch in pitches {
                let [a, b] = flanks(beta, 0.6, 0.6e-3, shape, &rest);
                let ground = |m, teeth| {
                    let pitch_errors = scatter(teeth).iter().map(|e| pitch * e).collect();
                    GearModifications { pitch_errors, ..GearModifications::both(m) }
                };
                let pair = pair(beta, [ground(a, 30), ground(b, 37)]);
                let count = if pitch == 0.0 { 8 } else { 24 };
                let [first, _, span] = deviations(&pair, &options(&pair), count);
                let at = format!("beta {beta}, {shape:?}, {name}, pitch errors {pitch} mm");
                println!("{at}: peak to peak {span:.4} um, off by {first:.6} um");
                assert!(first < 1e-3, "{at}: off by {first} um of {span} um");
            }
        }
    }
}

/// What the closed form leaves out is of second order: twice the depths, four times as much; and most of it is R G^2
/// / 2.
#[test]
fn the_closed_form_is_of_first_order() {
    for beta in [0.0, -20.0] {
        let rest = FlankModification { lead_crowning: 2e-3, ..FlankModification::default() };
        let off = |scale: f64| {
            let rest = FlankModification { lead_crowning: scale * rest.lead_crowning, ..rest.clone() };
            let flanks = flanks(beta, 0.6, 5e-3 * scale, ReliefShape::Parabolic, &rest);
            let pair = pair(beta, flanks.map(GearModifications::both));
            deviations(&pair, &options(&pair), 16)
        };
        let (one, two) = (off(1.0), off(2.0));
        println!("beta {beta}: off by {:.5} and {:.5} um, with R G^2 / 2 by {:.6} um", one[0], two[0], one[1]);
        let growth = two[0] / one[0];
        assert!((3.0..5.0).contains(&growth), "beta {beta}: {one:?}, twice the depths {two:?}");
        assert!(one[1] < 0.1 * one[0], "beta {beta}: {one:?}");
    }
}

/// TE of a spur pair with the same profile at every height, by turning: each point of the pinion's profile asks for a
/// turn of the wheel that brings the wheel's profile, at the point's own radius, to it; the first touch is the least of
/// them. No normals and no feet, exact at any depth, tip corners included.
fn by_turning(pair: &GearPair, options: &StaticOptions, station: Station) -> f64 {
    let side = options.side();
    let theta1 = pair.middle_angle(side) + (station.phase - 0.5) * pair.pinion.pitch_angle();
    let theta2 = pair.wheel_angle(side, theta1);
    let base = pair.wheel.base_radius();
    let mut least = f64::INFINITY;
    for tooth in -3i64..=3 {
        let running = tooth - station.cycle;
        let pinion = pair.pinion.modified_flank_at(side, tooth, running);
        let wheel = pair.wheel.modified_flank_at(side, -tooth, -running);
        let [v_form, v_tip] = [wheel.nominal().roll_form, wheel.nominal().roll_tip];
        let radius = |v: f64| wheel.point(v, 0.0).xy().norm();
        let turn = |u: f64| -> f64 {
            let p = Rotation3::from_axis_angle(&Vector3::z_axis(), theta1) * pinion.point(u, 0.0);
            let seen =
                Rotation3::from_axis_angle(&Vector3::z_axis(), -theta2) * (p - Vector3::x() * pair.centre_distance());
            let r = seen.xy().norm();
            if r < radius(v_form) || r > radius(v_tip) {
                return f64::INFINITY;
            }
            let (mut low, mut high) = (v_form, v_tip);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if radius(middle) < r { low = middle } else { high = middle }
            }
            let q = wheel.point(0.5 * (low + high), 0.0);
            // Angle from the wheel's point to the pinion's, both at this radius.
            side.sign() * base * (q.x * seen.y - q.y * seen.x).atan2(q.x * seen.x + q.y * seen.y)
        };
        let (form, tip) = (pinion.nominal().roll_form, pinion.nominal().roll_tip);
        let n = 400;
        let at = |i: usize| form + (tip - form) * i as f64 / n as f64;
        let turns: Vec<f64> = (0..=n).map(|i| turn(at(i))).collect();
        let best = (0..=n).min_by(|&a, &b| turns[a].total_cmp(&turns[b])).unwrap();
        let (mut a, mut b) = (at(best.saturating_sub(1)), at((best + 1).min(n)));
        for _ in 0..80 {
            let (x, y) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if turn(x) <= turn(y) { b = y } else { a = x }
        }
        least = least.min(turns[best]).min(turn(0.5 * (a + b)));
    }
    least
}

/// Reliefs, crowning, slope and pitch errors of production size, kinks and corners among them: within 1e-3 um of
/// turning the wheel until it touches. The closed form is half a micrometre off here.
#[test]
fn real_depths_touch_where_turning_says() {
    let none = FlankModification::default;
    let roll = |f: f64| {
        let profile = *pair(0.0, Default::default()).pinion.profile();
        ProfilePlace::Roll(profile.roll_form() + f * (profile.roll_tip() - profile.roll_form()))
    };
    let root = |shape| Some(Relief { amount: 0.01, start: roll(0.3), shape });
    let cases = [
        (ReliefShape::Linear, 0.6, none(), 0.0),
        (ReliefShape::Parabolic, 0.6, none(), 0.0),
        (ReliefShape::Linear, 0.85, none(), 2e-3),
        (ReliefShape::Parabolic, 0.7, FlankModification { profile_crowning: 8e-3, ..none() }, 3e-3),
        (ReliefShape::Parabolic, 0.7, FlankModification { profile_slope: 6e-3, ..none() }, 3e-3),
        (ReliefShape::Linear, 0.7, FlankModification { root_relief: root(ReliefShape::Parabolic), ..none() }, 1e-3),
        // Hollow flanks touch at both ends of the profile, and which end is nearer changes along the cycle.
        (ReliefShape::Linear, 0.9, FlankModification { profile_crowning: -0.03, ..none() }, 2e-3),
        (ReliefShape::Parabolic, 0.8, FlankModification { profile_crowning: -0.05, ..none() }, 2e-3),
    ];
    for (shape, from, rest, pitch) in cases {
        let ground = |m, teeth| {
            let pitch_errors = scatter(teeth).iter().map(|e| pitch * e).collect();
            GearModifications { pitch_errors, ..GearModifications::both(m) }
        };
        let [a, b] = flanks(0.0, from, 0.02, shape, &rest);
        let pair = pair(0.0, [ground(a, 30), ground(b, 37)]);
        let options = options(&pair);
        let (mut worst, mut first) = (0.0f64, 0.0f64);
        for station in stations(32) {
            let te = kinematic_transmission_error(&pair, &options.contact, station).unwrap();
            worst = worst.max(1e3 * (te - by_turning(&pair, &options, station)).abs());
            first = first.max(1e3 * (te - closed_form(&pair, &options, station, false)).abs());
        }
        println!("{shape:?} from {from}, pitch errors {pitch} mm: off by {worst:.2e} um; closed form {first:.4} um");
        assert!(worst < 1e-3, "{shape:?} from {from}, {rest:?}, pitch errors {pitch} mm: off by {worst} um");
    }
}

/// Pitch errors without any relief: tips touch before and after their path of contact, where the closed form knows of
/// no line.
#[test]
fn corners_touch_where_turning_says() {
    let ground = |teeth| GearModifications {
        pitch_errors: scatter(teeth).iter().map(|e| 6e-3 * e).collect(),
        ..GearModifications::default()
    };
    let pair = pair(0.0, [ground(30), ground(37)]);
    let options = options(&pair);
    for i in 0..64 {
        let station = Station { cycle: i / 16, phase: (i % 16) as f64 / 16.0 };
        let te = kinematic_transmission_error(&pair, &options.contact, station).unwrap();
        let off = 1e3 * (te - by_turning(&pair, &options, station)).abs();
        assert!(off < 1e-3, "{station:?}: off by {off} um of {te} mm");
    }
}

/// Either driver, either sense: the same law, with the flanks that then carry.
#[test]
fn either_driver_and_sense() {
    let rest = FlankModification { lead_crowning: 1e-3, bias: 0.3e-3, ..FlankModification::default() };
    let [left1, left2] = flanks(12.0, 0.6, 1e-3, ReliefShape::Parabolic, &rest);
    let flat = FlankModification { lead_crowning: 0.4e-3, ..FlankModification::default() };
    let [right1, right2] = flanks(12.0, 0.7, 0.5e-3, ReliefShape::Parabolic, &flat);
    let gear = |left, right| GearModifications { left, right, ..GearModifications::default() };
    let pair = pair(12.0, [gear(left1, right1), gear(left2, right2)]);
    for driver in [Driver::Pinion, Driver::Wheel] {
        for sense in [Sense::Ccw, Sense::Cw] {
            let options = options(&pair).with_contact(|c| {
                c.driver = driver;
                c.sense = sense
            });
            let [first, _, span] = deviations(&pair, &options, 16);
            assert!(first < 1e-3, "{driver:?} {sense:?}: off by {first} um of {span} um");
        }
    }
}

/// Misalignment by itself and with crowning, spur and helical: the gap field of the tilted gears along the contact
/// lines.
#[test]
fn misaligned_flanks_touch_where_the_tilt_says() {
    for beta in [0.0, 12.0] {
        let rest = FlankModification { lead_crowning: 0.5e-3, ..FlankModification::default() };
        let flanks = flanks(beta, 0.6, 0.8e-3, ReliefShape::Parabolic, &rest);
        let pair = pair(beta, flanks.map(GearModifications::both));
        let um = 0.5e-3;
        let cases = [
            Misalignment { deviation: um, ..Misalignment::default() },
            Misalignment { inclination: -um, ..Misalignment::default() },
            Misalignment { in_plane_of_action: um, ..Misalignment::default() },
            Misalignment { across_plane_of_action: um, ..Misalignment::default() },
        ];
        for m in cases {
            let wheel = m.wheel_offset(&pair, Side::Left);
            let pinion = Offset { tilt_x: 0.3 * wheel.tilt_x, tilt_y: -0.2 * wheel.tilt_y, ..Offset::default() };
            let options = options(&pair).with_contact(|c| c.offsets = [pinion, wheel]);
            let [first, _, span] = deviations(&pair, &options, 16);
            println!("beta {beta}, {m:?}: peak to peak {span:.4} um, off by {first:.6} um");
            assert!(first < 1e-3, "beta {beta}, {m:?}: off by {first} um of {span} um");
        }
    }
}

fn largest_te(pair: &GearPair, options: &StaticOptions) -> f64 {
    let te = |s| kinematic_transmission_error(pair, &options.contact, s).unwrap().abs();
    stations(16).map(te).fold(0.0, f64::max)
}

/// Unmodified flanks on parallel axes have no transmission error, at any centre distance and wherever the gears are
/// shifted to.
#[test]
fn parallel_axes_have_no_transmission_error() {
    let plain = pair(15.0, Default::default());
    let far = GearPair::new(plain.pinion.clone(), plain.wheel.clone(), Some(plain.centre_distance() + 0.5)).unwrap();
    assert_eq!(largest_te(&far, &options(&far)), 0.0);
    // A hair of modification, so that the flanks are searched and not taken for granted.
    let hair = GearModifications::both(FlankModification { profile_crowning: 1e-12, ..FlankModification::default() });
    let pair = pair(15.0, [hair.clone(), hair]);
    for offset in [
        Offset { x: 0.3, ..Offset::default() },
        Offset { x: -0.05, y: 0.2, ..Offset::default() },
        Offset { z: 1.5, ..Offset::default() },
        Offset { x: 0.1, y: -0.1, z: -0.4, ..Offset::default() },
    ] {
        for offsets in [[Offset::default(), offset], [offset, Offset::default()]] {
            let options = options(&pair).with_contact(|c| c.offsets = offsets);
            let te = largest_te(&pair, &options);
            assert!(te < 1e-11, "{offsets:?}: {te:e} mm");
        }
    }
}

/// A spur gear shifted along its axis meets the same flanks: nothing changes as long as they are the same along the
/// face.
#[test]
fn an_axial_shift_of_a_spur_gear_changes_nothing() {
    let flanks = flanks(0.0, 0.5, 20e-3, ReliefShape::Linear, &FlankModification::default());
    let pair = pair(0.0, flanks.map(GearModifications::both));
    let shifted =
        options(&pair).with_contact(|c| c.offsets = [Offset::default(), Offset { z: 2.0, ..Offset::default() }]);
    for station in stations(16) {
        let te = |o| kinematic_transmission_error(&pair, o, station).unwrap();
        let (here, there) = (te(&options(&pair).contact), te(&shifted.contact));
        assert!((here - there).abs() < 1e-11, "{station:?}: {here} and {there}");
    }
}

/// A lead slope of either flank is undone by the misalignment in the plane of action that closes the gap as much.
#[test]
fn lead_slope_and_misalignment_cancel() {
    let slope = 10e-3;
    for gear in [0, 1] {
        let mut ground = [GearModifications::default(), GearModifications::default()];
        ground[gear] = GearModifications::both(FlankModification { lead_slope: slope, ..FlankModification::default() });
        let pair = pair(0.0, ground);
        for (driver, sense) in [(Driver::Pinion, Sense::Ccw), (Driver::Wheel, Sense::Ccw)] {
            let options = options(&pair).with_contact(|c| {
                c.driver = driver;
                c.sense = sense
            });
            let m = Misalignment { in_plane_of_action: -slope, ..Misalignment::default() };
            let offsets = [Offset::default(), m.wheel_offset(&pair, options.side())];
            // Half the slope stands above the nominal flank at one end: that end touches first.
            let alone = largest_te(&pair, &options);
            assert!((alone - 0.5 * slope).abs() < 1e-6, "gear {gear}: {alone} mm");
            let both = largest_te(&pair, &options.clone().with_contact(|c| c.offsets = offsets));
            // To first order of the tilt: its square times the radius is 13 nm.
            assert!(both < 2e-5, "gear {gear}, {driver:?}: {both:e} mm of {slope} mm are left");
        }
    }
}

/// Mirrored in the plane y = 0: the other hand, the other flanks, the other sense, z slopes as they are.
#[test]
fn the_mirror_image_has_the_same_transmission_error() {
    let rest = FlankModification { lead_slope: 4e-3, bias: 3e-3, lead_crowning: 5e-3, ..FlankModification::default() };
    let run = |beta: f64, sense: Sense, mirror: f64| {
        let flanks = flanks(beta, 0.7, 10e-3, ReliefShape::Parabolic, &rest);
        let pair = pair(beta, flanks.map(GearModifications::both));
        let wheel = Offset { x: 0.02, y: mirror * 0.03, z: 0.1, tilt_x: mirror * 2e-4, tilt_y: 1e-4 };
        let options = options(&pair).with_contact(|c| {
            c.sense = sense;
            c.offsets = [Offset::default(), wheel]
        });
        stations(16).map(|s| kinematic_transmission_error(&pair, &options.contact, s).unwrap()).collect::<Vec<_>>()
    };
    for (a, b) in run(18.0, Sense::Ccw, 1.0).into_iter().zip(run(-18.0, Sense::Cw, -1.0)) {
        assert!((a - b).abs() < 1e-10, "{a} and {b}");
    }
}

/// Offsets and tilts with which the gears do not mesh are errors with a hint.
#[test]
fn impossible_offsets_are_refused() {
    let pair = pair(10.0, Default::default());
    for offset in [
        Offset { x: -10.0, ..Offset::default() },
        Offset { x: 30.0, ..Offset::default() },
        Offset { y: f64::NAN, ..Offset::default() },
        Offset { z: 20.0, ..Offset::default() },
        Offset { tilt_x: 0.1, ..Offset::default() },
        Offset { tilt_y: f64::INFINITY, ..Offset::default() },
    ] {
        let options = options(&pair).with_contact(|c| c.offsets = [offset, Offset::default()]);
        let station = Station { cycle: 0, phase: 0.3 };
        let error = kinematic_transmission_error(&pair, &options.contact, station).unwrap_err();
        assert!(error.hint().is_some(), "{error}");
    }
}
