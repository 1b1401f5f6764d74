//! Laws of motion with the exact contact of the teeth, and with maps of it.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, sync::Arc, time::Instant};

use contact::{
    FlankProjection, Misalignment,
    pose::{gear_centre, gear_pose},
};
use dynamics::MeshFlanks;
use gearbox::{
    Disc, ExactMesh, GearMesh, GearboxError, MeshElement, Meshing, Operation, StaticGearbox, Structure, Torque,
    Vector12,
    motion::{
        ContactSpring, Drive, GearboxInstant, GearboxMechanism, GearboxRun, MapRequest, MappedMesh, MotionOptions,
        MovingExactMesh, MovingMesh, Speed,
    },
};
use geometry::{GearModifications, GearPair, Sense};
use integrate::Scheme;
use ltca::StaticOptions;
use nalgebra::Vector3;
use reduction::ElasticGear;

use crate::pairs::{operation, options, pair, reduced, single};

const TORQUE: f64 = 1.5e5;

/// A pair in shafts that bend, with its gears reduced.
struct Box1 {
    structure: Structure,
    meshes: Vec<GearMesh>,
    operation: Operation,
    gears: Arc<[ElasticGear; 2]>,
    options: StaticOptions,
    stands: Vec<Vector12>,
    cycles: Vec<f64>,
    mean_force: f64,
}

impl Box1 {
    fn new() -> Self {
        Self::of(pair([23, 31], 12.0))
    }

    fn of(gears: GearPair) -> Self {
        let mut structure = single(&gears, 0.3);
        for (i, outer) in [66.0, 90.0].into_iter().enumerate() {
            let d = &structure.discs[i];
            structure.discs[i] = Disc::ring(d.name.clone(), d.shaft, d.position, [outer, 30.0], 20.0, 7.85e-9);
        }
        let operation = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
        let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: gears.clone() }];
        let mut found = None;
        let mut made = |_: usize, mesh: &GearMesh, meshing: &Meshing| -> Result<Box<dyn MeshElement>, GearboxError> {
            let options = options(&mesh.pair, meshing, TORQUE);
            let gears = reduced(&mesh.pair, &options);
            let element = ExactMesh::new(mesh.pair.clone(), Arc::clone(&gears), options.clone())?;
            found = Some((gears, options));
            Ok(Box::new(element))
        };
        let mut rest = StaticGearbox::new(structure.clone(), meshes.clone(), operation.clone(), &mut made).unwrap();
        let positions: Vec<_> = (0..8).map(|i| rest.solve(TAU / 23.0 * f64::from(i) / 8.0).unwrap()).collect();
        let (gears, options) = found.unwrap();
        let stands = positions.iter().map(|p| Vector12::from(p.meshes[0].displacements)).collect();
        let cycles = positions.iter().map(|p| p.meshes[0].cycles).collect();
        let mean_force = positions.iter().map(|p| p.meshes[0].normal_force).sum::<f64>() / 8.0;
        Self { structure, meshes, operation, gears, options, stands, cycles, mean_force }
    }

    fn request(&self) -> MapRequest {
        MapRequest {
            coast_stands: Vec::new(),
            tilts: true,
            stands: self.stands.clone(),
            mean_force: self.mean_force,
            overload: 3.0,
            tolerance: 2e-3,
            worst: 2e-2,
        }
    }

    fn flanks(&self) -> MeshFlanks {
        MeshFlanks::new(&self.meshes[0].pair, Arc::clone(&self.gears), None, &self.options, 0.0).unwrap()
    }

    fn map(&self) -> MappedMesh {
        MappedMesh::new(&self.flanks(), &self.meshes[0].pair, &self.request(), &|_| {}).unwrap()
    }

    /// The contact in motion, its dampers 1 N s/mm along the normal of lines as long as under the mean force.
    fn moving(&self) -> MovingExactMesh {
        let (pair, gears) = (self.meshes[0].pair.clone(), Arc::clone(&self.gears));
        let length = self.spring().length;
        MovingExactMesh::new(pair, gears, None, &self.options, 1.0 / length).unwrap()
    }

    fn spring(&self) -> ContactSpring {
        ContactSpring::of(&mut self.exact(), &(self.stands.iter().sum::<Vector12>() / 8.0), 32).unwrap()
    }

    fn exact(&self) -> ExactMesh {
        ExactMesh::new(self.meshes[0].pair.clone(), Arc::clone(&self.gears), self.options.clone()).unwrap()
    }

    fn run(&self, element: Box<dyn MovingMesh>, cycles: u64) -> (Vec<GearboxInstant>, GearboxRun) {
        let drive = Drive::Speed(Speed::Constant(200.0));
        let options = MotionOptions { drive, modal_damping: 0.02, limit: TAU * 3000.0 };
        let mut element = Some(element);
        let (structure, meshes, operation) = (self.structure.clone(), self.meshes.clone(), self.operation.clone());
        let made = GearboxMechanism::new(structure, meshes, operation, &options, |_, _, _| Ok(element.take().unwrap()));
        let mut mechanism = made.unwrap();
        let start = mechanism.start(options.modal_damping).unwrap();
        let plan = crate::motion::steps(Scheme::Energy, [cycles, 50]);
        let mut rows = Vec::new();
        let began = Instant::now();
        let done = mechanism.run(&start, &plan, |instant| {
            rows.push(instant.clone());
        });
        println!("{:.0} us a step", 1e6 * began.elapsed().as_secs_f64() / (50 * cycles) as f64);
        (rows, done.unwrap())
    }
}

/// A map stands where the contact does, and moves as it does, to its own error; the energy of either is accounted for,
/// that of the map to round-off.
#[test]
fn a_mapped_mesh_moves_as_the_contact_that_it_was_made_from() {
    let box1 = Box1::new();
    let map = box1.map();
    let (told, deflection) =
        (map.maps().next().unwrap().certificate().rms_error_mm, map.maps().next().unwrap().certificate().deflection_mm);
    let mut map_at_rest = map.clone();
    let mut exact = box1.exact();
    for (i, d) in box1.stands.iter().enumerate() {
        let cycles = box1.cycles[i];
        let ask = |mesh: &mut dyn MeshElement| {
            mesh.go_to(cycles).unwrap();
            mesh.evaluate(d).unwrap()
        };
        let (mapped, true_one) = (ask(&mut map_at_rest), ask(&mut exact));
        let off = mapped.normal_force / true_one.normal_force - 1.0;
        assert!(off.abs() < 0.02, "{i}: force {} N beside {} N", mapped.normal_force, true_one.normal_force);
    }
    let (of_map, run) = box1.run(Box::new(map.with_damping(0.05)), 12);
    assert!(run.energy.relative_residual.abs() < 1e-9, "{:?}", run.energy);
    let reach = run.flanks[0].reach;
    assert!(reach > 0.2 && reach < 1.0, "{reach}");
    let (of_contact, run) = box1.run(Box::new(box1.moving()), 12);
    assert!(run.energy.relative_residual.abs() < 1e-7, "{:?}", run.energy);
    let errors = of_map.iter().zip(&of_contact);
    let off = errors.map(|(a, b)| (a.meshes[0].transmission_error - b.meshes[0].transmission_error).abs());
    let off = off.fold(0.0, f64::max);
    println!("map off by {told:.2e} of {deflection:.2e} mm, motions by {off:.2e} mm");
    assert!(off < 0.03 * deflection, "{off:.2e} mm, deflection {deflection:.2e} mm, error of the map {told:.2e} mm");
}

/// Pitch errors of both gears, mm: some -1 to 1 of an amount, different for every tooth.
fn with_pitch_errors(gears: &GearPair, amount: f64) -> GearPair {
    let wrong = |gear: &geometry::Gear, phase: f64| {
        let error = |i: u32| amount * (phase + 2.4 * f64::from(i * i)).sin();
        let pitch_errors = (0..gear.teeth()).map(error).collect();
        gear.clone().with_modifications(GearModifications { pitch_errors, ..GearModifications::default() }).unwrap()
    };
    GearPair::new(wrong(&gears.pinion, 0.3), wrong(&gears.wheel, 1.1), Some(gears.centre_distance())).unwrap()
}

/// Forces on a map with pitch errors are the slope of its energy, by displacements and by the phase, and its tangent is
/// theirs: where all pairs touch, where some have parted, and beyond the largest force.
#[test]
fn a_map_with_pitch_errors_has_one_energy() {
    let box1 = Box1::of(with_pitch_errors(&pair([23, 31], 12.0), 6e-3));
    let mut map = box1.map();
    let about = box1.stands.iter().sum::<Vector12>() / 8.0;
    let projection = FlankProjection::new(&box1.meshes[0].pair, box1.options.side());
    let deflection = map.maps().next().unwrap().certificate().deflection_mm;
    let mut ask = |cycles: f64, d: &Vector12| {
        map.go_to(cycles).unwrap();
        let reply = map.evaluate(d).unwrap();
        (reply, map.energy(), map.energy_rate())
    };
    for (cycles, further) in [(0.3, 0.0), (17.45, 0.6), (17.95, 0.3), (101.2, 0.4), (-5.6, 5.0)] {
        let mut at = about + projection.displacement(further * deflection, 0.0) - projection.displacement(0.0, 0.0);
        (at[3], at[10]) = (at[3] + 2e-5, at[10] - 1e-5);
        let (reply, _, rate) = ask(cycles, &at);
        assert!(reply.normal_force > 10.0, "{cycles}: {} N", reply.normal_force);
        let h = 1e-5;
        let by_phase = (ask(cycles + h, &at).1 - ask(cycles - h, &at).1) / (2.0 * h);
        let size = rate.abs().max(1e-2 * reply.normal_force * deflection);
        assert!((by_phase - rate).abs() < 1e-4 * size, "{cycles}: {by_phase} beside {rate} N mm a cycle");
        for i in 0..12 {
            let h = 1e-7;
            let moved = |sign: f64| {
                let mut d = at;
                d[i] += sign * h;
                d
            };
            let [(up, above, _), (down, below, _)] = [ask(cycles, &moved(1.0)), ask(cycles, &moved(-1.0))];
            let slope = (above - below) / (2.0 * h);
            let off = (slope + reply.force[i]).abs() / reply.force.fixed_rows::<3>(i / 3 * 3).norm();
            assert!(off < 1e-5, "{cycles}, {i}: dV/dd {slope} beside force {}", reply.force[i]);
            let wanted = reply.tangent.column(i);
            let off = ((up.force - down.force) / (2.0 * h) - wanted).norm() / wanted.norm();
            assert!(off < 1e-4, "{cycles}, {i}: tangent off by {off:.1e}");
        }
    }
}

/// A map with pitch errors of all teeth moves as the contact of these teeth, to the error that is told of it; pairs of
/// teeth come and go over more than a turn of the pinion.
#[test]
fn a_map_with_pitch_errors_moves_as_the_contact_of_these_teeth() {
    // Beside a deflection of 9 um: pairs that all touch, and pairs that part.
    for (amount, allowed) in [(2e-3, 0.02), (5e-3, 0.06)] {
        let box1 = Box1::of(with_pitch_errors(&pair([23, 31], 12.0), amount));
        let map = box1.map();
        let deflection = map.maps().next().unwrap().certificate().deflection_mm;
        let own = &box1.meshes[0].pair;
        let told = map.pitch_error(&box1.flanks(), own, &box1.request()).unwrap().unwrap();
        let (of_map, run) = box1.run(Box::new(map.with_damping(1.0 / box1.spring().length)), 40);
        assert!(run.energy.relative_residual.abs() < 1e-9, "{:?}", run.energy);
        let (of_contact, _) = box1.run(Box::new(box1.moving()), 40);
        let te = |rows: &[GearboxInstant]| rows.iter().map(|r| r.meshes[0].transmission_error).collect::<Vec<_>>();
        let (a, b) = (te(&of_map), te(&of_contact));
        let size = |x: &[f64]| {
            let mean = x.iter().sum::<f64>() / x.len() as f64;
            (x.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / x.len() as f64).sqrt()
        };
        let off: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - b).collect();
        let (rms, most) = (size(&off), off.iter().fold(0.0, |m: f64, e| m.max(e.abs())));
        println!(
            "errors up to {amount} mm: told rms {:.1e}, largest {:.1e}; motions off by rms {rms:.1e}, largest {most:.1e} of a ripple of {:.1e} mm; deflection {deflection:.1e} mm",
            told.rms_mm,
            told.largest_mm,
            size(&b)
        );
        assert!(rms < allowed * size(&b), "rms {rms:.1e} of a ripple of {:.1e} mm", size(&b));
        assert!(rms < 3.0 * told.rms_mm && told.rms_mm < allowed * deflection, "rms {rms:.1e} mm, told {told:?}");
    }
}

/// Both gears turned as one about the axis of a misaligned wheel stay as they are to each other: forces do no work, with
/// the wheel's moment about its own axis.
#[test]
fn turning_both_gears_about_a_misaligned_axis_takes_no_work() {
    let gears = pair([23, 31], 12.0);
    let structure = single(&gears, 0.0);
    let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: gears.clone() }];
    let train = gearbox::Train::new(&structure, &meshes, &[0.0; 4], 2, Sense::Ccw).unwrap();
    let mut options = options(&gears, &train.meshing()[0], TORQUE);
    let lean = Misalignment { in_plane_of_action: 0.03, across_plane_of_action: 0.05, ..Misalignment::default() };
    options.contact.offsets[1] = lean.wheel_offset(&gears, options.side());
    let axis = gear_pose(&gears, &options.contact, 1, 0.0).rotation * Vector3::z();
    assert!((1e-3..1e-2).contains(&axis.xy().norm()), "{axis}");
    let mut mesh = ExactMesh::new(gears.clone(), reduced(&gears, &options), options.clone()).unwrap();
    mesh.go_to(0.3).unwrap();
    let mut at = Vector12::zeros();
    at[11] = options.side().sign() * 0.04 / gears.wheel.base_radius();
    let reply = mesh.evaluate(&at).unwrap();
    let apart = gear_centre(&gears, &options.contact, 0) - gear_centre(&gears, &options.contact, 1);
    let mut turn = Vector12::zeros();
    turn.fixed_rows_mut::<3>(0).copy_from(&axis.cross(&apart));
    turn.fixed_rows_mut::<3>(3).copy_from(&axis);
    turn[11] = 1.0;
    let torque = reply.force[11];
    assert!(torque.abs() > 1e4, "{}", reply.force);
    // With the moment about z some 1e-3 would be left.
    let work = reply.force.dot(&turn) / torque;
    assert!(work.abs() < 1e-12, "{work:.1e} of the torque {torque:.3e} N mm");
    let slope = (reply.tangent * turn).norm() / reply.tangent.column(11).norm();
    assert!(slope < 1e-3, "forces change by {slope:.1e} of what a turn of the wheel alone does");
}

/// A spring made of the contact about the mean displacement answers there as the contact does at every phase, but for
/// the orders that it leaves out: forces, tilting moments and how they follow approach and tilt. So it moves like it as
/// long as forces stay near their mean.
#[test]
fn a_spring_of_the_contact_stands_for_it_near_its_load() {
    let box1 = Box1::new();
    let about = box1.stands.iter().sum::<Vector12>() / 8.0;
    let found = box1.spring();
    let train = gearbox::Train::new(&box1.structure, &box1.meshes, &[0.0; 4], 2, Sense::Ccw).unwrap();
    let mut spring = found.mesh(&box1.meshes[0], &train.meshing()[0]).unwrap();
    let mut exact = box1.exact();
    let projection = FlankProjection::new(&box1.meshes[0].pair, box1.options.side());
    let ways = [projection.displacement(1.0, 0.0), projection.displacement(0.0, 1.0)];
    for i in 0..16 {
        let ask = |mesh: &mut dyn MeshElement| {
            mesh.go_to(f64::from(i) / 16.0).unwrap();
            mesh.evaluate(&about).unwrap()
        };
        let (own, wanted) = (ask(&mut spring), ask(&mut exact));
        for (way, name) in ways.iter().zip(["force", "tilting moment"]) {
            // A moment is as large as the force on half the face width.
            let size = wanted.normal_force * if name == "force" { 1.0 } else { 10.0 };
            let off = (own.force - wanted.force).dot(way) / size;
            assert!(off.abs() < 0.02, "{i}: {name} off by {off:.1e}");
        }
        let size: Vec<f64> = ways.iter().map(|w| -w.dot(&(wanted.tangent * w))).collect();
        for (k, m) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let off = ways[k].dot(&((own.tangent - wanted.tangent) * ways[m])) / (size[k] * size[m]).sqrt();
            assert!(off.abs() < 0.05, "{i}: stiffness {k} {m} off by {off:.1e}");
        }
    }
    let (of_spring, run) = box1.run(Box::new(spring.with_damping(1.0)), 12);
    assert!(run.energy.relative_residual.abs() < 1e-9, "{:?}", run.energy);
    let (of_contact, _) = box1.run(Box::new(box1.moving()), 12);
    let errors = |rows: &[GearboxInstant]| rows.iter().map(|r| r.meshes[0].transmission_error).collect::<Vec<_>>();
    let (own, wanted) = (errors(&of_spring), errors(&of_contact));
    let mean = |x: &[f64]| x.iter().sum::<f64>() / x.len() as f64;
    let ripple = |x: &[f64]| (x.iter().map(|e| (e - mean(x)).powi(2)).sum::<f64>() / x.len() as f64).sqrt();
    println!(
        "spring {:.3e} mm, rms {:.3e}; contact {:.3e} mm, rms {:.3e}",
        mean(&own),
        ripple(&own),
        mean(&wanted),
        ripple(&wanted)
    );
    assert!(
        (mean(&own) / mean(&wanted) - 1.0).abs() < 5e-3,
        "mean DTE {:.3e} mm beside {:.3e} mm",
        mean(&own),
        mean(&wanted)
    );
    assert!(
        (ripple(&own) / ripple(&wanted) - 1.0).abs() < 0.05,
        "rms {:.3e} mm beside {:.3e} mm",
        ripple(&own),
        ripple(&wanted)
    );
}

/// Forces of a tilting spring are the slope of its energy, by displacements and by the phase, and its tangent is theirs.
#[test]
fn a_tilting_spring_has_one_energy() {
    let box1 = Box1::new();
    let about = box1.stands.iter().sum::<Vector12>() / 8.0;
    let found = box1.spring();
    let train = gearbox::Train::new(&box1.structure, &box1.meshes, &[0.0; 4], 2, Sense::Ccw).unwrap();
    let mut spring = found.mesh(&box1.meshes[0], &train.meshing()[0]).unwrap();
    let mut at = about;
    (at[3], at[10]) = (at[3] + 2e-4, at[10] - 1e-4);
    let mut ask = |cycles: f64, d: &Vector12| {
        spring.go_to(cycles).unwrap();
        let reply = spring.evaluate(d).unwrap();
        (reply, spring.energy(), spring.energy_rate())
    };
    let (reply, _, rate) = ask(0.3, &at);
    let h = 1e-4;
    let by_phase = (ask(0.3 + h, &at).1 - ask(0.3 - h, &at).1) / (2.0 * h);
    assert!((by_phase / rate - 1.0).abs() < 1e-4, "{by_phase} beside {rate} N mm a cycle");
    for i in 0..12 {
        let h = 1e-6;
        let moved = |sign: f64| {
            let mut d = at;
            d[i] += sign * h;
            d
        };
        let [(up, above, _), (down, below, _)] = [ask(0.3, &moved(1.0)), ask(0.3, &moved(-1.0))];
        let slope = (above - below) / (2.0 * h);
        let off = (slope + reply.force[i]).abs() / reply.force.fixed_rows::<3>(i / 3 * 3).norm();
        assert!(off < 1e-6, "coordinate {i}: dV/dd {slope} beside force {}", reply.force[i]);
        let off =
            ((up.force - down.force) / (2.0 * h) - reply.tangent.column(i)).norm() / reply.tangent.column(i).norm();
        assert!(off < 1e-6, "coordinate {i}: tangent off by {off:.1e}");
    }
}
