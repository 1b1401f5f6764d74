//! Unloaded, modified, misaligned flanks: the angle at which they just touch against the closed form in the plane of action.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use ale::Sense;
use dynamics::{Driver, Misalignment, Offset, StaticOptions, Station, kinematic_transmission_error};
use geometry::modification::{ProfilePlace, Relief, ReliefShape};
use geometry::{FlankModification, Gear, GearData, GearModifications, GearPair};

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

/// Relief of both gears' tips, mm, from 60 % of the profile on.
fn tip_relief(beta_deg: f64, gear: usize, amount: f64, shape: ReliefShape) -> Option<Relief> {
    let plain = pair(beta_deg, Default::default());
    let profile = *[&plain.pinion, &plain.wheel][gear].profile();
    let start = profile.roll_form() + 0.6 * (profile.roll_tip() - profile.roll_form());
    Some(Relief { amount, start: ProfilePlace::Roll(start), shape })
}

fn stations(count: usize) -> impl Iterator<Item = Station> {
    (0..count).map(move |i| Station { cycle: (i / 16) as i64, phase: (i % 16) as f64 / 16.0 })
}

/// TE(phi) = min over all points of the contact lines of (h_1 + h_2 - R G^2 / 2) / cos b_b, in the plane of action alone.
///
/// G is the slope of h_1 + h_2 along the profile and R the relative radius of curvature: flanks that are tilted against each other touch a
/// little beside the nominal line. That term is the only one of second order; `second_order` leaves it out or in.
fn closed_form(pair: &GearPair, options: &StaticOptions, station: Station, second_order: bool) -> f64 {
    let side = options.side();
    let sign = options.sense.sign();
    let theta = pair.middle_angle(side) + sign as f64 * (station.phase - 0.5) * pair.pinion.pitch_angle();
    let middle = -sign * station.cycle;
    let (rb1, rb2) = (pair.pinion.base_radius(), pair.wheel.base_radius());
    let cos_b = pair.base_helix_angle().cos();
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
            h1.value + h2.value - gain
        };
        let n = 4000;
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
        let te = kinematic_transmission_error(pair, options, station).unwrap();
        for (k, w) in worst.iter_mut().enumerate() {
            *w = w.max(1e3 * (te - closed_form(pair, options, station, k == 1)).abs());
        }
        (low, high) = (low.min(te), high.max(te));
    }
    [worst[0], worst[1], 1e3 * (high - low)]
}

/// Every kind of modification alone and together, on spur and helical pairs: the geometric transmission error.
#[test]
fn kinematic_te_is_the_geometric_one() {
    use ReliefShape::{Linear, Parabolic};
    let none = FlankModification::default;
    for beta in [0.0, 12.0, -20.0] {
        // Tips are relieved by more than the other modifications bring forward, so that no pair touches beyond its path.
        let relieved =
            |gear: usize, shape| FlankModification { tip_relief: tip_relief(beta, gear, 0.03, shape), ..none() };
        let relieved = |shape| [0, 1].map(|g| relieved(g, shape));
        let with = |m: fn(&mut FlankModification), shape| {
            let mut flanks = relieved(shape);
            flanks.iter_mut().for_each(m);
            flanks
        };
        let cases: Vec<(&str, [FlankModification; 2])> = vec![
            ("linear tip relief", relieved(Linear)),
            ("parabolic tip relief", relieved(Parabolic)),
            ("profile crowning", with(|m| m.profile_crowning = 0.004, Parabolic)),
            ("profile slope", with(|m| m.profile_slope = 0.003, Parabolic)),
            ("lead crowning", with(|m| m.lead_crowning = 0.01, Parabolic)),
            ("lead slope", with(|m| m.lead_slope = 0.006, Parabolic)),
            ("bias", with(|m| m.bias = 0.004, Parabolic)),
        ];
        for (name, flanks) in cases {
            let pair = pair(beta, flanks.map(GearModifications::both));
            let [first, second, span] = deviations(&pair, &options(&pair), 16);
            println!("beta {beta}: {name}: pp {span:.3} um, off by {first:.5} (first order), {second:.6} um");
        }
    }
}
