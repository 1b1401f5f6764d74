//! Laws of double helical gears: two halves of opposite hand on a shaft that no bearing holds along its axis.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, sync::Arc};

use gearbox::{
    Bearing, Disc, ExactMesh, GearMesh, GearboxPosition, MeshElement, Meshing, Operation, StaticGearbox, Structure,
    Torque,
    motion::{Drive, GearboxInstant, GearboxMechanism, MotionOptions, MovingExactMesh, Speed},
};
use geometry::{GearPair, Sense};
use integrate::Scheme;
use reduction::ElasticGear;

use crate::pairs::{LinearMesh, of_widths, operation, options, reduced, shaft, spring};

/// Torque of the output, N mm.
const TORQUE: f64 = 2e5;
const TEETH: [u32; 2] = [21, 32];
const HELIX: f64 = 25.0;
/// Middles of the halves on their shafts, and that of both, mm.
const HALVES: [f64; 2] = [38.0, 62.0];
const MIDDLE: f64 = 50.0;

/// Shafts, bearings and gears alike on both sides of the middle, where torques act and where shaft `a` is held along z.
#[derive(Clone, Copy)]
struct Box2 {
    /// Radial stiffness of bearings, N/mm, and diameter of shafts, mm.
    stiff: f64,
    thick: f64,
    /// Axial stiffness of the bearings of shaft `b`, N/mm.
    axial: f64,
    /// Turns of the right half of gear 1 and gear 2 against the left ones, rad.
    keys: [f64; 2],
    held: bool,
}

const BENDING: Box2 = Box2 { stiff: 3e5, thick: 30.0, axial: 0.0, keys: [0.0; 2], held: false };

impl Box2 {
    /// Discs: gears 1 and 2 of the left half, of the right half, input, output.
    fn parts(self) -> (Structure, Vec<GearMesh>, Operation) {
        // Faces of the wheel are wider: a float along the axis does not change what meshes.
        let pairs = [HELIX, -HELIX].map(|helix| of_widths(TEETH, helix, [20.0, 24.0]));
        let both = |s: usize| {
            [10.0, 90.0].map(|z| {
                let k = self.stiff;
                let axial = if s == 1 { self.axial } else { 0.0 };
                Bearing::diagonal(format!("{s} at {z}"), s, z, [k, k, axial, 1e7, 1e7, 0.0])
            })
        };
        let gear = |name: &str, s: usize, z: f64| {
            let outer = if s == 0 { 70.0 } else { 105.0 };
            Disc::ring(name, s, z, [outer, 30.0], 20.0, 7.85e-9)
        };
        let structure = Structure {
            shafts: vec![
                shaft("a", [0.0; 3], 100.0, self.thick),
                shaft("b", [pairs[0].centre_distance(), 0.0, 0.0], 100.0, self.thick),
            ],
            discs: vec![
                gear("a left", 0, HALVES[0]),
                gear("b left", 1, HALVES[0]),
                gear("a right", 0, HALVES[1]),
                gear("b right", 1, HALVES[1]),
                gear("input", 0, MIDDLE),
                gear("output", 1, MIDDLE),
            ],
            bearings: [0, 1]
                .into_iter()
                .flat_map(both)
                .chain([Bearing::diagonal("a along z", 0, MIDDLE, [0.0, 0.0, self.stiff, 0.0, 0.0, 0.0])])
                .collect(),
            ..Structure::default()
        };
        let mut run = operation(&structure, 4, Sense::Ccw, vec![Torque { disc: 5, torque: TORQUE }]);
        (run.keys[2], run.keys[3]) = (self.keys[0], self.keys[1]);
        if self.held {
            run.held = vec![0, 1];
        }
        let mesh = |(name, (discs, pair)): (&str, ([usize; 2], GearPair))| GearMesh { name: name.into(), discs, pair };
        let all = ["left", "right"].into_iter().zip([[0, 1], [2, 3]].into_iter().zip(pairs));
        (structure, all.map(mesh).collect(), run)
    }

    fn springs(self, of: impl Fn(usize, LinearMesh) -> LinearMesh) -> GearboxPosition {
        let (structure, meshes, run) = self.parts();
        let made = StaticGearbox::new(structure, meshes, run, |i, mesh, meshing| {
            Ok(Box::new(of(i, spring(mesh, meshing))) as Box<dyn MeshElement>)
        });
        made.and_then(|mut gearbox| gearbox.solve(0.0)).unwrap_or_else(|e| panic!("{e}"))
    }

    /// With exact contacts, gears set as their keys say, and the gears of both meshes.
    fn exact(self) -> (StaticGearbox, Vec<Arc<[ElasticGear; 2]>>) {
        let (structure, meshes, run) = self.parts();
        let mut gears = Vec::new();
        let made = StaticGearbox::new(structure, meshes, run, |_, mesh, meshing| {
            let own = keyed(&mesh.pair, meshing);
            let both = reduced(&mesh.pair, &own);
            gears.push(Arc::clone(&both));
            Ok(Box::new(ExactMesh::new(mesh.pair.clone(), both, own)?) as Box<dyn MeshElement>)
        });
        (made.unwrap_or_else(|e| panic!("{e}")), gears)
    }

    /// In motion with exact contacts, row by row.
    fn moving(self, gears: &[Arc<[ElasticGear; 2]>], speed: f64, scheme: Scheme) -> (Vec<GearboxInstant>, f64) {
        let (structure, meshes, run) = self.parts();
        let drive = Drive::Speed(Speed::Constant(speed));
        let asked = MotionOptions { drive, modal_damping: 0.02, limit: TAU * 4000.0 };
        let mut mechanism = GearboxMechanism::new(structure, meshes, run, &asked, |i, mesh, meshing| {
            let (pair, gears) = (mesh.pair.clone(), Arc::clone(&gears[i]));
            Ok(Box::new(MovingExactMesh::new(pair, gears, None, &keyed(&mesh.pair, meshing), 0.01)?))
        })
        .unwrap_or_else(|e| panic!("{e}"));
        let start = mechanism.start(asked.modal_damping).unwrap();
        let mut rows = Vec::new();
        let plan = crate::motion::steps(scheme, [2, 40]);
        let done = mechanism.run(&start, &plan, |instant| rows.push(instant.clone())).unwrap();
        (rows, done.energy.relative_residual)
    }
}

fn keyed(pair: &GearPair, meshing: &Meshing) -> ltca::StaticOptions {
    options(pair, meshing, 0.5 * TORQUE).with_contact(|c| c.wheel_turn = -meshing.timing)
}

/// Displacement of shaft `b` along its axis in the middle between its bearings, mm.
fn floats(bearings: &[gearbox::BearingState]) -> f64 {
    0.5 * (bearings[2].displacement[2] + bearings[3].displacement[2])
}

/// Halves that are mirror images of each other stand as such: no axial motion, and as much load on either, to 1e-9.
#[test]
fn equal_halves_do_not_move_along_the_axis() {
    let (mut gearbox, _) = BENDING.exact();
    for angle in [0.0, 0.07, 0.2] {
        let found = gearbox.solve(angle).unwrap_or_else(|e| panic!("{e}"));
        let [left, right] = [0, 1].map(|i| &found.meshes[i]);
        let off = floats(&found.bearings).abs() / left.transmission_error;
        println!("{angle}: {off:.1e} of {:.2} um along the axis", 1e3 * left.transmission_error);
        assert!(off < 1e-9, "{angle}: {off:e} along the axis");
        assert!((left.normal_force / right.normal_force - 1.0).abs() < 1e-9, "{angle}");
        assert!((left.transmission_error / right.transmission_error - 1.0).abs() < 1e-9, "{angle}");
        let thrust = left.force[1][2];
        assert!(
            thrust.abs() > 0.3 * left.normal_force && (thrust + right.force[1][2]).abs() < 1e-9 * left.normal_force
        );
        assert!(found.certificate.body_balance < 1e-9, "{:?}", found.certificate);
    }
}

/// A double helical gear is two halves side by side: its transmission error is that of a half under half the torque.
#[test]
fn a_half_under_half_the_torque_errs_alike() {
    let (mut whole, gears) = Box2 { held: true, ..BENDING }.exact();
    for side in 0..2 {
        let (structure, meshes, mut run) = Box2 { held: true, ..BENDING }.parts();
        run.torques[0].torque *= 0.5;
        let mut half = StaticGearbox::new(structure, vec![meshes[side].clone()], run, |_, mesh, meshing| {
            let own = keyed(&mesh.pair, meshing);
            Ok(Box::new(ExactMesh::new(mesh.pair.clone(), Arc::clone(&gears[side]), own)?))
        })
        .unwrap();
        for angle in [0.0, 0.05, 0.1, 0.22] {
            let [all, one] = [&mut whole, &mut half].map(|own| own.solve(angle).unwrap());
            let off = all.meshes[side].transmission_error / one.meshes[0].transmission_error - 1.0;
            assert!(off.abs() < 1e-9, "half {side} at {angle}: {off:e}");
            assert!((all.meshes[side].normal_force / one.meshes[0].normal_force - 1.0).abs() < 1e-9);
        }
    }
}

/// An error of the apex, a right half that is ahead of the left one by e along the normal: a shaft that floats makes up for it
/// along its axis, and both halves carry the same; one that is held leaves all of it to the teeth.
///
/// ```text
/// floating: z = e/(2 sin b_b), F_left = F_right,   held: F_right - F_left = k e
/// ```
/// Rigid bearings and shafts: to what 1e9 N/mm and 1 m in diameter give way.
#[test]
fn a_floating_shaft_makes_up_for_the_apex() {
    let e = 3e-3;
    let ahead = |i: usize, own: LinearMesh| LinearMesh { excess: if i == 1 { e } else { 0.0 }, ..own };
    let rigid = Box2 { stiff: 1e9, thick: 1e3, ..BENDING };
    let (_, meshes, _) = rigid.parts();
    let sin = meshes[0].pair.base_helix_angle().sin();
    let found = rigid.springs(ahead);
    let even = rigid.springs(|_, own| own);
    let z = floats(&found.bearings);
    println!("{z:.6} mm for {:.6}, {:.1} N", e / (2.0 * sin), found.meshes[0].normal_force);
    assert!((z.abs() * 2.0 * sin / e - 1.0).abs() < 1e-5, "{z} mm");
    for (own, without) in found.meshes.iter().zip(&even.meshes) {
        let off = own.normal_force / without.normal_force - 1.0;
        assert!(off.abs() < 1e-9, "{} N, off by {off:e}", own.normal_force);
    }
    assert!(floats(&even.bearings).abs() < 1e-12);
    let held = Box2 { axial: 1e12, ..rigid }.springs(ahead);
    let more = held.meshes[1].normal_force - held.meshes[0].normal_force;
    let stiffness = 4e5;
    assert!((more / (stiffness * e) - 1.0).abs() < 1e-3, "{more} N beside {}", stiffness * e);
    let sum = held.meshes[0].normal_force + held.meshes[1].normal_force;
    assert!((sum / (2.0 * even.meshes[0].normal_force) - 1.0).abs() < 1e-9, "{sum} N");
    // The same by a key: flanks as thick as nominal, the right wheel set ahead by the angle.
    let turn = e / (meshes[0].pair.wheel.base_radius() * meshes[0].pair.base_helix_angle().cos());
    let (mut exact, _) = Box2 { keys: [0.0, turn], ..BENDING }.exact();
    let (mut alike, _) = BENDING.exact();
    for angle in [0.0, 0.1] {
        let [found, even] = [&mut exact, &mut alike].map(|own| own.solve(angle).unwrap_or_else(|e| panic!("{e}")));
        let z = floats(&found.bearings);
        let [left, right] = [0, 1].map(|i| found.meshes[i].force[1][2]);
        println!("{angle}: {z:.6} mm for {:.6}", e / (2.0 * sin));
        // Tooth forces follow the places of the load on faces that lean: a few per cent.
        assert!((z.abs() * 2.0 * sin / e - 1.0).abs() < 0.05, "{angle}: {z} mm");
        assert!((left + right).abs() < 1e-9 * left.abs(), "{angle}: {left} and {right} N along the axis");
        let off = found.meshes[0].normal_force / even.meshes[0].normal_force - 1.0;
        assert!(off.abs() < 1e-3, "{angle}: {off:e}");
    }
}

/// In motion a floating shaft does not move along its axis between equal halves, to 1e-9; with the halves staggered by half a
/// pitch it does, and, slowly, as it does at rest. Energy is accounted for.
#[test]
fn staggered_halves_move_their_shaft_to_and_fro() {
    let (mut rest, gears) = BENDING.exact();
    let (rows, residual) = BENDING.moving(&gears, 200.0, Scheme::Energy);
    let error = rest.solve(0.0).unwrap().meshes[0].transmission_error;
    let most = rows.iter().map(|row| floats(&row.bearings).abs()).fold(0.0, f64::max);
    println!("equal halves: {:.1e} of the error along the axis, energy {residual:.1e}", most / error);
    assert!(most < 1e-9 * error, "{most} mm along the axis, {error} mm of error");
    assert!(residual.abs() < 1e-6, "{residual:e}");

    let half_pitch = TEETH.map(|z| 0.5 * TAU / f64::from(z));
    let staggered = Box2 { keys: [half_pitch[0], -half_pitch[1]], ..BENDING };
    let (mut rest, gears) = staggered.exact();
    let cycles = rest.train().cycles(0.0);
    let apart = (cycles[1] - cycles[0]).rem_euclid(1.0);
    assert!((apart - 0.5).abs() < 1e-9, "halves are {apart} cycles apart");
    let (rows, _) = staggered.moving(&gears, 1.0, Scheme::GeneralisedAlpha { rho: 0.0 });
    let still: Vec<f64> = rows.iter().map(|row| floats(&rest.solve(row.input[0]).unwrap().bearings)).collect();
    let span = still.iter().fold(0.0f64, |most, z| most.max(z.abs()));
    println!("staggered: up to {:.4} um along the axis", 1e3 * span);
    assert!(span > 1e-3 * error, "{span} mm along the axis");
    // Dampers, and the step from rest.
    for (row, wanted) in rows.iter().zip(&still) {
        let found = floats(&row.bearings);
        assert!((found - wanted).abs() < 2e-2 * span, "{}: {found} beside {wanted} mm", row.time);
    }
    let (_, residual) = staggered.moving(&gears, 200.0, Scheme::Energy);
    assert!(residual.abs() < 1e-6, "{residual:e}");
}
