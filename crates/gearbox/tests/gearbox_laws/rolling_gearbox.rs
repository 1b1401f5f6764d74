//! Gearboxes on rolling bearings: balance, search from play, and the springs that stand for them.

use std::f64::consts::TAU;

use gearbox::{
    Assembly, Bearing, Disc, GearboxError, GearboxPosition, Operation, Rotors, StaticGearbox, Structure, Torque,
    motion::{Drive, GearboxMechanism, MotionOptions, MotionPlan, Speed, SpringMesh},
    rolling_bearing::{AxialSetting, BallGeometry, RollerProfile, RollingBearing, RollingElements, Row},
};
use geometry::Sense;
use integrate::Scheme;
use lumped::Fourier;
use nalgebra::DMatrix;

use crate::pairs::{operation, springs, two_stages};
use crate::rolling::{balls_209, made, rollers};

/// Torque of the output, N mm.
const TORQUE: f64 = 4e5;
const LIGHT: f64 = 1e5;
const ROW: Row = Row { position: 0.0, thrust: 1.0 };
const TO_MINUS: Row = Row { position: 0.0, thrust: -1.0 };

fn deep_groove(play: f64) -> RollingBearing {
    made(RollingElements::Balls(balls_209()), &[ROW], play, AxialSetting::Clearance(0.0))
}

fn cylinders(play: f64) -> RollingBearing {
    let own = RollingElements::Rollers(rollers(0.0, RollerProfile::Logarithmic));
    made(own, &[ROW], play, AxialSetting::Clearance(0.0))
}

fn angular(row: Row, axial: AxialSetting) -> RollingBearing {
    let own = BallGeometry { contact_angle: 25f64.to_radians(), elements: 12, ..balls_209() };
    made(RollingElements::Balls(own), &[row], 0.0, axial)
}

fn cones(row: Row, axial: AxialSetting) -> RollingBearing {
    made(RollingElements::Rollers(rollers(14.0, RollerProfile::Logarithmic)), &[row], 0.0, axial)
}

/// The two stages on deep groove balls and cylindrical rollers, on an angular contact pair and on a tapered one.
fn on_rolling_bearings(play: f64, axial: AxialSetting) -> (Structure, Vec<gearbox::GearMesh>) {
    let (mut structure, meshes) = two_stages();
    let laws = [
        deep_groove(play),
        cylinders(play),
        angular(TO_MINUS, axial),
        angular(ROW, axial),
        cones(TO_MINUS, axial),
        cones(ROW, axial),
    ];
    for (bearing, law) in structure.bearings.iter_mut().zip(laws) {
        *bearing = Bearing::rolling(bearing.name.clone(), bearing.shaft, bearing.position, law);
    }
    (structure, meshes)
}

fn run(structure: &Structure, sense: Sense, torque: f64) -> Operation {
    operation(structure, 4, sense, vec![Torque { disc: 5, torque: -(sense.sign() as f64) * torque }])
}

fn solved(structure: &Structure, meshes: &[gearbox::GearMesh], torque: f64) -> GearboxPosition {
    let run = run(structure, Sense::Ccw, torque);
    let made = StaticGearbox::new(structure.clone(), meshes.to_vec(), run, springs);
    made.and_then(|mut g| g.solve(0.3)).unwrap_or_else(|e| panic!("{torque} N mm: {e}"))
}

/// Every body is in balance, in either sense, from a light touch to a heavy load, with play and with preload.
#[test]
fn trains_on_rolling_bearings_are_in_balance() {
    let settings = [
        (0.0, AxialSetting::Preload(200.0)),
        (0.02, AxialSetting::Clearance(0.03)),
        (0.1, AxialSetting::Clearance(0.2)),
        (-0.005, AxialSetting::Clearance(-0.005)),
    ];
    for (play, axial) in settings {
        let (structure, meshes) = on_rolling_bearings(play, axial);
        for sense in [Sense::Ccw, Sense::Cw] {
            for torque in [1.0, 1e3, TORQUE, 4e6] {
                let own = run(&structure, sense, torque);
                let mut gearbox = StaticGearbox::new(structure.clone(), meshes.clone(), own, springs).unwrap();
                for angle in [0.0, 0.7] {
                    let found = gearbox.solve(angle);
                    let found = found.unwrap_or_else(|e| panic!("{play} {axial:?} {sense:?} {torque}: {e}"));
                    let own = found.certificate;
                    let said = format!("{play} {axial:?} {sense:?} {torque}: {own:?}");
                    // Beside shafts this stiff that go through a play of 0.2 mm, hundredths of a newton have fewer
                    // digits.
                    assert!(own.body_balance < 1e-9 * (1e3 / torque).max(1.0), "{said}");
                    assert!(own.residual < 1e-6, "{said}");
                    let wanted = (sense.sign() as f64) * torque * (17.0 / 53.0) * (19.0 / 47.0);
                    let off = (found.input_torque / wanted - 1.0).abs();
                    assert!(off < 1e-9 * (1e3 / torque).max(1.0), "{said}: {}", found.input_torque);
                }
            }
        }
    }
}

/// Where a bearing stands, its own law gives the force that the balance counts.
#[test]
fn forces_of_bearings_are_those_of_their_laws() {
    let (structure, meshes) = on_rolling_bearings(0.02, AxialSetting::Preload(200.0));
    let found = solved(&structure, &meshes, TORQUE);
    for (i, bearing) in structure.bearings.iter().enumerate() {
        let state = found.rolling[i].unwrap();
        let d = nalgebra::Vector5::from_fn(|k, _| found.bearings[i].displacement[k]);
        let reply = bearing.law.as_ref().unwrap().evaluate(&d);
        for k in 0..3 {
            let off = (reply.force[k] - found.bearings[i].force[k]).abs();
            assert!(off < 1e-6 * reply.force.amax(), "{}: {off} N", bearing.name);
        }
        assert_eq!((reply.loaded, state.loaded > 0), (state.loaded, true), "{}", bearing.name);
        assert!(state.pressure > 100.0 && state.pressure < 4000.0, "{}: {} MPa", bearing.name, state.pressure);
    }
}

/// Springs about the loaded state stand where it stands, with its forces; a little more load moves both alike, to the
/// second order.
#[test]
fn springs_about_the_load_agree_to_the_second_order() {
    // Balls of preloaded pairs all carry: those that begin to would have a tangent without a derivative.
    let (mut structure, meshes) = two_stages();
    for (i, bearing) in structure.bearings.iter_mut().enumerate() {
        let law = angular([TO_MINUS, ROW][i % 2], AxialSetting::Preload(3000.0));
        *bearing = Bearing::rolling(bearing.name.clone(), bearing.shaft, bearing.position, law);
    }
    let base = solved(&structure, &meshes, LIGHT);
    assert!(base.rolling.iter().flatten().all(|r| r.loaded == 12), "some balls carry nothing");
    let linear = structure.about(std::slice::from_ref(&base)).unwrap();
    let place = |p: &GearboxPosition, s: usize| p.shafts[s].displacements.iter().flatten().copied().collect::<Vec<_>>();
    let apart = |a: &GearboxPosition, b: &GearboxPosition| {
        let of = |s| place(a, s).iter().zip(place(b, s)).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        (0..3).map(of).fold(0.0, f64::max)
    };
    let same = solved(&linear, &meshes, LIGHT);
    assert!(apart(&base, &same) < 1e-9, "{} mm", apart(&base, &same));
    for (a, b) in base.bearings.iter().zip(&same.bearings) {
        for k in 0..3 {
            assert!((a.force[k] - b.force[k]).abs() < 1e-5, "{} beside {} N", a.force[k], b.force[k]);
        }
    }
    let after = |share: f64| {
        let (law, springs) =
            (solved(&structure, &meshes, LIGHT * (1.0 + share)), solved(&linear, &meshes, LIGHT * (1.0 + share)));
        [apart(&law, &springs), apart(&law, &base)]
    };
    let ([once, way], [twice, _]) = (after(0.01), after(0.02));
    assert!(once < 0.02 * way, "springs are off by {once} of {way} mm");
    assert!((3.0..5.0).contains(&(twice / once)), "{twice} is not four times {once} mm");
}

/// A housing in series: its seats give way by the force over its stiffness, and a very stiff one is none.
#[test]
fn housings_are_in_series_with_rolling_bearings() {
    let (structure, meshes) = on_rolling_bearings(0.01, AxialSetting::Preload(200.0));
    let n = 6 * structure.bearings.len();
    let housed = |k: f64| {
        // Seats hold no turn about the axis, and the last bearing is a spring among the others.
        let own = DMatrix::from_fn(n, n, |i, j| match (i == j, i % 6) {
            (true, 0..3) => k,
            (true, 3 | 4) => 1e3 * k,
            _ => 0.0,
        });
        let mut all = Structure { housing: Some(own), ..structure.clone() };
        let last = &all.bearings[1];
        all.bearings[1] =
            Bearing::diagonal(last.name.clone(), last.shaft, last.position, [2e5, 2e5, 0.0, 0.0, 0.0, 0.0]);
        all
    };
    let soft = housed(2e5);
    let found = solved(&soft, &meshes, TORQUE);
    assert!(found.certificate.body_balance < 1e-9, "{:?}", found.certificate);
    for (i, bearing) in soft.bearings.iter().enumerate() {
        let (line, state) = (&found.shafts[bearing.shaft], &found.bearings[i]);
        let node = line.positions.iter().position(|z| (z - bearing.position).abs() < 1e-9).unwrap();
        for k in 0..3 {
            let seat = line.displacements[node][k] - state.displacement[k];
            // The bearing presses the seat the other way.
            let off = (2e5 * seat + state.force[k]).abs();
            assert!(off < 1e-6 * TORQUE / 50.0, "{}: {off} N", bearing.name);
        }
    }
    let stiff = solved(&housed(1e10), &meshes, TORQUE);
    let none = solved(&Structure { housing: None, ..housed(1e13) }, &meshes, TORQUE);
    for (a, b) in stiff.bearings.iter().zip(&none.bearings) {
        for k in 0..3 {
            assert!((a.force[k] - b.force[k]).abs() < 0.1, "{} beside {} N", a.force[k], b.force[k]);
        }
    }
    // The springs about the load stand in the same housing.
    let linear = solved(&soft.about(std::slice::from_ref(&found)).unwrap(), &meshes, TORQUE);
    for (a, b) in found.bearings.iter().zip(&linear.bearings) {
        assert!((a.force[0] - b.force[0]).abs() < 1e-4, "{} beside {} N", a.force[0], b.force[0]);
    }
}

/// What cannot be held is named: nothing takes the thrust, or it goes where no row takes it.
#[test]
fn shafts_that_nothing_holds_are_named() {
    let (mut structure, meshes) = two_stages();
    for i in [0, 1] {
        let own = &structure.bearings[i];
        structure.bearings[i] = Bearing::rolling(own.name.clone(), 0, own.position, cylinders(0.0));
    }
    let made = StaticGearbox::new(structure.clone(), meshes.clone(), run(&structure, Sense::Ccw, TORQUE), springs);
    let said = made.err().map(|e| e.to_string()).unwrap_or_default();
    assert!(said.contains("fast along z"), "{said}");
    structure.bearings[0] = Bearing::rolling("one way", 0, 10.0, angular(ROW, AxialSetting::Clearance(0.0)));
    let ends = [Sense::Ccw, Sense::Cw].map(|sense| {
        let made = StaticGearbox::new(structure.clone(), meshes.clone(), run(&structure, sense, TORQUE), springs);
        made.and_then(|mut g| g.solve(0.0))
    });
    let failed: Vec<_> = ends.iter().filter_map(|e| e.as_ref().err()).collect();
    assert_eq!(failed.len(), 1, "the thrust turns with the sense");
    assert!(matches!(failed[0], GearboxError::NoEquilibrium { .. }), "{}", failed[0]);
}

/// What swings is linear: a law is refused there, and springs about the load are taken.
#[test]
fn laws_do_not_swing() {
    let (structure, meshes) = on_rolling_bearings(0.0, AxialSetting::Preload(200.0));
    let refused = Rotors::new(Assembly::new(structure.clone()).unwrap()).err();
    assert!(matches!(refused, Some(GearboxError::NotLinear { .. })), "{refused:?}");
    assert!(structure.about(&[]).is_err());
    let base = solved(&structure, &meshes, TORQUE);
    let linear = structure.about(&[base]).unwrap();
    let modes = Rotors::new(Assembly::new(linear).unwrap()).unwrap();
    // Three shafts turn freely.
    let free = modes.modes_at_rest().frequencies.iter().filter(|w| **w == 0.0).count();
    assert_eq!(free, 3, "{:?}", &modes.modes_at_rest().frequencies[..6]);
}

/// Gears with mass on rolling bearings, in a housing that gives way where it is asked for.
fn heavy(play: f64, axial: AxialSetting, is_housed: bool) -> (Structure, Vec<gearbox::GearMesh>) {
    let (mut structure, meshes) = on_rolling_bearings(play, axial);
    for (disc, outer) in structure.discs.iter_mut().zip([53.0, 160.0, 58.0, 145.0, 80.0, 120.0]) {
        *disc = Disc::ring(disc.name.clone(), disc.shaft, disc.position, [outer, 30.0], 20.0, 7.85e-9);
    }
    let n = 6 * structure.bearings.len();
    let seat = |i: usize, j: usize| match (i == j, i % 6 < 3) {
        (true, true) => 3e5,
        (true, false) => 3e8,
        // Neighbours pull at each other.
        _ if i.abs_diff(j) == 6 && i % 6 < 3 => -5e4,
        _ => 0.0,
    };
    structure.housing = is_housed.then(|| DMatrix::from_fn(n, n, seat));
    (structure, meshes)
}

/// A mechanism on springs about `base`, meshes of a stiffness over the phase.
fn moving(
    structure: &Structure,
    meshes: &[gearbox::GearMesh],
    base: &GearboxPosition,
    (drive, torque): (Drive, f64),
    stiffness: &Fourier,
) -> GearboxMechanism {
    let linear = structure.about(std::slice::from_ref(base)).unwrap();
    let options = MotionOptions { drive, modal_damping: 0.02, limit: TAU * 3000.0 };
    let operation = run(&linear, Sense::Ccw, torque);
    GearboxMechanism::new(linear, meshes.to_vec(), operation, &options, |_, mesh, meshing| {
        Ok(Box::new(SpringMesh::new(mesh, meshing, stiffness.clone())?.with_damping(5.0)))
    })
    .unwrap()
}

fn plan([cycles, steps_per_cycle, steps_per_row]: [u64; 3]) -> MotionPlan {
    let (scheme, tolerance, stop_at_events, settle, shoots) = (Scheme::Energy, None, false, None, false);
    MotionPlan { scheme, cycles, steps_per_cycle, steps_per_row, tolerance, stop_at_events, settle, shoots }
}

/// A motion on springs about the load begins where the gearbox stands, in a housing that gives way, with its forces
/// and the energy of the law, and all of it is accounted for; so does one on the laws themselves.
#[test]
fn a_motion_begins_where_rolling_bearings_stand() {
    let (structure, meshes) = heavy(0.01, AxialSetting::Preload(200.0), true);
    let base = solved(&structure, &meshes, TORQUE);
    let stored: f64 = base.rolling.iter().flatten().map(|r| r.energy).sum();
    let seats = nalgebra::DVector::from_fn(6 * structure.bearings.len(), |i, _| {
        let (own, b) = (&structure.bearings[i / 6], &base.bearings[i / 6]);
        let shaft = &base.shafts[own.shaft];
        let node = shaft.positions.iter().position(|z| (z - own.position).abs() < 1e-9).unwrap();
        if i % 6 < 5 { shaft.displacements[node][i % 6] - b.displacement[i % 6] } else { 0.0 }
    });
    let housing = 0.5 * seats.dot(&(structure.housing.as_ref().unwrap() * &seats));
    let even = Fourier { mean: 4e5, cosine: Vec::new(), sine: Vec::new() };
    for by_laws in [false, true] {
        let drive = (Drive::Speed(Speed::Constant(50.0)), TORQUE);
        let mut mechanism = moving(&structure, &meshes, &base, drive, &even);
        if by_laws {
            mechanism = mechanism.with_rolling_bearings(&structure).unwrap();
        }
        let start = mechanism.start(0.02).unwrap();
        let mut rows = Vec::new();
        let done = mechanism.run(&start, &plan([1, 740, 100]), |instant| rows.push(instant.clone()));
        let energy = done.unwrap().energy;
        for row in &rows {
            for (a, b) in row.bearings.iter().zip(&base.bearings) {
                for k in 0..3 {
                    let off = (a.force[k] - b.force[k]).abs();
                    assert!(off < 1e-3, "{} beside {} N at {} s", a.force[k], b.force[k], row.time);
                    assert!((a.displacement[k] - b.displacement[k]).abs() < 1e-8, "{k}");
                }
            }
        }
        let off = energy.supports / (stored + housing) - 1.0;
        assert!(off.abs() < 1e-6, "{} beside {stored} and {housing} mJ", energy.supports);
        assert!(energy.relative_residual.abs() < 1e-9, "{energy:?}");
    }
}

/// At every instant of a vibration the force of a bearing is that of its law, seats balance it, and the energy of all is
/// accounted for: at given speed and under a given torque, with and without a housing. The springs that the mechanism
/// was made with, about another load, leave no trace.
#[test]
fn rolling_bearings_in_motion_follow_their_laws() {
    let uneven = Fourier { mean: 4e5, cosine: vec![1e5], sine: vec![4e4, 2e4] };
    let drives = [Drive::Speed(Speed::Constant(120.0)), Drive::Torque { start: 120.0, torque: None }];
    for (drive, is_housed) in drives.into_iter().flat_map(|d| [(d, false), (d, true)]) {
        let (structure, meshes) = heavy(0.02, AxialSetting::Preload(200.0), is_housed);
        let base = solved(&structure, &meshes, LIGHT);
        let mechanism = moving(&structure, &meshes, &base, (drive, TORQUE), &uneven);
        let mut mechanism = mechanism.with_rolling_bearings(&structure).unwrap();
        let start = mechanism.start(0.02).unwrap();
        let mut rows = Vec::new();
        let steps = plan([6, 60, 5]);
        let done = mechanism.run(&start, &steps, |instant| rows.push(instant.clone())).unwrap();
        let said = format!("{drive:?}, housing {is_housed}: {:?}", done.energy);
        assert!(done.energy.relative_residual.abs() < 1e-9, "{said}");
        let mut span = [f64::INFINITY, f64::NEG_INFINITY];
        for row in &rows {
            span = [span[0].min(row.bearings[0].force[0]), span[1].max(row.bearings[0].force[0])];
            for (bearing, state) in structure.bearings.iter().zip(&row.bearings) {
                let d = nalgebra::Vector5::from_fn(|k, _| state.displacement[k]);
                let reply = bearing.law.as_ref().unwrap().evaluate(&d);
                for k in 0..3 {
                    let off = (reply.force[k] - state.force[k]).abs();
                    assert!(off < 1e-8 * reply.force.amax().max(1.0), "{}: {off} N, {said}", bearing.name);
                }
            }
        }
        assert!(span[1] - span[0] > 8.0, "forces hardly change: {span:?} N, {said}");
    }
}

/// Turned slowly, a gearbox on rolling bearings goes through its positions at rest, whatever load the springs that it was
/// made with are about.
#[test]
fn slow_motion_on_rolling_bearings_goes_through_the_positions_at_rest() {
    let uneven = Fourier { mean: 4e5, cosine: vec![1e5], sine: vec![4e4, 2e4] };
    for is_housed in [false, true] {
        let (structure, meshes) = heavy(0.02, AxialSetting::Preload(200.0), is_housed);
        let base = solved(&structure, &meshes, LIGHT);
        let speed = 1e-3;
        let drive = (Drive::Speed(Speed::Constant(speed)), TORQUE);
        let mechanism = moving(&structure, &meshes, &base, drive, &uneven);
        let mut mechanism = mechanism.with_rolling_bearings(&structure).unwrap();
        let start = mechanism.start(0.02).unwrap();
        let mut rows = Vec::new();
        // What is left of the first steps dies out at once.
        let scheme = Scheme::GeneralisedAlpha { rho: 0.0 };
        let steps = MotionPlan { scheme, ..plan([1, 400, 40]) };
        mechanism.run(&start, &steps, |instant| rows.push(instant.clone())).unwrap();
        let own = run(&structure, Sense::Ccw, TORQUE);
        let mut at_rest = StaticGearbox::new(structure.clone(), meshes.clone(), own, |_, mesh, meshing| {
            Ok(Box::new(SpringMesh::new(mesh, meshing, uneven.clone())?))
        })
        .unwrap();
        for i in 0..2 {
            let (mut off, mut span) = (0.0f64, [f64::INFINITY, f64::NEG_INFINITY]);
            for row in &rows {
                let wanted = at_rest.solve(row.input[0]).unwrap().meshes[i].transmission_error;
                off = off.max((row.meshes[i].transmission_error - wanted).abs());
                span = [span[0].min(wanted), span[1].max(wanted)];
            }
            let share = off / (span[1] - span[0]);
            assert!(share < 1e-6, "mesh {i}, housing {is_housed}: {share:.1e} of the peak to peak");
        }
    }
}
