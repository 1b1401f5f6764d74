//! Lumped shafts: elasticity, coupling, frequencies, static loads.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use fem::beam::{BeamLine, BeamTheory};
use geometry::{Gear, GearData, GearPair, Side};
use integrate::{Integrator, Mechanism, Scheme, State, StepControl};
use lumped::shaft18::{
    Continuum, Influence, LumpedShaft, MeshGeometry, Shaft, ShaftMechanism, ShaftStation, ShaftSystem, Station,
    Support, bending_influence, continuum_modes, equivalent_torsional_stiffness,
};
use lumped::{Fourier, LumpedError, MeshCycle};
use nalgebra::{DMatrix, DVector, SVector, Translation3, UnitQuaternion, Vector3};

use crate::{
    gearbox::{ALL, disc, gearbox, steel},
    recording::{Recording, shafts},
};

/// Steps of different diameters, one of them hollow.
fn stepped() -> Shaft {
    let hollow = lumped::shaft18::Segment { inner_diameter: 14.0, ..steel(60.0, 42.0) };
    Shaft {
        segments: vec![steel(40.0, 25.0), steel(50.0, 35.0), hollow, steel(30.0, 20.0)],
        stations: vec![disc(15.0, 1e-3, 10.0, ALL), disc(97.0, 2e-3, 20.0, ALL), disc(170.0, 1e-3, 10.0, ALL)],
        supports: vec![
            Support { position: 30.0, stiffness: [2e5, 1e5, 5e4, 0.0, 0.0, 0.0], ..Support::default() },
            Support { position: 140.0, stiffness: [1e5, 2e5, 0.0, 3e6, 0.0, 1e7], ..Support::default() },
        ],
    }
}

/// The series rule: exact for the equivalent stiffness, and the twist of a stepped shaft between its stations is what
/// it says.
#[test]
fn torsion_follows_the_series_rule() {
    let shaft = stepped();
    let parts: Vec<(f64, f64)> =
        shaft.pieces().unwrap().iter().map(|p| (p.length, p.section.torsional_stiffness())).collect();
    let whole = equivalent_torsional_stiffness(&parts);
    let sum: f64 = parts.iter().map(|(l, k)| l / k).sum();
    assert!((shaft.length() / whole / sum - 1.0).abs() < 1e-15);
    // Twist by a moment at the far end, station 0 held: l_n of the pieces between 15 and 170 mm.
    let free = Shaft { supports: vec![], ..shaft.clone() };
    let lumped = LumpedShaft::new(&free, BeamTheory::Timoshenko, 0).unwrap();
    let turns: Vec<usize> = (0..lumped.kept.len()).filter(|&i| lumped.kept[i].1 == 5).collect();
    let k = DMatrix::from_fn(2, 2, |i, j| lumped.stiffness[(turns[i + 1], turns[j + 1])]);
    let twist = k.lu().solve(&DVector::from_vec(vec![0.0, 1.0])).unwrap()[1];
    let lengths = [25.0, 50.0, 60.0, 20.0];
    let expected: f64 = lengths.iter().zip(&parts).map(|(l, (_, k))| l / k).sum();
    assert!((twist / expected - 1.0).abs() < 1e-12, "{twist:e} rad/(N mm), not {expected:e}");
}

/// One disc between two stiffnesses: the seed's formulas, the misprinted exponent corrected (2 a E I_3 l for 2 a^2 E
/// I_3 l).
#[test]
fn influence_coefficients_of_one_disc_are_the_seeds() {
    let shaft = Shaft { segments: vec![steel(113.8, 38.5), steel(96.6, 25.77)], ..Shaft::default() };
    let pieces = shaft.pieces().unwrap();
    let [e3, e4] = [0, 1].map(|i: usize| pieces[i].section.bending_stiffness());
    let (a, l) = (113.8f64, 210.4);
    let b = l - a;
    let under = 3.0 * e3 * e4 * l * l;
    let rr = a * b * (2.0 * a.powi(3) * (e3 - e4) + a * a * (2.0 * e4 * l - 3.0 * e3 * l) + e3 * l * (l * l - b * b))
        / (2.0 * under);
    let printed =
        |exponent: i32| a * (l - a) * (a * a * (e3 - e4) - 2.0 * a.powi(exponent) * e3 * l + e3 * l * l) / under;
    let pp = -(a.powi(3) * (e3 - e4) - 3.0 * a * a * e3 * l + 3.0 * a * e3 * l * l - e3 * l.powi(3)) / under;
    let places = [Influence::Shift(a), Influence::Turn(a)];
    let found = bending_influence(&pieces, [0.0, l], &places, BeamTheory::Euler);
    for (i, j, expected) in [(0, 0, rr), (0, 1, printed(1)), (1, 0, printed(1)), (1, 1, pp)] {
        let off = found[(i, j)] / expected - 1.0;
        assert!(off.abs() < 1e-12, "coefficient {i}{j}: {:e}, not {expected:e}", found[(i, j)]);
    }
    println!("a_rp as printed is {:.1} times the right one", printed(2) / printed(1));
    assert!((printed(2) / printed(1)).abs() > 10.0, "the printed exponent would do as well");
}

/// Stiffness that beam elements have in the coordinates of `shaft`'s stations.
fn by_elements(shaft: &Shaft, theory: BeamTheory) -> DMatrix<f64> {
    let mut places: Vec<f64> = shaft.stations.iter().map(|s| s.position).collect();
    places.extend(shaft.supports.iter().map(|s| s.position));
    let line = BeamLine::new(&shaft.pieces().unwrap(), &places, 12.0, theory).unwrap();
    let mut k = line.stiffness.clone();
    for s in &shaft.supports {
        let at = 6 * line.node_at(s.position);
        (0..6).for_each(|i| k[(at + i, at + i)] += s.stiffness[i]);
    }
    // Flexibility at the stations, and its inverse.
    let n = 6 * shaft.stations.len();
    let nodes: Vec<usize> = (0..n).map(|i| 6 * line.node_at(shaft.stations[i / 6].position) + i % 6).collect();
    let loads = DMatrix::from_fn(k.nrows(), n, |i, j| f64::from(u8::from(i == nodes[j])));
    let moved = k.lu().solve(&loads).unwrap();
    DMatrix::from_fn(n, n, |i, j| moved[(nodes[i], j)]).try_inverse().unwrap()
}

/// Bending, torsion, axial stiffness between stations and supports of a stepped shaft = a fine row of beam elements
/// condensed to the same coordinates.
#[test]
fn stiffness_is_that_of_beam_theory() {
    let shaft = stepped();
    for theory in [BeamTheory::Timoshenko, BeamTheory::Euler] {
        let found = LumpedShaft::new(&shaft, theory, 0).unwrap().stiffness;
        let expected = by_elements(&shaft, theory);
        // Turns are counted by the arc at 50 mm.
        let scale = |i: usize| if i % 6 < 3 { 1.0 } else { 0.02 };
        let of = |m: &DMatrix<f64>| DMatrix::from_fn(18, 18, |i, j| m[(i, j)] * scale(i) * scale(j));
        let (found, expected) = (of(&found), of(&expected));
        let off = (&found - &expected).amax() / expected.amax();
        println!("{theory:?}: off by {off:.1e}");
        assert!(off < 1e-8, "{theory:?}: off by {off:e}");
    }
}

/// A support that stands beside a station, however near, holds the shaft as one at the station does.
#[test]
fn a_support_beside_a_station_changes_no_frequency() {
    let modes = |apart: f64| {
        let mut system = gearbox(100.0, 0.0);
        system.shafts[0].supports[1].position -= apart;
        system.shafts[1].supports[0].position += apart;
        ShaftMechanism::new(&system).unwrap().modes().unwrap().frequencies
    };
    let wanted = modes(0.0);
    for power in 2..=12 {
        let apart = 10f64.powi(-power);
        for (a, b) in modes(apart).iter().zip(&wanted).skip(1) {
            assert!((a / b - 1.0).abs() < 1e-7 + 2e-2 * apart, "{apart} mm: {a} beside {b} rad/s");
        }
    }
}

/// Whatever is left out, mass stays: a rigid move of the shaft carries discs and shaft.
#[test]
fn lumping_keeps_mass_centre_and_inertia_about_the_axis() {
    let mut shaft = stepped();
    shaft.supports.clear();
    let pieces = shaft.pieces().unwrap();
    let (mut start, mut mass, mut moment, mut polar) = (0.0, 0.0, 0.0, 0.0);
    for p in &pieces {
        let m = p.section.mass_per_length() * p.length;
        (mass, moment) = (mass + m, moment + m * (start + 0.5 * p.length));
        polar += 2.0 * p.section.inertia_per_length() * p.length;
        start += p.length;
    }
    for s in &shaft.stations {
        (mass, moment, polar) = (mass + s.mass, moment + s.mass * s.position, polar + s.polar_inertia);
    }
    let lumped = LumpedShaft::new(&shaft, BeamTheory::Timoshenko, 0).unwrap();
    let n = lumped.kept.len();
    let rigid = |axis: usize| DVector::from_fn(n, |i, _| f64::from(u8::from(lumped.kept[i].1 == axis)));
    // Slope about the beginning of the shaft: x = z, theta_y = 1.
    let tilt = DVector::from_fn(n, |i, _| match lumped.kept[i] {
        (s, 0) => shaft.stations[s].position,
        (_, 4) => 1.0,
        _ => 0.0,
    });
    let of = |a: &DVector<f64>, b: &DVector<f64>| a.dot(&(&lumped.mass * b));
    for (name, found, expected) in [
        ("mass along x", of(&rigid(0), &rigid(0)), mass),
        ("mass along z", of(&rigid(2), &rigid(2)), mass),
        ("moment of mass", of(&rigid(0), &tilt), moment),
        ("polar inertia", of(&rigid(5), &rigid(5)), polar),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-12, "{name}: {found:e}, not {expected:e}");
    }
}

/// The line of action is what the true flanks say: the gap at the pitch point changes with each displacement of either
/// gear by -h; in the middle of the common face, wherever the wheel's mid-face is; also of a ring.
#[test]
fn mesh_line_is_the_slope_of_the_true_gap() {
    let runs = [(Side::Left, 1.0), (Side::Right, 1.0), (Side::Left, -1.0), (Side::Right, -1.0)];
    let all = runs.into_iter().flat_map(|run| [(0.0, false), (13.0, false), (0.0, true)].map(|more| (run, more)));
    for ((side, hand), (offset, ring)) in all {
        let data = GearData { helix_angle: hand * 25f64.to_radians(), thickness_allowance: 0.0, ..GearData::default() };
        let wheel = if ring {
            let own = GearData { teeth: 71, addendum_coefficient: 0.85, bore_diameter: -280.0, ..data.clone() };
            own.with_usual_shaper(0.0)
        } else {
            GearData { helix_angle: -data.helix_angle, teeth: 41, profile_shift: 0.2, ..data.clone() }
        };
        let pair = GearPair::new(Gear::new(data).unwrap(), Gear::new(wheel).unwrap(), None).unwrap();
        let pair = pair.with_mid_face_offset(offset).unwrap();
        let line = MeshGeometry::of_pair(&pair, side).line().unwrap();
        let projection = contact::FlankProjection::new(&pair, side);
        let middle = pair.common_middle()[0];
        // Pinion angle at which the flanks of teeth 0 touch at the pitch point in the middle of the common face.
        let roll = pair.working_pressure_angle().tan();
        let theta1 = side.sign() * (roll - pair.pinion.profile().base_half_angle() - pair.working_pressure_angle())
            - pair.pinion.twist() * middle;
        let angles = [theta1, pair.wheel_angle(side, theta1)];
        let centres = [Vector3::zeros(), Vector3::new(pair.centre_distance(), 0.0, offset)];
        let flanks = [pair.pinion.flank(side), pair.wheel.flank(side)];
        let pose = |g: usize, d: &SVector<f64, 6>| {
            let turn = UnitQuaternion::from_scaled_axis(Vector3::new(d[3], d[4], d[5]));
            let own = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angles[g]);
            let place = centres[g] + Vector3::new(d[0], d[1], d[2]);
            nalgebra::Isometry3::from_parts(Translation3::from(place), turn * own)
        };
        let still = SVector::<f64, 6>::zeros();
        let gap = |d: [SVector<f64, 6>; 2]| {
            let point = pose(0, &d[0]).transform_point(&flanks[0].point(roll, middle).into());
            flanks[1].locate(&pose(1, &d[1]).inverse_transform_point(&point).coords).unwrap().distance
        };
        assert!(gap([still, still]).abs() < 1e-10, "{side:?}, hand {hand}: flanks do not touch at the pitch point");
        for g in 0..2 {
            for axis in 0..6 {
                let h = if axis < 3 { 1e-4 } else { 1e-6 };
                let moved = |step: f64| {
                    let mut d = [still, still];
                    d[g][axis] = step;
                    gap(d)
                };
                let slope = (moved(h) - moved(-h)) / (2.0 * h);
                let expected = -line.levers[g][axis];
                let scale = if axis < 3 { 1.0 } else { line.base_radii[g].abs() };
                assert!(
                    (slope - expected).abs() < 1e-5 * scale,
                    "{side:?}, hand {hand}, offset {offset}, gear {g}, axis {axis}: {slope}, not {expected}"
                );
                let projected = projection.approach[6 * g + axis];
                assert!(
                    (projected + expected).abs() < 1e-12 * scale,
                    "{side:?}, hand {hand}, offset {offset}, gear {g}, axis {axis}: approach {projected}"
                );
            }
        }
    }
}

/// Forces of a steady torque: F_n = T / (r_b cos b_b), F_a = F_bt tan b_b, tilting moment F_a r_w, either driver.
#[test]
fn static_forces_are_those_of_the_torque() {
    for side in [Side::Left, Side::Right] {
        let mut system = gearbox(100.0, 0.02);
        system.gravity = [0.0; 3];
        let sign = side.sign();
        system.meshes[0].geometry.side = side;
        system.torques.iter_mut().for_each(|t| t.torque *= sign);
        let model = ShaftMechanism::new(&system).unwrap();
        let q = model.static_state(0.0).unwrap();
        let row = model.row(0, 0.0, &q, &DVector::zeros(q.len())).unwrap();
        let beta: f64 = 30f64.to_radians();
        let alpha_t = (20f64.to_radians().tan() / beta.cos()).atan();
        let base_helix = (beta.sin() * 20f64.to_radians().cos()).asin();
        let pitch_radius = 0.5 * 2.75 * 30.0 / beta.cos();
        let transverse = 1e5 / (pitch_radius * alpha_t.cos());
        let axial = transverse * base_helix.tan();
        let force = transverse / base_helix.cos();
        let w = &row.wrench[0];
        assert!((row.normal_force / force - 1.0).abs() < 1e-9, "{side:?}: {} N, not {force}", row.normal_force);
        let expected = [
            -transverse * alpha_t.sin(),
            -sign * transverse * alpha_t.cos(),
            sign * axial,
            0.0,
            -sign * axial * pitch_radius,
            -sign * 1e5,
        ];
        for (axis, (found, expected)) in w.iter().zip(expected).enumerate() {
            let scale = if axis < 3 { force } else { 1e5 };
            assert!((found - expected).abs() < 1e-8 * scale, "{side:?}, axis {axis}: {found}, not {expected}");
        }
        for axis in 0..3 {
            assert!((row.wrench[0][axis] + row.wrench[1][axis]).abs() < 1e-9 * force);
        }
        assert!(row.transmission_error_um > 0.0, "the driven gear leads: {} um", row.transmission_error_um);
    }
}

/// c = 2 xi sqrt(k_s / (1/m_1 + 1/m_2)): the damped oscillation of two discs alone falls by xi.
#[test]
fn mesh_damping_is_the_ratio_asked_for() {
    let mut system = gearbox(0.0, 0.0);
    // Nothing but the gears and their turns is left.
    for shaft in &mut system.shafts {
        shaft.stations.retain(|s| s.kept == ALL);
        shaft.stations[0].kept = [false, false, false, false, false, true];
        shaft.segments.iter_mut().for_each(|s| s.density = 0.0);
        shaft.supports.iter_mut().for_each(|s| s.stiffness[..3].fill(1e12));
    }
    system.meshes[0].gears[0].station = 0;
    system.torques.clear();
    (system.mass_damping, system.stiffness_damping, system.gravity) = (0.0, 0.0, [0.0; 3]);
    system.meshes[0].stiffness = lumped::Fourier::constant(4.5e5);
    let mut model = ShaftMechanism::new(&system).unwrap();
    assert_eq!(model.count(), 2);
    let modes = model.modes().unwrap();
    let (omega, shape) = (modes.frequencies[1], modes.shape(1));
    let mut out = integrate::Forces::zeros(2);
    let Ok(()) = model.forces(0.0, &DVector::zeros(2), &DVector::zeros(2), &mut out);
    // Bearings hold nothing in turning: what damps the mode is the mesh.
    let ratio = shape.dot(&(&out.damping * &shape)) / (2.0 * omega);
    println!("{:.1} Hz, damping ratio {ratio:.5}", omega / TAU);
    assert!((ratio / 0.05 - 1.0).abs() < 1e-9, "{ratio}");
}

/// Twelve lowest frequencies against beam elements (Timoshenko, 6 mm; Euler beside it): within 8 %.
#[test]
fn frequencies_agree_with_the_continuum() {
    let system = gearbox(0.0, 0.0);
    let model = ShaftMechanism::new(&system).unwrap();
    assert_eq!(model.count(), 18);
    let lumped = model.modes().unwrap().frequencies;
    let continuum = continuum_modes(&system, 38, BeamTheory::Timoshenko).unwrap().frequencies;
    let slender = continuum_modes(&system, 38, BeamTheory::Euler).unwrap().frequencies;
    // The free turn of both shafts.
    assert!(lumped[0] < 1.0 && continuum[0] < 1.0, "{} and {} rad/s", lumped[0], continuum[0]);
    println!(
        "| mode | lumped, 18 DOF (Hz) | Timoshenko beams (Hz) | off by (%) | Euler beams (Hz) |\n|---|---|---|---|---|"
    );
    for mode in 1..18 {
        let [a, b, c] = [&lumped, &continuum, &slender].map(|f| f[mode] / TAU);
        let off = a / b - 1.0;
        println!("| {mode} | {a:.1} | {b:.1} | {:+.2} | {c:.1} |", 100.0 * off);
        assert!(mode > 12 || off.abs() < 0.08, "mode {mode}: {a} Hz, not {b}");
    }
}

/// A shaft of two metres beside one of a tenth of it has as many elements, not as short ones: the work is that of two
/// shafts alike.
#[test]
fn a_long_shaft_beside_a_short_one_costs_no_more() {
    let mut system = gearbox(0.0, 0.0);
    let nodes = |system: &ShaftSystem| Continuum::new(system, 20, BeamTheory::Timoshenko).unwrap().mass.nrows();
    let alike = nodes(&system);
    let long = &mut system.shafts[1];
    long.segments.iter_mut().for_each(|s| s.length *= 20.0);
    long.stations.iter_mut().for_each(|s| s.position *= 20.0);
    long.supports.iter_mut().for_each(|s| s.position *= 20.0);
    assert!(nodes(&system) <= alike + 12, "{} coordinates, not {alike}", nodes(&system));
}

/// All stations kept and more of them: the lumped shaft tends to the continuum.
#[test]
fn more_stations_come_nearer_to_the_continuum() {
    let mut system = gearbox(0.0, 0.0);
    let continuum = continuum_modes(&system, 74, BeamTheory::Timoshenko).unwrap().frequencies;
    let mut last = f64::INFINITY;
    system.shafts.iter_mut().for_each(|s| s.stations.retain(|s| s.mass > 0.0));
    for parts in [2, 4, 8] {
        let mut finer = system.clone();
        for shaft in &mut finer.shafts {
            let (given, length) = (shaft.stations.clone(), shaft.length());
            shaft.stations.iter_mut().for_each(|s| s.kept = ALL);
            for i in 0..=parts {
                let position = length * f64::from(i) / f64::from(parts);
                if given.iter().all(|s| (s.position - position).abs() > 5.0) {
                    shaft.stations.push(Station { position, kept: ALL, ..Station::default() });
                }
            }
        }
        let found = ShaftMechanism::new(&finer).unwrap().modes().unwrap().frequencies;
        let worst = (1..=12).map(|i| (found[i] / continuum[i] - 1.0).abs()).fold(0.0, f64::max);
        println!("{parts} parts a shaft: off by {:.2} %", 100.0 * worst);
        assert!(worst < last, "{parts} parts: {worst}");
        last = worst;
    }
    assert!(last < 0.005, "{last}");
    system.shafts[0].segments[0].density = 0.0;
    assert!(ShaftMechanism::new(&system).is_ok(), "a shaft without mass of its own");
}

/// Three shafts in a train, gears of six coordinates each: eighteen as well; speeds follow the teeth, torques are in
/// balance through the idler.
#[test]
fn three_shafts_make_a_train() {
    let mut system = gearbox(200.0, 0.0);
    let mut third = system.shafts[1].clone();
    system.shafts[1].stations[1].kept = [false; 6];
    system.shafts[0].stations[0].kept = [false; 6];
    third.stations[1].kept = [false; 6];
    system.shafts.push(third);
    let mut second = system.meshes[0].clone();
    second.gears = [ShaftStation { shaft: 1, station: 0 }, ShaftStation { shaft: 2, station: 0 }];
    second.geometry.teeth = [46, 46];
    second.geometry.helix_angle *= -1.0;
    second.geometry.centre_distance *= 92.0 / 76.0;
    second.geometry.direction = 0.7;
    second.geometry.side = Side::Right;
    system.meshes.push(second);
    let load = &mut system.torques[1];
    load.place = ShaftStation { shaft: 2, station: 0 };
    load.torque *= -1.0;
    let mut model = ShaftMechanism::new(&system).unwrap();
    assert_eq!(model.count(), 18);
    let speeds = system.speeds().unwrap();
    assert!((speeds[1] + 200.0 * 30.0 / 46.0).abs() < 1e-9 && (speeds[2] - 200.0 * 30.0 / 46.0).abs() < 1e-9);
    let q = model.static_state(0.0).unwrap();
    let at = |mesh: usize| model.row(mesh, 0.0, &q, &DVector::zeros(q.len())).unwrap().normal_force;
    assert!(at(0) > 1000.0 && (at(0) / at(1) - 1.0).abs() < 1e-6, "{} and {} N", at(0), at(1));
    let lumped = model.modes().unwrap().frequencies;
    let continuum = continuum_modes(&system, 38, BeamTheory::Timoshenko).unwrap().frequencies;
    // Nine modes: coordinates at one place a shaft cannot be without its ends for more.
    for mode in 1..=9 {
        let off = lumped[mode] / continuum[mode] - 1.0;
        println!("train, mode {mode}: {:.1} Hz, {:+.2} %", lumped[mode] / TAU, 100.0 * off);
        assert!(off.abs() < 0.08, "mode {mode}: {} and {} rad/s", lumped[mode], continuum[mode]);
    }
    let run = Recording {
        scheme: Scheme::RungeKutta4,
        control: StepControl::Fixed(TAU / (200.0 * 30.0) / 200.0),
        settle: 0.0,
        duration: 0.01,
        rows: 190,
    };
    assert!(shafts(&mut model, 1, &run).rows.iter().all(|r| r.normal_force.is_finite() && r.normal_force > 0.0));
}

/// Runge-Kutta 4, Dormand-Prince with error control and generalised-alpha tell the same story; energy closes.
#[test]
fn methods_agree_and_energy_closes() {
    let system = gearbox(300.0, 0.01);
    let period = TAU / (300.0 * 30.0);
    let adaptive = StepControl::Adaptive { tolerance: 1e-9, first: 1e-6, least: 1e-12, largest: 1e-4 };
    let mut ends = Vec::new();
    for (scheme, control) in [
        (Scheme::RungeKutta4, StepControl::Fixed(period / 200.0)),
        (Scheme::DormandPrince, adaptive),
        (Scheme::GeneralisedAlpha { rho: 1.0 }, StepControl::Fixed(period / 2000.0)),
        (Scheme::Energy, StepControl::Fixed(period / 400.0)),
    ] {
        let mut model = ShaftMechanism::new(&system).unwrap();
        let q = model.static_state(0.0).unwrap();
        let n = q.len();
        let mut state = State::new(0.0, q, DVector::zeros(n));
        let mut integrator = Integrator::new(scheme, control, model.scale());
        integrator.advance(&mut model, &mut state, 5.0 * period, |_, _| ()).unwrap();
        let row = model.row(0, state.time, &state.q, &state.v).unwrap();
        let open = integrator.ledger().unwrap().relative_residual();
        println!(
            "{scheme:?}: {:.6} um, {:.3} N, energy open by {open:.1e}",
            row.transmission_error_um, row.normal_force
        );
        assert!(open.abs() < 2e-5, "{scheme:?}: {open:e}");
        ends.push(row.compression);
    }
    for end in &ends {
        assert!((end / ends[1] - 1.0).abs() < 2e-3, "{ends:?}");
    }
}

/// The system of shafts with their ends exchanged.
fn reversed(system: &ShaftSystem) -> ShaftSystem {
    let mut other = system.clone();
    for shaft in &mut other.shafts {
        let length = shaft.length();
        shaft.segments.reverse();
        shaft.stations.iter_mut().for_each(|s| s.position = length - s.position);
        shaft.supports.iter_mut().for_each(|s| s.position = length - s.position);
    }
    other
}

/// Both hands and both senses of rotation mirrored: the same compression, forces mirrored.
#[test]
fn mirrored_systems_answer_mirrored() {
    let run = Recording {
        scheme: Scheme::RungeKutta4,
        control: StepControl::Fixed(5e-6),
        settle: 0.0,
        duration: 4e-3,
        rows: 16,
    };
    let rows = |system: &ShaftSystem| shafts(&mut ShaftMechanism::new(system).unwrap(), 0, &run).rows;
    let mut system = gearbox(300.0, 0.01);
    system.gravity = [0.0; 3];
    let given = rows(&system);
    let mut hand = reversed(&system);
    hand.meshes[0].geometry.helix_angle *= -1.0;
    let mut sense = reversed(&system);
    sense.speed *= -1.0;
    sense.meshes[0].geometry.side = Side::Right;
    sense.torques.iter_mut().for_each(|t| t.torque *= -1.0);
    // Mirrored in z: hand and f_z, m_x, m_y change. Turned about the line of centres: the hand stays, sense and f_y,
    // f_z, m_y, m_z change.
    for (name, other, signs) in [
        ("other hand", hand, [1.0, 1.0, -1.0, -1.0, -1.0, 1.0]),
        ("other sense", sense, [1.0, -1.0, -1.0, 1.0, -1.0, -1.0]),
    ] {
        for (a, b) in given.iter().zip(rows(&other)) {
            assert!((a.compression / b.compression - 1.0).abs() < 1e-6, "{name}: {a:?} and {b:?}");
            for (i, sign) in signs.into_iter().enumerate() {
                let scale = if i < 3 { 1.0 } else { 50.0 } * a.normal_force.abs();
                let off = a.wrench[0][i] - sign * b.wrench[0][i];
                assert!(off.abs() < 1e-6 * scale, "{name}, axis {i}: {} and {}", a.wrench[0][i], b.wrench[0][i]);
            }
        }
    }
}

/// Speed to zero: the dynamic transmission error tends to the static one at every phase.
#[test]
fn slow_running_is_static() {
    let mut system = gearbox(0.5, 0.0);
    // Enough damping that the start dies away; supports without their own.
    system.stiffness_damping = 2e-5;
    system.meshes[0].damping_ratio = 0.3;
    let mut model = ShaftMechanism::new(&system).unwrap();
    let period = TAU / (0.5 * 30.0);
    let run = Recording {
        scheme: Scheme::GeneralisedAlpha { rho: 0.5 },
        control: StepControl::Fixed(period / 400.0),
        settle: 0.25 * period,
        duration: period,
        rows: 20,
    };
    for row in shafts(&mut model, 0, &run).rows {
        let q = model.static_state(row.time).unwrap();
        let expected = model.row(0, row.time, &q, &DVector::zeros(q.len())).unwrap().compression;
        assert!((row.compression / expected - 1.0).abs() < 1e-3, "{} s: {}, not {expected}", row.time, row.compression);
    }
}

/// Fed by another model's cycle on the transverse line of action: the same static transmission error under the same
/// torque.
#[test]
fn a_fed_mesh_has_the_transmission_error_of_its_source() {
    let mut system = gearbox(100.0, 0.0);
    // Rigid but for the mesh: shafts of a diameter that yields nothing.
    for shaft in &mut system.shafts {
        shaft.segments.iter_mut().for_each(|s| (s.outer_diameter, s.density) = (2000.0, 0.0));
        shaft.supports.iter_mut().for_each(|s| s.stiffness[..3].fill(1e12));
        shaft.stations.retain(|s| s.mass > 0.0);
    }
    let cycle = MeshCycle::new(Fourier::first_order(4e5, 3e4, 1e4), Fourier::first_order(0.004, 0.001, -0.002));
    system.meshes[0] = system.meshes[0].clone().fed(&cycle).unwrap();
    let model = ShaftMechanism::new(&system).unwrap();
    let line = system.meshes[0].geometry.line().unwrap();
    let force = 1e5 / line.base_radii[0];
    for i in 0..8 {
        let t = model.mesh_period(0).unwrap() * f64::from(i) / 8.0;
        let q = model.static_state(t).unwrap();
        let found = model.row(0, t, &q, &DVector::zeros(q.len())).unwrap().transmission_error_um;
        let phase = TAU * f64::from(i) / 8.0;
        let expected = 1e3 * (force / cycle.stiffness.at(phase) + cycle.error.at(phase));
        assert!((found / expected - 1.0).abs() < 1e-3, "phase {phase}: {found} um, not {expected}");
    }
}

#[test]
fn nonsense_is_refused() {
    type Change = fn(&mut ShaftSystem);
    let cases: [(&str, Change); 23] = [
        ("coordinate without mass", |s| {
            s.shafts[0].segments.iter_mut().for_each(|x| x.density = 0.0);
            s.shafts[0].stations[3].kept[5] = true;
        }),
        ("no shafts", |s| s.shafts.clear()),
        ("length", |s| s.shafts[0].segments[0].length = -1.0),
        ("length nan", |s| s.shafts[0].segments[0].length = f64::NAN),
        ("no segments", |s| s.shafts[0].segments.clear()),
        ("diameter", |s| s.shafts[0].segments[0].outer_diameter = 0.0),
        ("inner diameter", |s| s.shafts[0].segments[0].inner_diameter = 99.0),
        ("young", |s| s.shafts[0].segments[0].young = 0.0),
        ("density", |s| s.shafts[0].segments[0].density = -1.0),
        ("station beside the shaft", |s| s.shafts[0].stations[0].position = 999.0),
        ("mass", |s| s.shafts[0].stations[0].mass = f64::NAN),
        ("stations at one place", |s| s.shafts[0].stations[0].position = 113.8),
        ("no stations", |s| s.shafts[0].stations.clear()),
        ("support", |s| s.shafts[0].supports[0].stiffness[0] = -1.0),
        ("gear nowhere", |s| s.meshes[0].gears[0].station = 7),
        ("teeth", |s| s.meshes[0].geometry.teeth[0] = 0),
        ("centre distance", |s| s.meshes[0].geometry.centre_distance = 10.0),
        ("helix", |s| s.meshes[0].geometry.helix_angle = 2.0),
        ("stiffness below zero", |s| s.meshes[0].stiffness.cosine[0] = 9e5),
        ("backlash", |s| s.meshes[0].half_backlash = -0.1),
        ("damping", |s| s.meshes[0].damping_ratio = f64::INFINITY),
        ("shaft alone", |s| s.meshes.clear()),
        ("speed", |s| s.speed = f64::NAN),
    ];
    for (name, change) in cases {
        let mut system = gearbox(100.0, 0.0);
        change(&mut system);
        let refused = ShaftMechanism::new(&system).expect_err(name);
        assert!(!refused.to_string().is_empty() && refused.hint().is_none_or(|h| !h.is_empty()), "{name}");
    }
    let loose: [(&str, Change); 5] = [
        ("tilting about x", |s| s.shafts[0].supports.truncate(1)),
        ("along z", |s| s.shafts[1].supports.iter_mut().for_each(|b| b.stiffness[2] = 0.0)),
        ("along x", |s| s.shafts[1].supports.iter_mut().for_each(|b| b.stiffness[0] = 0.0)),
        ("tilting about y", |s| s.shafts[0].supports[1].stiffness[0] = 0.0),
        // Two supports so near that they are one.
        ("tilting about x", |s| s.shafts[0].supports[1].position = 1e-8),
    ];
    for (motion, change) in loose {
        let mut system = gearbox(100.0, 0.0);
        change(&mut system);
        let refused = ShaftMechanism::new(&system).expect_err(motion);
        assert!(matches!(refused, LumpedError::Loose { motion: found, .. } if found == motion), "{motion}: {refused}");
    }
    // One support that holds against tilting holds the shaft, and teeth without a helix push nothing along the axis.
    let held: [Change; 2] = [
        |s| {
            s.shafts[0].supports.pop();
            s.shafts[0].supports[0].stiffness[3..5].fill(1e9);
        },
        |s| {
            s.meshes[0].geometry.helix_angle = 0.0;
            s.meshes[0].geometry.centre_distance *= 30f64.to_radians().cos();
            s.shafts[1].supports.iter_mut().for_each(|b| b.stiffness[2] = 0.0);
        },
    ];
    for change in held {
        let mut system = gearbox(100.0, 0.0);
        change(&mut system);
        ShaftMechanism::new(&system).unwrap();
    }
    let mut system = gearbox(100.0, 0.0);
    system.torques[1].torque *= 1.01;
    let model = ShaftMechanism::new(&system).unwrap();
    assert!(matches!(model.static_state(0.0), Err(LumpedError::NotBalanced { .. })));
    let text = serde_json::to_string(&system).unwrap();
    assert_eq!(serde_json::from_str::<ShaftSystem>(&text).unwrap(), system);
}
