//! Waves, noise and flanks by tooth: what a band of contact sees of them. Theory (26a).
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::{FRAC_PI_2, PI};

use ale::Station;
use contact::{Method, SliceResult};
use geometry::{Gear, GearData, GearPair};
use ltca::{StaticModel, StaticOptions, StaticPosition, kinematic_transmission_error};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use testing::{
    Case, default_data, generated,
    waves::{Wave, grid, lines, with_flanks},
};

const SMALL: [u32; 5] = [2, 2, 2, 4, 1];

fn with_pinion(pair: &GearPair, pinion: Gear) -> GearPair {
    GearPair::new(pinion, pair.wheel.clone(), None).unwrap()
}

/// J_0 by its integral.
fn bessel(x: f64) -> f64 {
    let n = 200;
    (0..n).map(|j| (x * (PI * (f64::from(j) + 0.5) / f64::from(n)).cos()).cos()).sum::<f64>() / f64::from(n)
}

/// Without load a wave of any order, on flanks of their own for every tooth, is the transmission error
/// A/cos b_b cos(O theta + phi), to first order (flanks touch where their smooth parts do, which adds (k A)^2 R/2 of long
/// waves): also orders that are no multiple of the teeth, and also where two pairs share a line.
#[test]
fn rigid_flanks_transmit_a_wave_of_any_order() {
    for beta in [0.0, 20.0] {
        let data = default_data(beta);
        let pair =
            GearPair::new(Gear::new(data[0].clone()).unwrap(), Gear::new(data[1].clone()).unwrap(), None).unwrap();
        let options = StaticOptions::new(0.0, &pair);
        let side = options.side();
        for (i, order) in [7.0, 30.0, 61.0, 90.0, 150.0, 333.0].into_iter().enumerate() {
            let wave = Wave { order, amplitude: 2e-6, phase: 0.4 + 1.1 * i as f64 };
            let depth = |tooth: i64, at: [f64; 2]| wave.depth(&pair.pinion, side, tooth, at);
            let waved = with_flanks(&pair.pinion, side, -3..4, lines(&pair.pinion, order, 6.0), depth);
            let waved = with_pinion(&pair, waved);
            let mut worst = 0.0f64;
            for (cycle, phase) in [(0, 0.13), (0, 0.5), (0, 0.92), (1, 0.31), (1, 0.77), (-1, 0.4)] {
                let station = Station { cycle, phase };
                let te = kinematic_transmission_error(&waved, &options.contact, station).unwrap();
                let theta = station.pinion_angle(&pair, side, options.contact.sense);
                let u = pair.path_coordinate(side, theta, 0, 0.0) / pair.pinion.base_radius();
                let running = station.middle_pair(options.contact.sense);
                let wanted = depth(running, [u, 0.0]) / pair.base_helix_angle().cos();
                worst = worst.max(1e3 * (te - wanted).abs());
            }
            println!("beta {beta}, order {order}: off by {worst:.1e} um of {:.1e}", 1e3 * wave.amplitude);
            assert!(worst < 1e-6, "beta {beta}, order {order}: off by {worst:.2e} um");
        }
    }
}

/// The gear pair and the reduced model of it.
struct Loaded {
    case: Case,
    base: StaticModel,
}

impl Loaded {
    fn new(beta: f64, slices: usize) -> Self {
        let case = generated(beta, SMALL);
        let options = case.slice_options().with_contact(|c| c.slices = slices);
        let base = StaticModel::new(case.pair.clone(), case.reduced_gears(&options), options).unwrap();
        Self { case, base }
    }

    fn solve(&self, pair: GearPair, torque: f64, station: Station) -> StaticPosition {
        let options = StaticOptions { torque, ..self.base.options().clone() };
        self.base.modified(pair, options).unwrap().solve(station).unwrap()
    }

    /// With depths (mm) on the pinion's loaded flanks, the same on every tooth.
    fn with(&self, counts: [usize; 2], depth: impl Fn([f64; 2]) -> f64) -> GearPair {
        let side = self.base.options().side();
        with_pinion(&self.case.pair, with_flanks(&self.case.pair.pinion, side, [0], counts, |_, at| depth(at)))
    }
}

fn slices(position: &StaticPosition) -> Vec<SliceResult> {
    position.pairs.iter().flat_map(|pair| pair.slices.iter().copied()).collect()
}

/// First-order amplitude of the loaded transmission error of a wave in roll angle, over A: by two phases.
fn amplitude(loaded: &Loaded, order: f64, torque: f64, station: Station, depth: f64) -> f64 {
    let pinion = &loaded.case.pair.pinion;
    let te = |phase: f64, sign: f64| {
        let pair = loaded.with([lines(pinion, order, 5.0)[0], 3], |[u, _]| sign * depth * (order * u + phase).cos());
        loaded.solve(pair, torque, station).transmission_error
    };
    let of = |phase: f64| (te(phase, 1.0) - te(phase, -1.0)) / (2.0 * depth);
    of(0.0).hypot(of(FRAC_PI_2))
}

/// Spur pair in single contact: a wave counts with J_0(k a), from bands that it hardly crosses to several waves in a band.
#[test]
fn a_loaded_wave_counts_with_bessels_function() {
    let loaded = Loaded::new(0.0, 20);
    let station = Station { cycle: 0, phase: 0.5 };
    let mut seen = 0.0f64;
    for order in [60.0, 150.0, 300.0] {
        for torque in [2e3, 20e3, 80e3, 150e3, 300e3, 600e3] {
            let smooth = slices(&loaded.solve(loaded.case.pair.clone(), torque, station));
            let base = loaded.case.pair.pinion.base_radius();
            let total: f64 = smooth.iter().map(|s| s.line_load).sum();
            let share = |s: &SliceResult| {
                let ka = order / (base * s.roll[0]) * s.half_width;
                (s.line_load / total * ka, s.line_load / total * bessel(ka))
            };
            let (ka, wanted) = smooth.iter().map(share).fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
            let found = amplitude(&loaded, order, torque, station, 0.05e-3);
            println!("order {order}, {} N m: k a {ka:.3}, {found:.4} A, J_0 {wanted:.4}", 1e-3 * torque);
            assert!((found - wanted.abs()).abs() < 0.02, "order {order}, {torque} N mm: {found}, not {wanted}");
            seen = seen.max(ka);
        }
    }
    assert!(seen > 3.9, "k a up to {seen} was tried");
}

/// A cylinder pressed on a half-plane with a wave: the law itself, by boundary elements.
///
/// Pressure is constant on elements; displacements are those of a strip on a half-plane. The change of the approach by a
/// small wave over A against J_0(k a) cos phi.
#[test]
fn the_half_plane_agrees_with_the_mean_over_the_band() {
    let count = 400usize;
    let width = 2.6 / count as f64;
    let x = |i: usize| (i as f64 + 0.5) * width - 1.3;
    // Displacement of a strip's middle under the pressure of another one: -2/(pi E*) int ln|x - s| ds, with 2/(pi E*) = 1.
    let strip = |d: f64| {
        let part = |y: f64| if y == 0.0 { 0.0 } else { y * y.abs().ln() - y };
        -(part(d + 0.5 * width) - part(d - 0.5 * width))
    };
    let kernel: Vec<f64> = (0..count).map(|i| strip(i as f64 * width)).collect();
    // Hertz: a = 1 with R = 1/(2 q) where a^2 = 4 q R/(pi E*) = 2 q R.
    let (load, curvature) = (1.0, 2.0);
    let approach = |wave: &dyn Fn(f64) -> f64| {
        let mut active: Vec<usize> = (0..count).filter(|&i| x(i).abs() <= 1.0).collect();
        for _ in 0..60 {
            let n = active.len();
            let mut a = faer::Mat::<f64>::zeros(n + 1, n + 1);
            let mut b = faer::Mat::<f64>::zeros(n + 1, 1);
            for (i, &p) in active.iter().enumerate() {
                for (j, &q) in active.iter().enumerate() {
                    a[(i, j)] = kernel[p.abs_diff(q)];
                }
                (a[(i, n)], a[(n, i)]) = (-1.0, width);
                b[(i, 0)] = -0.5 * curvature * x(p).powi(2) - wave(x(p));
            }
            b[(n, 0)] = load;
            use faer::linalg::solvers::Solve;
            let s = a.partial_piv_lu().solve(&b);
            let kept: Vec<usize> =
                active.iter().enumerate().filter(|(i, _)| s[(*i, 0)] > 0.0).map(|(_, &p)| p).collect();
            let gap = |p: usize| {
                let moved: f64 = active.iter().enumerate().map(|(j, &q)| kernel[p.abs_diff(q)] * s[(j, 0)]).sum();
                moved + 0.5 * curvature * x(p).powi(2) + wave(x(p)) - s[(n, 0)]
            };
            let mut next: Vec<usize> =
                (0..count).filter(|&p| if active.contains(&p) { kept.contains(&p) } else { gap(p) < 0.0 }).collect();
            next.sort_unstable();
            if next == active {
                return s[(n, 0)];
            }
            active = next;
        }
        panic!("no contact set");
    };
    let depth = 1e-3;
    for ka in [0.5, 1.0, 2.0, 2.4, 3.2, 4.0] {
        let with = |sign: f64| approach(&|x: f64| sign * depth * (ka * x).cos());
        let found = (with(1.0) - with(-1.0)) / (2.0 * depth);
        println!("k a {ka}: {found:.4}, J_0 {:.4}", bessel(ka));
        assert!((found - bessel(ka)).abs() < 5e-3, "k a {ka}: {found}, not {}", bessel(ka));
    }
}

/// Helical pair: a wave of the profile that is the same at all heights counts by the sum over the rows, each with the
/// share of an added load that it takes (Betti) and with J_0 of its own band.
#[test]
fn a_wave_on_a_helical_pair_is_the_sum_of_its_rows() {
    let loaded = Loaded::new(20.0, 24);
    let pair = &loaded.case.pair;
    let (base, cos_b) = (pair.pinion.base_radius(), pair.base_helix_angle().cos());
    for (order, torque, phase) in [(90.0, 150e3, 0.2), (150.0, 150e3, 0.6), (150.0, 600e3, 0.4)] {
        let station = Station { cycle: 0, phase };
        let at = |torque: f64| loaded.solve(pair.clone(), torque, station);
        let [less, own, more] = [0.99, 1.0, 1.01].map(|part| slices(&at(part * torque)));
        assert_eq!((less.len(), more.len()), (own.len(), own.len()));
        let added: Vec<f64> = more.iter().zip(&less).map(|(a, b)| a.line_load - b.line_load).collect();
        let total: f64 = added.iter().sum();
        let sum = |turn: f64| -> f64 {
            let row = |(s, add): (&SliceResult, &f64)| {
                let ka = order / (base * s.roll[0]) * s.half_width;
                add / total * bessel(ka) * (order * s.roll[0] + turn).cos()
            };
            own.iter().zip(&added).map(row).sum::<f64>() / cos_b
        };
        let wanted = sum(0.0).hypot(sum(FRAC_PI_2));
        let rows = own
            .iter()
            .zip(&added)
            .map(|(s, add)| add / total * bessel(order / (base * s.roll[0]) * s.half_width).abs());
        let whole = rows.sum::<f64>() / cos_b;
        let found = amplitude(&loaded, order, torque, station, 0.02e-3);
        println!("order {order}, {} N m: {found:.4} A, rows {wanted:.4} of {whole:.4}", 1e-3 * torque);
        assert!(
            (found - wanted).abs() < 0.03 * whole.max(wanted),
            "order {order}, {torque} N mm: {found}, not {wanted}"
        );
    }
}

/// White noise of 0.3 um on a grid of 0.05 mm, as measured flanks have it, changes neither the mean transmission error nor
/// curvatures nor the largest pressure by what a user would see.
#[test]
fn noise_of_a_measurement_changes_little() {
    let loaded = Loaded::new(20.0, 32);
    let pinion = &loaded.case.pair.pinion;
    let profile = pinion.profile();
    let arc = 0.5 * pinion.base_radius() * (profile.roll_tip().powi(2) - profile.roll_form().powi(2));
    let counts = [arc, pinion.face_width()].map(|length| (length / 0.05) as usize + 1);
    let (mut mean, mut pressure, mut curved) = ([0.0f64; 2], [0.0f64; 2], 0.0f64);
    let stations: Vec<Station> = (0..8).map(|i| Station { cycle: 0, phase: (f64::from(i) + 0.5) / 8.0 }).collect();
    for seed in 0..3 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || (0..12).map(|_| rng.random_range(-0.5..0.5)).sum::<f64>();
        let values: Vec<f64> = (0..counts[0] * counts[1]).map(|_| 0.3e-3 * normal()).collect();
        let next = std::cell::Cell::new(0);
        let rough = loaded.with(counts, |_| values[next.replace((next.get() + 1) % values.len())]);
        let both = [loaded.case.pair.clone(), rough.clone()];
        let of = |pair: &GearPair| -> Vec<StaticPosition> {
            stations.iter().map(|s| loaded.solve(pair.clone(), 150e3, *s)).collect()
        };
        let both = both.each_ref().map(of);
        let te = |all: &[StaticPosition]| all.iter().map(|p| p.transmission_error).sum::<f64>() / all.len() as f64;
        let most = |all: &[StaticPosition]| all.iter().map(|p| p.max_pressure).fold(0.0, f64::max);
        let [a, b] = both.each_ref().map(|all| te(all));
        mean[0] = mean[0].max(1e3 * (b - a).abs());
        let [p, q] = both.each_ref().map(|all| most(all));
        pressure[0] = pressure[0].max((q / p - 1.0).abs());
        // Curvature of the surface that contact is searched on, over the relative one at the pitch point.
        use contact::flank::Surface;
        let side = loaded.base.options().side();
        let flank = rough.pinion.modified_flank(side, 0).split(loaded.case.pair.face_width() / 32.0);
        let relative = 2.0 / (pinion.base_radius() * loaded.case.pair.working_pressure_angle().tan());
        for i in 0..40 {
            for j in 0..40 {
                let u = profile.roll_form() + (profile.roll_tip() - profile.roll_form()) * (f64::from(i) + 0.5) / 40.0;
                let z = pinion.face_width() * ((f64::from(j) + 0.5) / 40.0 - 0.5);
                let nominal = flank.nominal().curvatures(u)[0];
                curved = curved.max((Surface::curvature(&flank, [u, z]) - nominal).abs() / relative);
            }
        }
        (mean[1], pressure[1]) = (1e3 * a, p);
    }
    println!(
        "mean TE moves by {:.4} of {:.2} um, largest pressure by {:.2} % of {:.0} MPa, curvature by {:.2} %",
        mean[0],
        mean[1],
        100.0 * pressure[0],
        pressure[1],
        100.0 * curved
    );
    assert!(mean[0] < 0.05, "mean transmission error moves by {} um", mean[0]);
    assert!(curved < 0.01, "a curvature changes by {curved}");
    assert!(pressure[0] < 0.03, "the largest pressure changes by {}", pressure[0]);
}

/// Random micro-geometry and measured flanks at four other sizes: the same dimensionless answers.
#[test]
fn modified_pairs_of_any_size_have_the_same_answer() {
    let sizes = [0.1, 0.2, 2.5, 10.0];
    let mut worst = 0.0f64;
    for seed in 0..testing::cases(6, 20) as u64 {
        let of = |size: f64| random_pair(seed, size);
        let one = of(1.0);
        for size in sizes {
            let other = of(size);
            for (a, b) in one.iter().zip(&other) {
                let pairs = [
                    (a.transmission_error, b.transmission_error / size, a.transmission_error),
                    (a.kinematic_transmission_error, b.kinematic_transmission_error / size, a.transmission_error),
                    (a.max_pressure, b.max_pressure, a.max_pressure),
                    (a.contact_line_length, b.contact_line_length / size, a.contact_line_length),
                    (a.tangent_stiffness, b.tangent_stiffness / size, a.tangent_stiffness),
                    (a.wrench[0].force[2], b.wrench[0].force[2] / size.powi(2), a.wrench[0].force[0]),
                ];
                for (k, (a, b, scale)) in pairs.into_iter().enumerate() {
                    let off = ((a - b) / scale).abs();
                    worst = worst.max(off);
                    assert!(off < 1e-9, "seed {seed}, size {size}, quantity {k}: {a} and {b}");
                }
            }
        }
    }
    println!("largest relative difference {worst:.1e}");
}

fn random_pair(seed: u64, size: f64) -> Vec<StaticPosition> {
    use geometry::{
        FlankModification, GearModifications,
        modification::{ProfilePlace, Relief, ReliefShape},
    };
    let mut rng = ChaCha8Rng::seed_from_u64(1000 + seed);
    let beta: f64 = if rng.random_bool(0.3) { 0.0 } else { rng.random_range(-25.0..25.0) };
    let data = default_data(beta).map(|d| GearData {
        normal_module: size * d.normal_module,
        face_width: size * d.face_width,
        bore_diameter: size * d.bore_diameter,
        thickness_allowance: size * d.thickness_allowance,
        ..d
    });
    let case = testing::of_order(
        1,
        data,
        None,
        1e3 * rng.random_range(40.0..400.0f64) * size.powi(3),
        SMALL,
        mesh::Extent::Periodic,
    );
    let modified = [&case.pair.pinion, &case.pair.wheel].map(|gear| {
        let mut um = |low: f64, high: f64| 1e-3 * size * rng.random_range(low..high);
        let mut flank = FlankModification {
            profile_crowning: um(0.0, 6.0),
            lead_crowning: um(0.0, 8.0),
            lead_slope: um(-5.0, 5.0),
            bias: um(-4.0, 4.0),
            ..FlankModification::default()
        };
        let amount = um(0.0, 25.0);
        let profile = gear.profile();
        let from = rng.random_range(0.5..0.9);
        let start = ProfilePlace::Roll(profile.roll_form() + from * (profile.roll_tip() - profile.roll_form()));
        let shape = if rng.random_bool(0.5) { ReliefShape::Linear } else { ReliefShape::Parabolic };
        flank.tip_relief = Some(Relief { amount, start, shape });
        let [a, b, c] = [0.0; 3].map(|_| rng.random_range(0.0..6.0));
        let depth = 1e-3 * size * rng.random_range(0.0..1.0);
        let half = 0.5 * gear.face_width();
        let wavy = |[u, z]: [f64; 2]| depth * ((90.0 * u + a).cos() + (7.0 * u + b).sin() * (3.0 * z / half + c).cos());
        flank.topography = Some(grid(gear, [121, 13], wavy).into());
        GearModifications::both(flank)
    });
    let pair = testing::modified(&case.pair, modified);
    let options = case.slice_options().with_contact(|c| {
        c.method = Method::Slice;
        c.slices = 16;
    });
    let base = StaticModel::new(pair, case.reduced_gears(&options), options);
    let mut base = base.unwrap();
    let station = |i: u32| Station { cycle: 0, phase: (f64::from(i) + 0.4) / 3.0 };
    (0..3).map(|i| base.solve(station(i)).unwrap()).collect()
}

/// One turn of a gear whose teeth differ: what a tooth bears shows while it is in mesh and no longer, and the answer of a
/// station does not depend on where the run began.
#[test]
fn flanks_by_tooth_show_while_their_tooth_is_in_mesh() {
    let loaded = Loaded::new(0.0, 12);
    let pinion = &loaded.case.pair.pinion;
    let side = loaded.base.options().side();
    let wave = Wave { order: 7.0, amplitude: 2e-3, phase: 0.3 };
    let own =
        with_flanks(pinion, side, 0..30, lines(pinion, 7.0, 8.0), |tooth, at| wave.depth(pinion, side, tooth, at));
    let pair = with_pinion(&loaded.case.pair, own);
    let mut model = loaded.base.modified(pair.clone(), loaded.base.options().clone()).unwrap();
    let history = model.run(4, 30, |_, _, _| ()).unwrap();
    assert_eq!(history.positions.len(), 120);
    // Order 7 of the turn, and nothing else of its kind beside it.
    let te: Vec<f64> = history.positions.iter().map(|p| p.transmission_error).collect();
    let order = |o: usize| {
        let turn = |i: usize| 2.0 * PI * (o * i) as f64 / te.len() as f64;
        let [c, s] = [f64::cos, f64::sin].map(|f| te.iter().enumerate().map(|(i, x)| x * f(turn(i))).sum::<f64>());
        2e3 * c.hypot(s) / te.len() as f64
    };
    println!("orders 6, 7, 8: {:.4}, {:.4}, {:.4} um of {}", order(6), order(7), order(8), 1e3 * wave.amplitude);
    assert!((order(7) - 1e3 * wave.amplitude).abs() < 0.02, "order 7: {} um", order(7));
    assert!(order(6).max(order(8)) < 0.05 * order(7));
    // The same stations by another way.
    let mut again = loaded.base.modified(pair, loaded.base.options().clone()).unwrap();
    let coarse = again.run(2, 20, |_, _, _| ()).unwrap();
    for (i, own) in coarse.positions.iter().enumerate() {
        let same = &history.positions[2 * i];
        assert!((own.mesh_phase - same.mesh_phase).abs() < 1e-12);
        assert!((own.transmission_error - same.transmission_error).abs() < 1e-10, "station {i}");
    }
}

/// One wave of the profile against a model that resolves it: points pressed by themselves on flanks with a dozen elements in
/// the band and twenty in a wave, plane because Poisson's ratio is 0. No law of a band is in it.
#[test]
fn a_resolved_model_sees_the_same_wave() {
    let data = default_data(0.0).map(|d| GearData { face_width: 2.0, ..d });
    // Narrow bands ask for a finer mesh.
    let all = testing::cases(1, 2) > 1;
    let [profile, thickness] = if all { [256, 96] } else { [160, 64] };
    let case = testing::of_order(1, data, None, 1.0, [profile, 8, thickness, 1, 4], mesh::Extent::Periodic);
    let material = fem::Material::new(2.06e5, 0.0, 7.85e-9).unwrap();
    let pinion = &case.pair.pinion;
    let model = |options: StaticOptions| {
        let first = StaticModel::first_teeth(&case.pair, &options).unwrap();
        let gears = [0, 1].map(|i| {
            let o = reduction::ReductionOptions {
                sides: options.contact.sides(),
                window: options.window_teeth(&case.pair),
                first: first[i],
                elements: case.elements,
            };
            reduction::ElasticGear::Reduced(reduction::GearReducer::new(case.meshes[i].clone(), material, o).unwrap())
        });
        StaticModel::new(case.pair.clone(), gears, options).unwrap()
    };
    let points = model(case.options().with_contact(|c| c.points_per_face_edge = 4));
    let sliced = model(case.slice_options().with_contact(|c| c.slices = 4));
    let station = Station { cycle: 0, phase: 0.5 };
    // Of tooth 0 alone: the teeth beside are out of the way, under such a load they would press, too.
    let solved = |base: &StaticModel, line_load: f64, counts: [usize; 2], depth: &dyn Fn(f64) -> f64| {
        let of = |tooth: i64, [u, _]: [f64; 2]| if tooth == 0 { depth(u) } else { 0.3 };
        let waved = with_flanks(pinion, base.options().side(), 0..30, counts, of);
        let options = StaticOptions { torque: line_load * 2.0 * pinion.base_radius(), ..base.options().clone() };
        base.modified(with_pinion(&case.pair, waved), options).unwrap().solve(station).unwrap()
    };
    let of = |base: &StaticModel, line_load: f64, order: f64| {
        let te = |phase: f64, sign: f64| {
            let depth = |u: f64| sign * 0.2e-3 * (order * u + phase).cos();
            solved(base, line_load, [lines(pinion, order, 5.0)[0], 3], &depth).transmission_error
        };
        let of = |phase: f64| (te(phase, 1.0) - te(phase, -1.0)) / 0.4e-3;
        [of(0.0), of(FRAC_PI_2)]
    };
    let tried = [(1900.0, [50.0, 80.0]), (700.0, [80.0, 130.0])];
    for (line_load, orders) in tried.into_iter().take(if all { 2 } else { 1 }) {
        let smooth = slices(&solved(&sliced, line_load, [9, 3], &|_| 0.0));
        let (a, p) = (smooth[0].half_width, smooth[0].pressure);
        for order in orders {
            let ka = order / (pinion.base_radius() * smooth[0].roll[0]) * a;
            let [own, wanted] = [of(&points, line_load, order), of(&sliced, line_load, order)];
            let off = (own[0] - wanted[0]).hypot(own[1] - wanted[1]);
            let [own, wanted] = [own, wanted].map(|both| both[0].hypot(both[1]));
            println!(
                "a {a:.3} mm, {p:.0} MPa, order {order}, k a {ka:.3}: points {own:.4}, slices {wanted:.4}, J_0 {:.4}; \
                 apart by {off:.4}",
                bessel(ka)
            );
            assert!((own - bessel(ka).abs()).abs() < 0.03, "order {order}: {own}, not {}", bessel(ka));
            assert!(off < 0.05, "order {order}: points {own}, slices {wanted}, apart by {off}");
        }
    }
}
