//! The closed form of a line contact's approach against contacts with the band resolved.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]
//!
//! Source: the plane-strain models of `plane.rs` and `half_section.rs`, 2026, quad8 of a sixteenth of the
//! half-width. Nothing in the closed form was fitted to them.

use crate::half_section::HalfSection;
use crate::plane::{Lattice, even, graded, press, under_hertz};
use crate::plane_gear::{Place, PlaneGear};
use contact::{
    line::hertz,
    local::{EndFace, LocalBody, LocalContact, layer_constant},
};
use geometry::{Gear, GearData};
use reduction::LayerProfile;

const STEEL: (f64, f64) = (2.06e5, 0.3);

fn spur(teeth: u32, shift: f64, alpha_deg: f64) -> Gear {
    Gear::new(GearData {
        teeth,
        profile_shift: shift,
        normal_pressure_angle: alpha_deg.to_radians(),
        helix_angle: 0.0,
        root_radius_coefficient: 0.3,
        bore_diameter: 10.0,
        ..GearData::default()
    })
    .unwrap_or_else(|e| panic!("z {teeth}, x {shift}: {e}"))
}

/// The closed form's view of a place `x` mm from the tip of a spur gear; no end faces.
fn body(gear: &Gear, profile: &LayerProfile, (young, poisson): (f64, f64), x: f64, edge_radius: f64) -> LocalBody {
    let (tip, base) = (gear.profile().roll_tip(), gear.base_radius());
    let at = x.max(0.0);
    let roll = (tip * tip - 2.0 * at / base).sqrt();
    LocalBody {
        young,
        poisson,
        layer: profile.constant(roll),
        depth: gear.profile().radius(roll) * gear.profile().half_angle(roll).sin(),
        tip_distance: at,
        tip_angle: profile.tip_angle(),
        tip_gradient: profile.tip_gradient(),
        edge_radius,
        ends: [EndFace::FAR; 2],
    }
}

/// K q of one body.
fn softness((young, poisson): (f64, f64)) -> f64 {
    2.0 * (1.0 - poisson * poisson) / (std::f64::consts::PI * young)
}

/// Two cylinders, each the top of a layer bonded to rigid ground.
#[test]
fn cylinders_on_layers() {
    let (radius, q) = (6.0, 200.0);
    let bodies = [(STEEL, 2.0), ((1.1e5, 0.25), 1.4)];
    let modulus = hertz::effective_modulus(bodies.map(|b| b.0));
    let (p0, a) = (hertz::line_pressure(q, radius, modulus), hertz::half_width(q, radius, modulus));
    for (count, tolerance) in [(4.0, 0.02), (16.0, 0.01)] {
        let h = a / count;
        let x = even(-1.5 * a, 1.5 * a, h);
        let mut sum = faer::Mat::zeros(x.len(), x.len());
        for ((young, poisson), depth) in bodies {
            let along = graded(-8.0 * depth, &x, 8.0 * depth, 1.2, 0.3 * depth);
            let down = graded(0.0, &[0.0, 0.5 * h, h], depth, 1.2, 0.15 * depth);
            let lattice = Lattice {
                rows: along.len() - 1,
                columns: down.len() - 1,
                point: &|r, c| [along[r], -down[c]],
                clamped: &|_, c| c == down.len() - 1,
                young,
                poisson,
            };
            let first = along.iter().position(|s| *s >= x[0] - 1e-12).unwrap();
            sum += lattice.compliance(first, first + x.len() - 1, &vec![[0.0, -1.0]; x.len()]);
        }
        let band = press(&x, &sum, |x| x * x / (2.0 * radius), q);
        let pressure = band.pressure.iter().copied().fold(0.0, f64::max);
        let second: f64 = x.iter().zip(&band.pressure).zip(&band.weights).map(|((x, p), w)| p * w * x * x).sum();
        let width = 2.0 * (second / q).sqrt();
        let local = LocalContact {
            bodies: bodies.map(|((young, poisson), depth)| LocalBody {
                young,
                poisson,
                layer: layer_constant(poisson),
                depth,
                tip_distance: f64::INFINITY,
                tip_angle: std::f64::consts::PI,
                tip_gradient: 0.0,
                edge_radius: 0.0,
                ends: [EndFace::FAR; 2],
            }),
            radius,
            off_line: 0.0,
            deviation: None,
        };
        let state = local.under(q);
        let off = [pressure / p0, width / a, band.approach / state.approach].map(|x| 100.0 * (x - 1.0));
        println!(
            "{count} elements a half-width: p0 {pressure:.2} MPa ({:+.3} %), a {width:.5} mm ({:+.3} %), approach {:.4} um ({:+.3} %)",
            off[0],
            off[1],
            1e3 * band.approach,
            off[2]
        );
        assert!(off.iter().all(|x| x.abs() < 100.0 * tolerance), "{off:?} %");
        assert!((state.pressure - p0).abs() < 1e-9 * p0 && (state.half_width - a).abs() < 1e-12);
    }
}

/// A Hertzian band on one half tooth: bracket of the closed form against the resolved one, over shapes and places.
#[test]
fn half_teeth_under_hertzian_bands() {
    let mut worst = 0.0f64;
    println!(
        " z    x  alpha   nu | error of the bracket at 0.15, 0.3, 0.5, 0.75, 0.95 of the flank from the tip (bracket)"
    );
    for (teeth, shift, alpha, nu) in [
        (13, 0.4, 20.0, 0.3),
        (13, 0.0, 25.0, 0.3),
        (30, 0.0, 20.0, 0.3),
        (30, 0.4, 20.0, 0.3),
        (30, -0.4, 20.0, 0.3),
        (30, 0.0, 25.0, 0.3),
        (100, 0.0, 20.0, 0.3),
        (100, 0.4, 20.0, 0.3),
        (30, 0.0, 20.0, 0.25),
        (30, 0.0, 20.0, 0.45),
    ] {
        let gear = spur(teeth, shift, alpha);
        let profile = LayerProfile::new(&gear, nu, 0.0).unwrap();
        let material = (2.06e5, nu);
        let section = HalfSection { gear: &gear, young: 2.06e5, poisson: nu, edge_radius: 0.0 };
        let (tip, form) = (gear.profile().roll_tip(), gear.profile().roll_form());
        let length = 0.5 * gear.base_radius() * (tip * tip - form * form);
        let a = 0.03 * gear.data().normal_module;
        print!("{teeth:>3} {shift:>5} {alpha:>4} {nu:>5} |");
        for part in [0.15, 0.3, 0.5, 0.75, 0.95] {
            let at = part * length;
            let resolved = section.resolve(&even(at - 1.25 * a, at + 1.25 * a, a / 16.0));
            let x: Vec<f64> = resolved.x.iter().map(|x| x - at).collect();
            let dent = under_hertz(&x, &resolved.compliance, a, 1.0) / softness(material);
            let local = body(&gear, &profile, material, at, 0.0);
            let eta = contact::local::wedge_softening(local.tip_angle);
            let closed =
                (2.0 * local.depth / a).ln() + 0.5 + local.layer + eta * (local.depth / local.tip_distance).ln();
            print!(" {:+.4} ({dent:.3})", closed - dent);
            worst = worst.max((closed / dent - 1.0).abs());
        }
        println!();
    }
    println!("largest error {:.2} % of the local approach", 100.0 * worst);
    assert!(worst < 0.01, "{worst}");
}

/// A tip edge on the mate's flank, band resolved on both half teeth: on the flank, cut off by the edge, off the line of
/// action.
struct EdgeCase<'a> {
    tip: &'a Gear,
    mate: &'a Gear,
    materials: [(f64, f64); 2],
    edge_radius: f64,
    radius: f64,
    q: f64,
}

impl EdgeCase<'_> {
    /// Place of the mate's flank that the edge touches, mm from the mate's tip.
    fn mate_at(&self) -> f64 {
        let (tip, form) = (self.mate.profile().roll_tip(), self.mate.profile().roll_form());
        0.7 * 0.5 * self.mate.base_radius() * (tip * tip - form * form)
    }

    fn half_width(&self) -> f64 {
        hertz::half_width(self.q, self.radius, hertz::effective_modulus(self.materials))
    }

    /// Approach by the closed form and by the resolved contact, mm, from the touching of the edge as it is.
    fn compare(&self, distance: f64) -> (f64, f64) {
        let profiles = [(self.tip, self.materials[0]), (self.mate, self.materials[1])]
            .map(|(gear, m)| LayerProfile::new(gear, m.1, 0.0).unwrap());
        let local = LocalContact {
            bodies: [
                body(self.tip, &profiles[0], self.materials[0], distance, self.edge_radius),
                body(self.mate, &profiles[1], self.materials[1], self.mate_at(), 0.0),
            ],
            radius: self.radius,
            off_line: (-distance).max(0.0),
            deviation: None,
        };
        (local.under(self.q).approach, self.resolved(distance))
    }

    fn resolved(&self, distance: f64) -> f64 {
        let a = self.half_width();
        let section = HalfSection {
            gear: self.tip,
            young: self.materials[0].0,
            poisson: self.materials[0].1,
            edge_radius: self.edge_radius,
        };
        let start = section.flank_start();
        let d = (distance - start) / a;
        let width = if d < 1.0 { 2.0 / ((d * d + 3.0).sqrt() - d) } else { 2.0 };
        let h = a * (1.0f64 / 16.0).min(width / 24.0).min(if self.edge_radius > 0.0 { 0.02 } else { 1.0 });
        let (low, high) =
            if d < 1.35 { (start, start + 1.5 * width * a) } else { (distance - 1.3 * a, distance + 1.3 * a) };
        let tip = section.resolve(&even(low, high, h));
        let touching = distance.max(0.0);
        // Towards the tip of one tooth is towards the foot of the other.
        let seen: Vec<f64> = tip.x.iter().rev().map(|x| self.mate_at() - (x - touching)).collect();
        let mate =
            HalfSection { gear: self.mate, young: self.materials[1].0, poisson: self.materials[1].1, edge_radius: 0.0 }
                .resolve(&seen);
        let n = tip.x.len();
        let sum = faer::Mat::from_fn(n, n, |i, j| tip.compliance[(i, j)] + mate.compliance[(n - 1 - i, n - 1 - j)]);
        let gap = |x: f64| {
            let flank = (x - distance).powi(2) / (2.0 * self.radius);
            let past = (start - x).max(0.0);
            let r = self.edge_radius;
            if past > 0.0 { flank + r - (r * r - past * past).max(0.0).sqrt() } else { flank }
        };
        let band = press(&tip.x, &sum, gap, self.q);
        let least = tip.x.iter().map(|&x| gap(x)).fold(f64::INFINITY, f64::min);
        band.approach - least
    }
}

const PLACES: [f64; 13] = [-8.0, -4.0, -2.0, -1.0, -0.5, 0.0, 0.3, 0.6, 0.9, 1.2, 2.0, 4.0, 8.0];

/// Teeth of tip and mate, their materials, edge radius (mm), line load (N/mm).
type EdgeData = ([usize; 2], [(f64, f64); 2], f64, f64);

const SOFT: (f64, f64) = (5.0e4, 0.35);
const SHARP: [EdgeData; 6] = [
    ([0, 0], [STEEL, STEEL], 0.0, 200.0),
    ([0, 0], [STEEL, STEEL], 0.0, 20.0),
    ([1, 2], [STEEL, STEEL], 0.0, 200.0),
    ([2, 1], [STEEL, STEEL], 0.0, 200.0),
    ([0, 0], [SOFT, STEEL], 0.0, 100.0),
    ([0, 0], [STEEL, SOFT], 0.0, 100.0),
];
const ROUNDED: [EdgeData; 5] = [
    ([0, 0], [STEEL, STEEL], 0.02, 200.0),
    ([0, 0], [STEEL, STEEL], 0.1, 200.0),
    ([0, 0], [STEEL, STEEL], 0.1, 20.0),
    ([0, 0], [STEEL, STEEL], 0.3, 200.0),
    ([2, 1], [STEEL, STEEL], 0.1, 200.0),
];

/// Largest error of the approach over the cases, all of `places` (d/a from the end of the flank).
fn worst_at_edges(cases: &[EdgeData], places: &[f64]) -> f64 {
    let gears = [spur(30, 0.0, 20.0), spur(13, 0.4, 20.0), spur(100, 0.0, 20.0)];
    println!("approach by the closed form against the resolved one, %, at d/a = {places:?} from the end of the flank");
    let mut worst = 0.0f64;
    for &([tip, mate], materials, edge_radius, q) in cases {
        let case = EdgeCase { tip: &gears[tip], mate: &gears[mate], materials, edge_radius, radius: 5.0, q };
        let a = case.half_width();
        let section = HalfSection { gear: case.tip, young: 1.0, poisson: 0.3, edge_radius };
        print!(
            "z {:>3} on {:>3}, E {:.0e} on {:.0e}, r {edge_radius}, q {q}, a {a:.4}:",
            case.tip.teeth(),
            case.mate.teeth(),
            materials[0].0,
            materials[1].0
        );
        for d in places {
            let (closed, resolved) = case.compare(section.flank_start() + d * a);
            let off = closed / resolved - 1.0;
            print!(" {:+.2}", 100.0 * off);
            worst = worst.max(off.abs());
        }
        println!();
    }
    println!("largest error {:.2} %", 100.0 * worst);
    worst
}

#[test]
fn sharp_tip_edges() {
    let worst = worst_at_edges(&SHARP[..1], &PLACES);
    let worst = worst.max(worst_at_edges(&SHARP[2..5], &[-2.0, 0.0, 0.9]));
    assert!(worst < 0.0125, "{worst}");
}

#[test]
fn rounded_tip_edges() {
    let worst = worst_at_edges(&ROUNDED[1..testing::cases(3, 4)], &[-4.0, -1.0, 0.0, 1.2]);
    assert!(worst < 0.025, "{worst}");
}

/// The whole table: two minutes.
#[test]
#[ignore = "a table, not a law"]
fn tip_edge_table() {
    let worst = [worst_at_edges(&SHARP, &PLACES), worst_at_edges(&ROUNDED, &PLACES)];
    assert!(worst[0] < 0.0125 && worst[1] < 0.025, "{worst:?}");
}

/// Slice formula on a coarse plane-strain sector: STE (mm) of pairs at `rolls` on both gears under F' (N/mm).
fn slice_ste(bulk: &[faer::Mat<f64>], local: &[LocalContact], load: f64) -> f64 {
    let n = local.len();
    let (mut q, mut ste) = (vec![load / n as f64; n], 0.0);
    for _ in 0..40 {
        let states: Vec<_> = local.iter().zip(&q).map(|(l, &q)| l.under(q)).collect();
        let system = faer::Mat::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
            (true, true) => bulk.iter().map(|b| b[(i, j)]).sum::<f64>() + if i == j { states[i].slope } else { 0.0 },
            (false, false) => 0.0,
            _ => -1.0,
        });
        let rhs = faer::Mat::from_fn(
            n + 1,
            1,
            |i, _| {
                if i < n { states[i].slope * q[i] - states[i].approach } else { -load }
            },
        );
        use faer::linalg::solvers::Solve;
        let answer = system.partial_piv_lu().solve(&rhs);
        (0..n).for_each(|i| q[i] = answer[(i, 0)]);
        ste = answer[(n, 0)];
    }
    ste
}

/// STE of the default tooth as a spur pair, sectors of 5 teeth, cuts free, bore held, against values with the band
/// resolved on the whole sector (independent code, elements of a sixteenth of the half-width; given with the
/// finite-element reference of the default pair).
#[test]
fn plane_strain_sector() {
    let data = GearData { helix_angle: 0.0, face_width: 1.0, ..GearData::default() };
    let gear = Gear::new(data).unwrap();
    let material = fem::Material::new(STEEL.0, STEEL.1, 7.85e-9).unwrap();
    let profile = LayerProfile::new(&gear, STEEL.1, 0.0).unwrap();
    let base = gear.base_radius();
    let pitch_roll = gear.transverse_pressure_angle().tan();
    let (tip, pitch) = (gear.profile().roll_tip(), gear.pitch_angle());
    let half_path = tip - pitch_roll;
    let reference = [
        ("pitch point", vec![0.0], [3.481, 6.767, 13.145]),
        ("90 % of the path", vec![0.8 * half_path], [4.272, 8.348, 16.301]),
        ("99 % of the path", vec![0.98 * half_path], [4.834, 9.470, 18.548]),
        ("two pairs", vec![-0.5 * pitch, 0.5 * pitch], [2.320, 4.542, 8.887]),
    ];
    let mut worst = Vec::new();
    for counts in [[4, 2, 4, 3], [6, 2, 4, 3], [8, 4, 6, 4], [16, 6, 8, 6], [32, 12, 16, 10]] {
        let bulk = PlaneGear::new(&gear, &material, counts);
        let mut largest = [0.0f64; 2];
        for (name, places, values) in &reference {
            let rolls: Vec<[f64; 2]> = places.iter().map(|p| [pitch_roll + p, pitch_roll - p]).collect();
            let of_gear = |which: usize| {
                let sign = if which == 0 { 1 } else { -1 };
                let teeth: Vec<Place> =
                    rolls.iter().enumerate().map(|(k, r)| Place { tooth: sign * k as i64, roll: r[which] }).collect();
                let mut w = bulk.whole(&teeth);
                teeth.iter().enumerate().for_each(|(i, &t)| w[(i, i)] -= bulk.half_tooth(t));
                w
            };
            let local: Vec<LocalContact> = rolls
                .iter()
                .map(|r| LocalContact {
                    bodies: r.map(|u| body(&gear, &profile, STEEL, 0.5 * base * (tip * tip - u * u), 0.0)),
                    radius: base * r[0] * r[1] / (r[0] + r[1]),
                    off_line: 0.0,
                    deviation: None,
                })
                .collect();
            let bulk = [of_gear(0), of_gear(1)];
            print!("{counts:?} {name:>17}:");
            for (load, value) in [50.0, 100.0, 200.0].into_iter().zip(values) {
                let ste = 1e3 * slice_ste(&bulk, &local, load);
                let off = ste / value - 1.0;
                print!(" {ste:.3} ({value}, {:+.2} %)", 100.0 * off);
                let pairs = places.len() - 1;
                largest[pairs] = largest[pairs].max(off.abs());
            }
            println!();
        }
        worst.push(largest);
    }
    println!("largest error by mesh, one pair and two: {worst:.4?}");
    // One pair: 0.3 % (at 99 % of the path under the highest load, half a half-width from the edge), elsewhere 0.06 %.
    assert!(worst[4][0] < 0.004, "{worst:?}");
    assert!(worst[1][0] < 0.01 && worst[2][0] < 0.005, "{worst:?}");
    // Where the two pairs stood is not given: 0.4 % low here, 0.1 % high with one of them at 90 % of the path.
    assert!(worst[4][1] < 0.005, "{worst:?}");
}
