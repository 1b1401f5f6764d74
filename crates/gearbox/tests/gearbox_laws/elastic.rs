//! Gears that keep their elastic modes in a vibration.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, sync::Arc};

use gearbox::{
    Assembly, Component, Disc, ElasticBody, ExactMesh, GearMesh, GearboxError, Held, MeshElement, MeshExcitation,
    MeshSample, Operation, Rotors, StaticGearbox, Structure, Torque, Train, Vibration, elastic_gears, own_cycle,
    turn_levers,
};
use geometry::{Gear, GearData, GearPair, Sense};
use nalgebra::{Complex, DMatrix, DVector};
use reduction::{ElasticGear, GearModes, ModeChoice};

use crate::pairs::{operation, options, reduced, single};

const TORQUE: f64 = 5e4;

/// Thin discs: module 3 mm, faces of 7 mm.
fn thin(teeth: [u32; 2], helix_deg: f64) -> GearPair {
    let gear = |i: usize| {
        let helix = [helix_deg, -helix_deg][i].to_radians();
        let data = GearData {
            teeth: teeth[i],
            helix_angle: helix,
            face_width: 7.0,
            bore_diameter: 24.0,
            ..GearData::default()
        };
        Gear::new(data).unwrap()
    };
    GearPair::new(gear(0), gear(1), None).unwrap()
}

/// A pair on two shafts with all that its vibration is made of.
struct Box_ {
    structure: Structure,
    meshes: Vec<GearMesh>,
    run: Operation,
    train: Train,
    gears: Arc<[ElasticGear; 2]>,
    modes: Vec<Option<Arc<GearModes>>>,
}

impl Box_ {
    /// The wheel stands in a `direction`; so many modes of each gear.
    fn new(pair: &GearPair, direction: f64, count: usize) -> Self {
        let mut structure = single(pair, direction);
        for (i, gear) in [&pair.pinion, &pair.wheel].into_iter().enumerate() {
            let seat = structure.discs[i].clone();
            // Somewhat more than teeth and body have: they are steel.
            let size = [2.0 * gear.tip_radius(), 24.0];
            structure.discs[i] = Disc::ring(seat.name, seat.shaft, seat.position, size, 7.0, 7.85e-9);
        }
        let run = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
        let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: pair.clone() }];
        let train = Train::new(&structure, &meshes, &run.keys, run.input, run.sense).unwrap();
        let gears = reduced(pair, &options(pair, &train.meshing()[0], TORQUE));
        let all = std::slice::from_ref(&gears);
        let modes = elastic_gears(&structure, &meshes, all, |r| r.modes(ModeChoice::Count(count))).unwrap();
        Self { structure, meshes, run, train, gears, modes }
    }

    /// The contact of the gears without modes.
    fn exact(&self) -> ExactMesh {
        let own = options(&self.meshes[0].pair, &self.train.meshing()[0], TORQUE);
        ExactMesh::new(self.meshes[0].pair.clone(), Arc::clone(&self.gears), own).unwrap()
    }

    /// The mesh through its cycle, with modes or without.
    fn samples(&self, positions: usize, elastic: bool) -> (Vec<MeshSample>, Vec<f64>) {
        let made = StaticGearbox::new(self.structure.clone(), self.meshes.clone(), self.run.clone(), |_, _, _| {
            let modes = [0, 1].map(|disc| self.modes[disc].clone().unwrap());
            Ok(Box::new(if elastic { self.exact().with_modes(modes)? } else { self.exact() }) as Box<dyn MeshElement>)
        });
        own_cycle(&mut made.unwrap(), 0, positions, || {}).unwrap()
    }

    fn vibration(&self, positions: usize, elastic: bool) -> Result<Vibration, GearboxError> {
        let (samples, errors) = self.samples(positions, elastic);
        let turns = turn_levers(&self.meshes[0], &self.train.meshing()[0]).unwrap();
        let excitation = MeshExcitation::new(&samples, &errors, positions / 2, turns).unwrap();
        let modes = if elastic { &self.modes[..] } else { &[] };
        let parts = (&self.meshes[..], &self.train, self.run.sense);
        let held = Held { shafts: Vec::new(), turns: vec![2] };
        Vibration::with_modes(self.structure.clone(), parts, vec![excitation], modes, &held)
    }
}

/// Modes that answer at once are no modes: condensed out of the tangent they leave that of the gears at rest, with the same
/// forces, at every place of the cycle.
#[test]
fn modes_at_rest_leave_the_contact_as_it_is() {
    let own = Box_::new(&thin([23, 31], 12.0), 0.7, 10);
    let squares: Vec<f64> = own.modes[..2].iter().flat_map(|m| m.as_ref().unwrap().squares().to_vec()).collect();
    let (samples, _) = own.samples(5, true);
    for sample in &samples {
        let modal = sample.modal.as_ref().unwrap();
        let m = squares.len();
        let rest = sample.reply.force;
        let off = (0..12).map(|k| (modal.force[k] - rest[k]).abs()).fold(0.0, f64::max) / rest.amax();
        let deflects = (0..m).map(|j| squares[j] * modal.amplitudes[j] - modal.force[12 + j]).map(f64::abs);
        let size = modal.force.rows(12, m).amax();
        let left = deflects.fold(0.0, f64::max) / size;
        let within =
            DMatrix::from_diagonal(&DVector::from_column_slice(&squares)) - modal.tangent.view((12, 12), (m, m));
        let by_modes = within.lu().solve(&modal.tangent.view((12, 0), (m, 12)).into_owned()).unwrap();
        let condensed = modal.tangent.view((0, 0), (12, 12)) + modal.tangent.view((0, 12), (12, m)) * by_modes;
        // Newton's method at rest ends with the tangent of a step before: asked again.
        let mut alone = own.exact();
        alone.go_to(sample.cycles).unwrap();
        let again = alone.evaluate(&sample.displacements).unwrap();
        let wanted = DMatrix::from_column_slice(12, 12, again.tangent.as_slice());
        let tangent = (&condensed - &wanted).amax() / wanted.amax();
        let share = 1.0 - wanted[(5, 5)] / modal.tangent[(5, 5)];
        println!(
            "{:.2} cycles: forces {off:.1e}, modes {left:.1e}, tangent {tangent:.1e}; modes have {share:.2} of the compliance",
            sample.cycles
        );
        assert!(off < 1e-8 && left < 1e-8 && tangent < 1e-6, "{off:e} {left:e} {tangent:e}");
        assert!(share > 0.05, "modes have to matter: {share}");
    }
}

/// Few modes of spur gears have next to no part in the deflection, those along the axis none: they find their equilibrium all
/// the same, and forces are those without modes.
#[test]
fn modes_that_no_load_excites_find_their_equilibrium() {
    let pair = thin([20, 50], 0.0);
    for count in [1, 3, 6] {
        let own = Box_::new(&pair, 0.0, count);
        for sample in &own.samples(5, true).0 {
            let (modal, rest) = (sample.modal.as_ref().unwrap(), sample.reply.force);
            let off = (0..12).map(|k| (modal.force[k] - rest[k]).abs()).fold(0.0, f64::max) / rest.amax();
            assert!(off < 1e-8, "{count} modes, {:.2} cycles: forces differ by {off:e}", sample.cycles);
        }
    }
}

/// At hardly any speed gears with modes move as rigid ones do: all elasticity is at rest. Near their frequencies they do
/// not, and the box has lower frequencies than with rigid gears.
#[test]
fn slow_vibration_does_not_know_of_modes() {
    let own = Box_::new(&thin([23, 61], 0.0), 0.0, 12);
    let [elastic, rigid] = [true, false].map(|elastic| own.vibration(9, elastic).unwrap());
    let answer = |of: &Vibration, speed: f64| of.harmonics(speed, 0.02).unwrap()[0].clone();
    let off = |speed: f64| {
        let [a, b] = [answer(&elastic, speed), answer(&rigid, speed)].map(|x| x.displacements);
        let gears = [0, 1].map(|disc| rigid.rotors().assembly().disc(disc).unwrap());
        let of = |x: &DVector<Complex<f64>>| DVector::from_fn(12, |i, _| x[gears[i / 6] + i % 6]);
        (of(&a) - of(&b)).norm() / of(&b).norm()
    };
    let lowest = own.modes[1].as_ref().unwrap().frequencies_hz()[0];
    let at = |hz: f64| TAU * hz / 23.0;
    let [slow, fast] = [off(at(1e-3 * lowest)), off(at(0.5 * lowest))];
    println!("first mode of the wheel {lowest:.0} Hz: a thousandth of it {slow:.1e}, half of it {fast:.2}");
    // Frequencies count by their squares.
    assert!(slow < 1e-4, "{slow:e}");
    assert!(fast > 0.02, "{fast}");
    let frequencies = |of: &Vibration| of.rotors().modes_at_rest().frequencies.clone();
    let (with, without) = (frequencies(&elastic), frequencies(&rigid));
    assert!(with[7] < 0.97 * without[7], "{} and {} rad/s", with[7], without[7]);
}

/// Fewer coordinates answer as all of them do, modes of gears among them.
#[test]
fn few_coordinates_have_the_modes_of_gears() {
    let own = Box_::new(&thin([23, 41], 10.0), 0.3, 8);
    let whole = own.vibration(5, true).unwrap();
    let few = whole.reduced(8e4).unwrap();
    let count = |of: &Vibration| of.rotors().modes_at_rest().frequencies.len();
    assert!(count(&few) < count(&whole), "{} of {}", count(&few), count(&whole));
    for speed in [50.0, 400.0] {
        let [a, b] = [&whole, &few].map(|of| of.harmonics(speed, 0.02).unwrap()[0].mesh_forces[0]);
        assert!((a - b).norm() < 1e-3 * a.norm(), "{speed} rad/s: {a} and {b}");
    }
}

/// The direction in which a pair stands changes no natural frequency: patterns turn with the line of centres. Bearings and
/// shafts are the same in all directions here.
#[test]
fn a_box_turned_about_has_the_same_frequencies() {
    let pair = thin([23, 31], 12.0);
    let found = [0.0, 1.1].map(|direction| {
        let mut own = Box_::new(&pair, direction, 10);
        for bearing in &mut own.structure.bearings {
            bearing.stiffness[(1, 1)] = bearing.stiffness[(0, 0)];
            bearing.stiffness[(4, 4)] = bearing.stiffness[(3, 3)];
        }
        // Tooth 0 of the pinion stands as it did beside the line of centres.
        own.run.keys[0] = direction;
        own.train = Train::new(&own.structure, &own.meshes, &own.run.keys, 2, Sense::Ccw).unwrap();
        own.vibration(3, true).unwrap().rotors().modes_at_rest().frequencies.clone()
    });
    for (i, (a, b)) in found[0].iter().zip(&found[1]).take(40).enumerate() {
        assert!((a / b - 1.0).abs() < 1e-6, "frequency {i}: {a} and {b} rad/s");
    }
}

/// A disc in bending that spins is met in space at omega + n W and omega - n W: its material moves along the axis alone.
/// In-plane motion, which is turned by Coriolis forces, is met less far apart.
#[test]
fn spinning_discs_have_waves_that_travel() {
    let pair = thin([23, 61], 0.0);
    let own = Box_::new(&pair, 0.0, 14);
    let modes = own.modes[1].as_ref().unwrap();
    let mut structure = Structure { bodies: vec![ElasticBody::new(1, modes, 0.0)], ..own.structure.clone() };
    structure.elastic_meshes.clear();
    // Both shafts held: the wheel's modes are its own.
    let held = Held { shafts: vec![0, 1], turns: vec![2, 3] };
    let rotors = Rotors::holding(Assembly::new(structure).unwrap(), &held).unwrap();
    let speed = 60.0;
    let found = rotors.whirl_modes(&[-speed * 61.0 / 23.0, speed]).unwrap();
    let hz: Vec<f64> = modes.frequencies_hz();
    let waves = modes.waves().unwrap();
    let mut travelling = 0;
    for j in (0..modes.count()).filter(|&j| waves[j] > 0 && j + 1 < modes.count() && waves[j + 1] == waves[j]) {
        if (hz[j + 1] / hz[j] - 1.0).abs() > 1e-6 {
            continue;
        }
        let apart = f64::from(waves[j]) * speed;
        let near = |wanted: f64| found.modes.iter().map(|m| (m.frequency - wanted).abs()).fold(f64::INFINITY, f64::min);
        let off = near(TAU * hz[j] + apart).max(near(TAU * hz[j] - apart)) / apart;
        println!("{} waves, {:.0} Hz: off by {off:.3} of n W", waves[j], hz[j]);
        travelling += usize::from(off < 0.03);
    }
    assert!(travelling >= 3, "{travelling} pairs of modes travel with their gear");
    for mode in &found.modes {
        assert!(mode.decay.abs() < 1e-6 * mode.frequency, "spin takes no energy: {}", mode.decay);
        assert_eq!(mode.energy.strain.len(), mode.energy.strain.iter().filter(|s| s.share > -1e-9).count());
        let body: f64 = mode.energy.strain.iter().filter(|s| s.component == Component::Body(1)).map(|s| s.share).sum();
        assert!((body - 1.0).abs() < 1e-6, "the gear alone is strained: {body}");
    }
}

/// Energy of a mode is in its parts, gear bodies among them, and the answer solves the equation of motion.
#[test]
fn energy_and_equation_of_motion_hold_with_modes() {
    let own = Box_::new(&thin([23, 41], 10.0), 0.3, 8);
    let box_ = own.vibration(5, true).unwrap();
    let (rotors, speeds) = (box_.rotors(), box_.speeds(300.0));
    for mode in rotors.whirl_modes(&speeds).unwrap().modes.iter().take(25) {
        for shares in [&mode.energy.strain, &mode.energy.kinetic] {
            let sum: f64 = shares.iter().map(|s| s.share).sum();
            assert!((sum - 1.0).abs() < 1e-6, "{} rad/s: {sum}", mode.frequency);
        }
    }
    let assembly = rotors.assembly();
    let mut force = DVector::zeros(assembly.size());
    (0..2).for_each(|g| force[assembly.disc(g).unwrap() + g] = Complex::new(100.0, 30.0 * g as f64));
    let last = assembly.size() - 1;
    force[last] = Complex::from(1e3);
    for frequency in [500.0, 2e4] {
        let x = rotors.response(&speeds, frequency, 0.0, &force).unwrap();
        let parts = [x.map(|x| x.re), x.map(|x| x.im)];
        let dynamic = assembly.stiffness() - frequency * frequency * assembly.mass();
        let rates = frequency * (assembly.damping() + assembly.gyroscopic(&speeds).unwrap());
        let left = [&dynamic * &parts[0] - &rates * &parts[1], &dynamic * &parts[1] + &rates * &parts[0]];
        // The input does not turn: what holds it is no force of the answer.
        let input = assembly.disc(2).unwrap() + 5;
        for (i, f) in force.iter().enumerate().filter(|(i, _)| *i != input) {
            let off = (left[0][i] - f.re).abs().max((left[1][i] - f.im).abs());
            assert!(off < 1e-3, "{frequency} rad/s, coordinate {i}: {off} is left over");
        }
    }
}

/// A pair alone: shafts that only turn. Gears have modes there as well.
#[test]
fn a_pair_alone_has_modes_of_its_gears() {
    let own = Box_::new(&thin([23, 61], 0.0), 0.0, 12);
    let (samples, errors) = own.samples(3, true);
    let turns = turn_levers(&own.meshes[0], &own.train.meshing()[0]).unwrap();
    let excitation = MeshExcitation::new(&samples, &errors, 1, turns).unwrap();
    let held = Held { shafts: vec![0, 1], turns: Vec::new() };
    let parts = (&own.meshes[..], &own.train, own.run.sense);
    let made = Vibration::with_modes(own.structure.clone(), parts, vec![excitation], &own.modes, &held).unwrap();
    let found = &made.rotors().modes_at_rest().frequencies;
    let modes: usize = own.modes[..2].iter().map(|m| m.as_ref().unwrap().count()).sum();
    assert_eq!(found.len(), 2 + modes, "both turns and all modes");
    assert_eq!(found.iter().filter(|w| **w == 0.0).count(), 1, "the train turns on");
}

/// What does not fit is refused: a mass below that of the modes, a motion in time, a part of a gear.
#[test]
fn modes_that_do_not_fit_are_refused() {
    let mut own = Box_::new(&thin([23, 31], 0.0), 0.0, 12);
    own.structure.discs[1].polar_inertia *= 0.1;
    let error = own.vibration(3, true).unwrap_err();
    assert!(matches!(&error, GearboxError::LessThanModes { gear, .. } if gear == "wheel"), "{error}");
    assert!(error.hint().is_some());
    let body = ElasticBody::new(1, own.modes[1].as_ref().unwrap(), 0.0);
    let twice = Structure { bodies: vec![body.clone(), body], ..Box_::new(&thin([23, 31], 0.0), 0.0, 12).structure };
    assert!(matches!(Assembly::new(twice), Err(GearboxError::Count { .. })));
}
