//! The exact contact of elastic gears in a gearbox.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::sync::Arc;

use ale::Station;
use gearbox::{
    Bearing, ExactMesh, GearMesh, GearboxPosition, MeshElement, StaticGearbox, Structure, Torque, Train, Vector12,
    face_load_factor, line_load,
};
use geometry::{FlankModification, GearModifications, GearPair, Sense};
use ltca::StaticModel;
use reduction::ElasticGear;

use crate::pairs::{of_widths, operation, options, pair, reduced, single, two_stages};

const TORQUE: f64 = 2e5;

/// Gears of one mesh, reduced once.
type Reduced = std::cell::RefCell<Vec<Option<Arc<[ElasticGear; 2]>>>>;

fn exact(
    structure: Structure,
    meshes: Vec<GearMesh>,
    run: gearbox::Operation,
    gears: &Reduced,
    friction: f64,
) -> StaticGearbox {
    let made = StaticGearbox::new(structure, meshes, run, |i, mesh, meshing| {
        let own = options(&mesh.pair, meshing, TORQUE).with_contact(|c| c.friction = friction);
        let mut known = gearbox_gears(gears, i);
        let gears = known.get_or_insert_with(|| reduced(&mesh.pair, &own)).clone();
        Ok(Box::new(ExactMesh::new(mesh.pair.clone(), gears, own)?) as Box<dyn MeshElement>)
    });
    made.unwrap_or_else(|e| panic!("{e}"))
}

fn gearbox_gears(gears: &Reduced, i: usize) -> std::cell::RefMut<'_, Option<Arc<[ElasticGear; 2]>>> {
    std::cell::RefMut::map(gears.borrow_mut(), |all| {
        all.resize(all.len().max(i + 1), None);
        &mut all[i]
    })
}

fn one(pair: &GearPair) -> Vec<GearMesh> {
    vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: pair.clone() }]
}

/// Input angle at which mesh 0 has gone through some cycles.
fn angle_at(gearbox: &StaticGearbox, cycles: f64) -> f64 {
    let [a, b] = [0.0, 1.0].map(|angle| gearbox.train().cycles(angle)[0]);
    (cycles - a) / (b - a)
}

/// Shafts held, the gearbox is the pair alone: transmission error, forces, moments and pressure to 1e-9, whichever gear
/// drives, in either sense, wherever the wheel stands, and with friction.
#[test]
fn held_shafts_leave_the_pair_alone() {
    let pair = pair([21, 32], 20.0);
    for run in [(2, Sense::Ccw, 0.0), (2, Sense::Cw, 0.0), (3, Sense::Ccw, 0.0), (2, Sense::Ccw, 1.9)] {
        is_the_pair_alone(&pair, run, 0.0);
        is_the_pair_alone(&pair, run, 0.07);
    }
}

/// The same of gears of two face widths at two heights.
#[test]
fn gears_at_two_heights_are_the_pair_with_that_offset() {
    for offset in [4.0, -7.5] {
        let pair = of_widths([21, 32], 20.0, [26.0, 20.0]).with_mid_face_offset(offset).unwrap();
        for run in [(2, Sense::Ccw, 0.0), (3, Sense::Cw, -0.7)] {
            is_the_pair_alone(&pair, run, 0.0);
        }
    }
}

/// Positions must be those that the pair is made for.
#[test]
fn other_heights_are_refused() {
    let pair = pair([21, 32], 20.0).with_mid_face_offset(2.0).unwrap();
    let mut structure = single(&pair, 0.0);
    structure.discs[1].position += 1.5;
    let run = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
    let error = gearbox::Train::new(&structure, &one(&pair), &run.keys, run.input, run.sense).unwrap_err();
    let told = error.to_string();
    assert!(told.contains("1.5 mm above") && told.contains("made for 2 mm"), "{told}");
    assert!(error.hint().is_some());
}

/// One run: input disc, sense, direction of the wheel.
fn is_the_pair_alone(pair: &GearPair, (input, sense, direction): (usize, Sense, f64), friction: f64) {
    let mut structure = single(pair, direction);
    structure.discs[1].position += pair.mid_face_offset();
    let driven = if input == 2 { 1 } else { 0 };
    // The torque is on the other shaft, which turns against the input.
    let torque = sense.sign() as f64 * TORQUE;
    let mut run = operation(&structure, input, sense, vec![Torque { disc: driven, torque }]);
    run.held = vec![0, 1];
    let gears = Reduced::default();
    let mut gearbox = exact(structure, one(pair), run, &gears, friction);
    let own = options(pair, &gearbox.train().meshing()[0], TORQUE).with_contact(|c| c.friction = friction);
    let gears = gearbox_gears(&gears, 0).clone().unwrap();
    let mut alone = StaticModel::new(pair.clone(), gears, own).unwrap();
    for cycles in [0.05, 0.3, 0.5, 0.8, 1.15] {
        let found = gearbox.solve(angle_at(&gearbox, cycles)).unwrap_or_else(|e| panic!("{e}"));
        let wanted = alone.advance(Station::at_cycles(found.meshes[0].cycles), |_| ()).unwrap();
        let mesh = &found.meshes[0];
        let at = format!("input {input}, {sense:?}, direction {direction}, friction {friction}, {cycles} cycles");
        let off = mesh.transmission_error / wanted.transmission_error - 1.0;
        println!("{at}: transmission error off by {off:.1e}, {:?}", found.certificate);
        assert!(off.abs() < 1e-9, "{at}: transmission error {off:.1e}");
        let normal: f64 = wanted.pairs.iter().map(|p| p.normal_force).sum();
        let (sin, cos) = direction.sin_cos();
        for g in 0..2 {
            let [x, y, z] = mesh.force[g];
            let own = [cos * x + sin * y, cos * y - sin * x, z];
            for (axis, own) in own.iter().enumerate() {
                let off = (own - wanted.wrench[g].force[axis]).abs() / normal;
                assert!(off < 1e-9, "{at}: force {axis} on gear {g}: {off:.1e}");
            }
            let [x, y, z] = mesh.moment[g];
            let own = [cos * x + sin * y, cos * y - sin * x, z];
            for (axis, own) in own.iter().enumerate() {
                let off = (own - wanted.wrench[g].moment[axis]).abs() / TORQUE;
                assert!(off < 1e-9, "{at}: moment {axis} on gear {g}: {off:.1e}");
            }
        }
        let pressure = mesh.slices.iter().map(|s| s.pressure).fold(0.0, f64::max);
        assert!((pressure / wanted.max_pressure - 1.0).abs() < 1e-9, "{at}: pressure {pressure}");
    }
}

fn flexible(pair: &GearPair, structure: Structure, gears: &Reduced, cycles: &[f64]) -> Vec<GearboxPosition> {
    let run = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
    let mut gearbox = exact(structure, one(pair), run, gears, 0.0);
    cycles.iter().map(|c| gearbox.solve(angle_at(&gearbox, *c)).unwrap_or_else(|e| panic!("{e}"))).collect()
}

/// Shafts and bearings a thousand times stiffer are a thousand times nearer to the pair alone: the difference goes as
/// their compliance.
#[test]
fn stiff_shafts_come_near_the_pair_alone_as_their_compliance_falls() {
    let pair = pair([21, 32], 20.0);
    let gears = Reduced::default();
    let stiffer = |factor: f64| {
        let mut structure = single(&pair, 0.0);
        structure.bearings.iter_mut().for_each(|b: &mut Bearing| b.stiffness *= factor);
        for shaft in &mut structure.shafts {
            for piece in &mut shaft.pieces {
                let steel = fem::Material::new(2.06e5 * factor, 0.3, 7.85e-9).unwrap();
                piece.section = fem::beam::BeamSection::new(40.0, 0.0, steel).unwrap();
            }
        }
        flexible(&pair, structure, &gears, &[0.3])[0].meshes[0].transmission_error
    };
    let mut run = operation(&single(&pair, 0.0), 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
    run.held = vec![0, 1];
    let mut held = exact(single(&pair, 0.0), one(&pair), run, &gears, 0.0);
    let alone = held.solve(angle_at(&held, 0.3)).unwrap().meshes[0].transmission_error;
    let [soft, stiff] = [1e3, 1e6].map(|factor| stiffer(factor) - alone);
    assert!(soft > 0.0 && soft < 0.05 * alone, "{soft} of {alone}");
    // The load moves over the width as the gears lean, which is a part of a per cent here.
    assert!((stiff / soft * 1e3 - 1.0).abs() < 0.02, "{stiff} and {soft}");
}

/// A pinion overhung on a thin shaft leans: the load goes to one end of the face, K_Hbeta rises, and the sign of the
/// misalignment is that of where the load lies. All bodies are in balance.
#[test]
fn an_overhung_pinion_presses_with_one_end_of_its_face() {
    let pair = pair([21, 32], 0.0);
    let gears = Reduced::default();
    let cycles: Vec<f64> = (0..6).map(|i| f64::from(i) / 6.0).collect();
    let between = flexible(&pair, single(&pair, 0.0), &gears, &cycles);
    let mut overhung = single(&pair, 0.0);
    // Bearings before the gears, which sit at 60 mm.
    (overhung.bearings[1].position, overhung.bearings[0].position) = (38.0, 5.0);
    let leaning = flexible(&pair, overhung, &gears, &cycles);
    for p in between.iter().chain(&leaning) {
        assert!(p.certificate.body_balance < 1e-9 && p.certificate.residual < 1e-9, "{:?}", p.certificate);
        assert!(p.certificate.iterations < 15, "{:?}", p.certificate);
    }
    let [even, uneven] = [&between, &leaning].map(|p| face_load_factor(p, 0, 16).unwrap());
    assert!(uneven > even + 0.1, "K_Hbeta {even} between bearings, {uneven} overhung");
    println!("K_Hbeta {even:.3} between bearings, {uneven:.3} overhung");
    let lean = leaning[2].meshes[0].misalignment_in_plane;
    let load = line_load(&leaning, 0);
    let (low, high) = (load[0].1, load[load.len() - 1].1);
    assert!((lean > 0.0) == (low > high), "the gap opens by {lean} mm towards +z: {low} N/mm below, {high} above");
    // Opposite forces on both gears.
    for p in &leaning {
        let m = &p.meshes[0];
        (0..3).for_each(|k| assert!((m.force[0][k] + m.force[1][k]).abs() < 1e-9 * m.normal_force));
    }
}

/// Two stages of exact contacts: balance of all bodies, torques by the teeth to what tilted axes leave of it.
#[test]
fn two_stages_of_exact_contacts_are_in_balance() {
    let (structure, meshes) = two_stages();
    let run = operation(&structure, 4, Sense::Ccw, vec![Torque { disc: 5, torque: -TORQUE }]);
    let gears = Reduced::default();
    let mut gearbox = exact(structure, meshes, run, &gears, 0.0);
    for angle in [0.0, 0.05] {
        let found = gearbox.solve(angle).unwrap_or_else(|e| panic!("{e}"));
        println!("two stages: {:?}, input torque {:.1}", found.certificate, found.input_torque);
        assert!(found.certificate.body_balance < 1e-9, "{:?}", found.certificate);
        assert!(found.certificate.residual < 1e-9, "{:?}", found.certificate);
        let wanted = TORQUE * (17.0 / 53.0) * (19.0 / 47.0);
        // Teeth press off the nominal line of action where axes give way: a part of a per cent.
        assert!((found.input_torque / wanted - 1.0).abs() < 5e-3, "{} beside {wanted}", found.input_torque);
        for mesh in &found.meshes {
            assert!(mesh.transmission_error > 0.0 && !mesh.slices.is_empty());
        }
    }
}

/// What shafts and bearings cost: positions of the box beside the same positions of its pairs alone, one after the other.
#[test]
fn a_box_costs_little_more_than_its_meshes() {
    let (structure, meshes) = two_stages();
    let run = operation(&structure, 4, Sense::Ccw, vec![Torque { disc: 5, torque: -TORQUE }]);
    let gears = Reduced::default();
    let mut gearbox = exact(structure, meshes.clone(), run, &gears, 0.0);
    let torques = [TORQUE * 19.0 / 47.0, TORQUE];
    let mut alone: Vec<StaticModel> = (0..2)
        .map(|i| {
            let pair = &meshes[i].pair;
            let own = options(pair, &gearbox.train().meshing()[i], torques[i]);
            StaticModel::new(pair.clone(), gearbox_gears(&gears, i).clone().unwrap(), own).unwrap()
        })
        .collect();
    let step = std::f64::consts::TAU / 17.0 / 64.0;
    // Tables of the contact are filled on the way.
    // All teeth are alike: a pair alone begins at its first.
    let first: Vec<f64> = gearbox.solve(0.0).unwrap().meshes.iter().map(|m| m.cycles.floor()).collect();
    let (mut of_box, mut of_pairs, mut steps) = (Vec::new(), Vec::new(), 0);
    for round in 0..3 {
        let angles = || (1..65).map(|i| step * f64::from(64 * round + i));
        let start = std::time::Instant::now();
        let found: Vec<GearboxPosition> = angles().map(|angle| gearbox.solve(angle).unwrap()).collect();
        of_box.push(start.elapsed().as_secs_f64());
        steps += found.iter().map(|position| position.certificate.iterations).sum::<usize>();
        let start = std::time::Instant::now();
        for position in &found {
            for ((mesh, model), first) in position.meshes.iter().zip(&mut alone).zip(&first) {
                model.advance(Station::at_cycles(mesh.cycles - first), |_| ()).unwrap();
            }
        }
        of_pairs.push(start.elapsed().as_secs_f64());
    }
    let least = |all: &[f64]| all.iter().copied().fold(f64::INFINITY, f64::min);
    let ratio = least(&of_box) / least(&of_pairs);
    println!(
        "64 positions: box {:.1} ms, pairs {:.1} ms, {ratio:.2} times",
        1e3 * least(&of_box),
        1e3 * least(&of_pairs)
    );
    // The clock of a machine is no law; how often the contacts are asked is one.
    let mean = steps as f64 / 192.0;
    assert!(mean < 2.5, "{mean} steps of Newton's method a position");
}

/// A mesh beside another one of the same gears is the mesh that it is alone, to the bit: with the same flanks, with others,
/// on more slices, and with another wheel angle. One that is pressed on the other flanks makes its own.
#[test]
fn a_mesh_beside_another_is_the_mesh_alone() {
    let own = pair([17, 53], 15.0);
    let structure = single(&own, 0.0);
    let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: own.clone() }];
    let train = Train::new(&structure, &meshes, &[0.0; 4], 2, Sense::Ccw).unwrap();
    let first = options(&own, &train.meshing()[0], TORQUE);
    let gears = reduced(&own, &first);
    let common = ExactMesh::new(own.clone(), Arc::clone(&gears), first.clone()).unwrap().of_gears();
    let crowning = GearModifications::both(FlankModification { lead_crowning: 5e-3, ..Default::default() });
    let crowned =
        GearPair::new(own.pinion.clone().with_modifications(crowning).unwrap(), own.wheel.clone(), None).unwrap();
    let finer = first.clone().with_contact(|c| c.slices = 24);
    let turned = first.clone().with_contact(|c| c.wheel_turn = 1e-4);
    let other = first.clone().with_contact(|c| c.both_flanks = true);
    for (pair, options) in [(&own, &first), (&crowned, &first), (&own, &finer), (&crowned, &turned), (&own, &other)] {
        let gears = if options.contact.both_flanks { reduced(pair, options) } else { Arc::clone(&gears) };
        let mut alone = ExactMesh::new(pair.clone(), Arc::clone(&gears), options.clone()).unwrap();
        let mut beside = ExactMesh::beside(Some(&common), pair.clone(), gears, options.clone()).unwrap();
        for cycles in [0.0, 0.3, 1.7, 20.2] {
            // The driving gear, ahead.
            let ahead = 2e-3 * first.contact.sense.sign() as f64;
            let at = Vector12::from_fn(|k, _| if k == 5 { ahead } else { 1e-5 * k as f64 });
            let [a, b] = [&mut alone, &mut beside].map(|mesh| {
                mesh.go_to(cycles).unwrap();
                mesh.evaluate(&at).unwrap()
            });
            assert!(a.normal_force > 0.0 && a == b, "{cycles}: {} and {} N", a.normal_force, b.normal_force);
        }
    }
}
