//! Laws of motion of gears that keep elastic modes.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, sync::Arc};

use gearbox::{
    Disc, ExactMesh, GearMesh, GearboxError, Operation, StaticGearbox, Structure, Torque, Train, elastic_gears,
    motion::{
        Drive, GearVibration, GearboxInstant, GearboxMechanism, GearboxRun, MotionOptions, MotionPlan, MovingExactMesh,
        Speed,
    },
};
use geometry::{Gear, GearData, GearPair, Sense};
use integrate::{Scheme, Settle};
use reduction::{ElasticGear, GearModes, ModeChoice};

use crate::pairs::{operation, options, reduced, shaft, single};

const TORQUE: f64 = 5e4;
/// Damping of contact lines, N s/mm^2.
const DAMPING: f64 = 0.01;

/// A thin disc: module 3 mm, face of 7 mm.
fn thin(teeth: u32, helix_deg: f64) -> Gear {
    let helix = helix_deg.to_radians();
    let data = GearData { teeth, helix_angle: helix, face_width: 7.0, bore_diameter: 24.0, ..GearData::default() };
    Gear::new(data).unwrap()
}

/// Gears on shafts with what their motion is made of.
struct Elastic {
    structure: Structure,
    meshes: Vec<GearMesh>,
    run: Operation,
    gears: Vec<Arc<[ElasticGear; 2]>>,
    modes: Vec<Option<Arc<GearModes>>>,
}

impl Elastic {
    /// So many modes of each gear; gears as heavy as their teeth and bodies, and somewhat more.
    fn new(mut structure: Structure, meshes: Vec<GearMesh>, run: Operation, count: usize) -> Self {
        for mesh in &meshes {
            for (disc, gear) in mesh.discs.into_iter().zip([&mesh.pair.pinion, &mesh.pair.wheel]) {
                let seat = structure.discs[disc].clone();
                let size = [2.0 * gear.tip_radius(), 24.0];
                structure.discs[disc] = Disc::ring(seat.name, seat.shaft, seat.position, size, 7.0, 7.85e-9);
            }
        }
        let train = Train::new(&structure, &meshes, &run.keys, run.input, run.sense).unwrap();
        let one = |(mesh, meshing): (&GearMesh, _)| reduced(&mesh.pair, &options(&mesh.pair, meshing, TORQUE));
        let gears: Vec<_> = meshes.iter().zip(train.meshing()).map(one).collect();
        let modes = elastic_gears(&structure, &meshes, &gears, |r| r.modes(ModeChoice::Count(count))).unwrap();
        Self { structure, meshes, run, gears, modes }
    }

    /// A pair on two shafts that bend.
    fn pair(count: usize) -> Self {
        let pair = GearPair::new(thin(23, 12.0), thin(31, -12.0), None).unwrap();
        let structure = single(&pair, 0.7);
        let run = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
        Self::new(structure, vec![GearMesh { name: "pair".into(), discs: [0, 1], pair }], run, count)
    }

    /// A gear between two others, in mesh with both.
    fn idler(count: usize) -> Self {
        let pairs = [[20, 31], [31, 23]].map(|[a, b]| GearPair::new(thin(a, 0.0), thin(b, 0.0), None).unwrap());
        let [a, b] = [0, 1].map(|i| pairs[i].centre_distance());
        let places = [[0.0; 3], [a, 0.0, 0.0], [a + b * f64::cos(1.0), b * f64::sin(1.0), 0.0]];
        let bearings = (0..3).flat_map(|s| [10.0, 90.0].map(|z| (s, z)));
        let structure = Structure {
            shafts: places.iter().map(|at| shaft("a shaft", *at, 100.0, 30.0)).collect(),
            discs: (0..3).map(|s| Disc::seat(format!("gear {s}"), s, 50.0)).collect(),
            bearings: bearings.map(|(s, z)| crate::pairs::bearing("a bearing", s, z, 1e5)).collect(),
            ..Structure::default()
        };
        let mut run = operation(&structure, 0, Sense::Ccw, vec![Torque { disc: 2, torque: -TORQUE }]);
        run.keys = vec![0.0, 0.01, 0.0];
        let meshes = pairs.into_iter().zip([[0, 1], [1, 2]]);
        let meshes = meshes.map(|(pair, discs)| GearMesh { name: format!("{discs:?}"), discs, pair }).collect();
        Self::new(structure, meshes, run, count)
    }

    fn at_rest(&self) -> StaticGearbox {
        let parts = (self.structure.clone(), self.meshes.clone(), self.run.clone());
        StaticGearbox::new(parts.0, parts.1, parts.2, |i, mesh, meshing| {
            let options = options(&mesh.pair, meshing, TORQUE);
            Ok(Box::new(ExactMesh::new(mesh.pair.clone(), Arc::clone(&self.gears[i]), options)?))
        })
        .unwrap()
    }

    /// In motion, with modes of a damping ratio or without.
    fn moving(&self, drive: Drive, modes: Option<f64>) -> Result<GearboxMechanism, GearboxError> {
        let asked = MotionOptions { drive, modal_damping: 0.0, limit: TAU * 3000.0 };
        let parts = (self.structure.clone(), self.meshes.clone(), self.run.clone());
        GearboxMechanism::new(parts.0, parts.1, parts.2, &asked, |i, mesh, meshing| {
            let (pair, gears) = (mesh.pair.clone(), Arc::clone(&self.gears[i]));
            let plain = MovingExactMesh::new(pair, gears, None, &options(&mesh.pair, meshing, TORQUE), DAMPING)?;
            let Some(damping_ratio) = modes else { return Ok(Box::new(plain)) };
            let kept = mesh.discs.map(|disc| self.modes[disc].clone().unwrap());
            Ok(Box::new(plain.with_modes(kept.map(|modes| GearVibration { modes, damping_ratio }))?))
        })
    }
}

fn at(speed: f64) -> Drive {
    Drive::Speed(Speed::Constant(speed))
}

fn plan(scheme: Scheme, [steps, cycles]: [u64; 2]) -> MotionPlan {
    crate::motion::steps(scheme, [cycles, steps])
}

/// Motion from the equilibrium on.
fn run(
    mut mechanism: GearboxMechanism,
    scheme: Scheme,
    steps: [u64; 2],
    damping: f64,
) -> (Vec<GearboxInstant>, GearboxRun) {
    let start = mechanism.start(damping).unwrap();
    let plan = plan(scheme, steps);
    let mut rows = Vec::new();
    let done = mechanism.run(&start, &plan, |instant| rows.push(instant.clone())).unwrap();
    (rows, done)
}

/// Largest differences of transmission errors and bearing forces from those at rest, over the largest at rest.
fn off_rest(rows: &[GearboxInstant], rest: &mut StaticGearbox) -> [f64; 2] {
    let (mut off, mut sizes) = ([0.0f64; 2], [0.0f64; 2]);
    for row in rows {
        let wanted = rest.solve(row.input[0]).unwrap();
        let errors = row.meshes.iter().map(|m| m.transmission_error);
        let errors = errors.zip(wanted.meshes.iter().map(|m| m.transmission_error));
        let forces = row.bearings.iter().zip(&wanted.bearings);
        let forces = forces.flat_map(|(a, b)| (0..3).map(|k| (a.force[k], b.force[k])));
        let of_kind = |(kind, (a, b)): (usize, (f64, f64))| {
            off[kind] = off[kind].max((a - b).abs());
            sizes[kind] = sizes[kind].max(b.abs());
        };
        errors.map(|own| (0, own)).chain(forces.map(|own| (1, own))).for_each(of_kind);
    }
    [off[0] / sizes[0], off[1] / sizes[1]]
}

/// Modes without inertia are the compliance they were taken out of: a motion begins in the equilibrium of gears without modes, and
/// goes slowly through those equilibria.
///
/// In motion the contact knows places of flanks to 1e-6 of the deflection, theory (46a).
#[test]
fn slow_motion_with_modes_is_at_rest() {
    let own = Elastic::pair(10);
    let (mechanism, plain) = (own.moving(at(0.2), Some(0.0)).unwrap(), own.moving(at(0.2), None).unwrap());
    let modes: usize = own.modes.iter().flatten().map(|m| m.count()).sum();
    assert_eq!(mechanism.count(), plain.count() + modes);
    let (rows, _) = run(mechanism, Scheme::GeneralisedAlpha { rho: 0.0 }, [48, 1], 0.0);
    let rows: Vec<_> = rows.into_iter().step_by(8).collect();
    let begun = off_rest(&rows[..1], &mut own.at_rest());
    let slow = off_rest(&rows, &mut own.at_rest());
    println!("at the start {begun:?}, slow {slow:?} off those at rest");
    assert!(begun.iter().all(|off| *off < 1e-8), "at the start: {begun:?}");
    assert!(slow.iter().all(|off| *off < 1e-5), "{slow:?}");
}

/// A gear in two meshes has one set of modes, in the frame of whichever mesh is told first: the order of meshes changes nothing,
/// and the energy is accounted for.
#[test]
fn a_gear_in_two_meshes_has_its_modes_once() {
    let own = Elastic::idler(10);
    let mut turned = Elastic::idler(10);
    turned.meshes.reverse();
    turned.gears.reverse();
    let both =
        [&own, &turned].map(|own| run(own.moving(at(200.0), Some(0.01)).unwrap(), Scheme::Energy, [64, 2], 0.01));
    let [(a, done), (b, _)] = &both;
    let force =
        |rows: &[GearboxInstant], mesh: usize| rows.iter().map(|r| r.meshes[mesh].normal_force).collect::<Vec<_>>();
    let off = |mesh: usize| {
        let (x, y) = (force(a, mesh), force(b, 1 - mesh));
        x.iter().zip(&y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / x[0]
    };
    let left = done.energy.relative_residual;
    println!("{left:.1e} left over, meshes in the other order {:.1e} and {:.1e} apart", off(0), off(1));
    assert!(left.abs() < 1e-9, "{:?}", done.energy);
    assert!(off(0).max(off(1)) < 1e-7, "{:.1e} and {:.1e} apart", off(0), off(1));
}

/// Whatever drives, the energy of a motion with modes is accounted for; and they change the motion.
#[test]
fn energy_with_modes_is_accounted_for() {
    let own = Elastic::pair(10);
    let speed = 250.0;
    let drives = [
        at(speed),
        Drive::Balanced(Speed::Constant(speed)),
        Drive::Torque { start: speed, torque: None },
        Drive::Speed(Speed::Ramp { from: speed, to: 1.1 * speed, start: 0.0, duration: 1e-2 }),
    ];
    for drive in drives {
        let (rows, done) = run(own.moving(drive, Some(0.01)).unwrap(), Scheme::Energy, [64, 5], 0.01);
        let (plain, _) = run(own.moving(drive, None).unwrap(), Scheme::Energy, [64, 5], 0.01);
        let force = |rows: &[GearboxInstant]| rows.iter().map(|r| r.meshes[0].normal_force).collect::<Vec<_>>();
        let [a, b] = [force(&rows), force(&plain)];
        let moved = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / b[0];
        let left = done.energy.relative_residual;
        println!("{drive:?}: {left:.1e} left over; modes change forces by {moved:.3} of the first");
        assert!(left.abs() < 1e-9, "{drive:?}: {:?}", done.energy);
        assert!(moved > 1e-3, "{drive:?}: modes change nothing");
    }
}

/// The torque that keeps the speed does the work that the ledger has for it.
#[test]
fn the_input_torque_does_the_work_of_the_ledger() {
    let own = Elastic::pair(6);
    let (rows, done) = run(own.moving(at(250.0), Some(0.02)).unwrap(), Scheme::Energy, [256, 4], 0.02);
    let trapezium =
        |w: &[GearboxInstant]| 0.5 * (w[0].input_torque * w[0].input[1] + w[1].input_torque * w[1].input[1]);
    let work: f64 = rows.windows(2).map(|w| trapezium(w) * (w[1].time - w[0].time)).sum();
    println!("work of the input {work:.4} mJ, in the ledger {:.4} mJ", done.energy.input_work);
    assert!((work / done.energy.input_work - 1.0).abs() < 1e-4, "{work} mJ, {} mJ", done.energy.input_work);
}

/// A motion with modes settles: what comes then repeats itself cycle by cycle, though the gears' own frames turn on.
#[test]
fn a_motion_with_modes_settles() {
    let own = Elastic::pair(6);
    let mut mechanism = own.moving(at(120.0), Some(0.05)).unwrap();
    let start = mechanism.start(0.05).unwrap();
    let settle = Some(Settle { tolerance: 1e-6, most: 400 });
    let plan = MotionPlan { settle, ..plan(Scheme::GeneralisedAlpha { rho: 0.8 }, [32, 2]) };
    let mut errors = Vec::new();
    let done = mechanism.run(&start, &plan, |row| errors.push(row.meshes[0].transmission_error)).unwrap();
    let [low, high] = errors.iter().fold([f64::MAX, f64::MIN], |[l, h], x| [l.min(*x), h.max(*x)]);
    let off = (0..32).map(|i| (errors[i] - errors[i + 32]).abs()).fold(0.0, f64::max) / (high - low);
    println!("{} cycles of waiting, then {off:.1e} of the peak to peak from cycle to cycle", done.warm_up);
    assert!(done.warm_up < 400 && off < 1e-5, "{} cycles, {off:.1e}", done.warm_up);
}

/// Amplitudes of modes come back in frames that have turned on by teeth; turned back, a period maps a motion onto itself.
/// Newton's method on that leads to where waiting leads to, for a pair and for a gear in two meshes.
///
/// The contact knows places of flanks to 1e-6 of the deflection, theory (46a): three gears repeat themselves to no better than
/// some 1e-7.
#[test]
fn shooting_with_modes_finds_what_waiting_finds() {
    let all = [("pair", Elastic::pair(6), 1e-7, 1e-8), ("idler", Elastic::idler(4), 1e-6, 1e-5)];
    for (name, own, tolerance, bound) in all {
        let [waited, shot] = [false, true].map(|shoots| {
            let mut mechanism = own.moving(at(120.0), Some(0.05)).unwrap();
            let start = mechanism.start(0.05).unwrap();
            let settle = Some(Settle { tolerance, most: 200 });
            let plan = MotionPlan { settle, shoots, ..plan(Scheme::Energy, [32, 1]) };
            let mut errors = Vec::new();
            let done = mechanism.run(&start, &plan, |row| errors.push(row.meshes[0].transmission_error)).unwrap();
            (done.warm_up, errors)
        });
        let [low, high] = waited.1.iter().fold([f64::MAX, f64::MIN], |[l, h], x| [l.min(*x), h.max(*x)]);
        let off = waited.1.iter().zip(&shot.1).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / (high - low);
        println!("{name}: {} cycles waited, {} with shooting; {off:.1e} of the peak to peak apart", waited.0, shot.0);
        assert!(waited.0 < 200 && shot.0 < waited.0, "{name}: {} cycles waited, {} with shooting", waited.0, shot.0);
        assert!(off < bound, "{name}: {off:.1e} of the peak to peak apart");
    }
}

/// Gears lighter than what their modes move, and a gear with modes in one of two meshes, are refused.
#[test]
fn modes_that_cannot_be_are_refused() {
    let mut own = Elastic::pair(6);
    own.structure.discs[1].mass = 1e-7;
    let light = own.moving(at(1.0), Some(0.0)).err().unwrap();
    assert!(matches!(&light, GearboxError::LessThanModes { gear, .. } if gear == "wheel"), "{light}");
    let own = Elastic::idler(4);
    let asked = MotionOptions { drive: at(1.0), modal_damping: 0.0, limit: TAU * 3000.0 };
    let parts = (own.structure.clone(), own.meshes.clone(), own.run.clone());
    let lone = GearboxMechanism::new(parts.0, parts.1, parts.2, &asked, |i, mesh, meshing| {
        let (pair, gears) = (mesh.pair.clone(), Arc::clone(&own.gears[i]));
        let plain = MovingExactMesh::new(pair, gears, None, &options(&mesh.pair, meshing, TORQUE), 0.0)?;
        let kept = mesh.discs.map(|disc| own.modes[disc].clone().unwrap());
        let kept = kept.map(|modes| GearVibration { modes, damping_ratio: 0.0 });
        Ok(Box::new(if i == 0 { plain.with_modes(kept)? } else { plain }))
    });
    let lone = lone.err().unwrap();
    assert!(matches!(&lone, GearboxError::NoModes { gear, .. } if gear == "gear 1"), "{lone}");
}
