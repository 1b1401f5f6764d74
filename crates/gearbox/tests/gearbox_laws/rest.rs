//! Gearboxes at rest with meshes as springs: balance, closed forms, and the whole system solved at once.

use gearbox::{Assembly, Disc, GearboxError, MeshSpring, Operation, StaticGearbox, Structure, Torque};
use geometry::Sense;
use lumped::shaft18::MeshGeometry;
use nalgebra::{DMatrix, DVector};

use crate::pairs::{operation, pair, single, spring, springs, two_stages};

/// Torque of the output, N mm.
const TORQUE: f64 = 4e5;

fn boxed(structure: Structure, meshes: Vec<gearbox::GearMesh>, operation: Operation) -> StaticGearbox {
    StaticGearbox::new(structure, meshes, operation, springs).unwrap_or_else(|e| panic!("{e}"))
}

/// Torques go as the teeth, forces as the torque over base radius and helix, and all of it is in balance.
#[test]
fn a_train_of_two_stages_is_in_balance() {
    for sense in [Sense::Ccw, Sense::Cw] {
        let (structure, meshes) = two_stages();
        // The slow shaft turns as the fast one.
        let torque = -(sense.sign() as f64) * TORQUE;
        let run = operation(&structure, 4, sense, vec![Torque { disc: 5, torque }]);
        let pairs: Vec<_> = meshes.iter().map(|m| m.pair.clone()).collect();
        let mut gearbox = boxed(structure, meshes, run);
        for angle in [0.0, 0.7, -3.0] {
            let found = gearbox.solve(angle).unwrap();
            let wanted = -torque * (17.0 / 53.0) * (19.0 / 47.0);
            assert!((found.input_torque / wanted - 1.0).abs() < 1e-9, "{} beside {wanted} N mm", found.input_torque);
            assert!(found.certificate.body_balance < 1e-9, "{:?}", found.certificate);
            assert!(found.certificate.residual < 1e-9, "{:?}", found.certificate);
            let on_middle = TORQUE * 19.0 / 47.0;
            for (mesh, (pair, torque)) in found.meshes.iter().zip(pairs.iter().zip([on_middle, TORQUE])) {
                let normal = torque / (pair.wheel.base_radius() * pair.base_helix_angle().cos());
                assert!((mesh.normal_force / normal - 1.0).abs() < 1e-9, "{} beside {normal} N", mesh.normal_force);
                // The spring's own approach is F/k; the driven gear lags by that and by what the axes give way.
                assert!(mesh.transmission_error > mesh.normal_force / 4e5, "{}", mesh.transmission_error);
            }
            assert!(found.output_lags[0] > 0.0, "the output lags under load");
        }
    }
}

/// The condensed system is the whole one: all nodes, all springs, one linear solve.
#[test]
fn condensation_to_the_seats_loses_nothing() {
    let (structure, meshes) = two_stages();
    let housing = {
        // Seats on springs, each of them tied to all others along x.
        let n = 6 * structure.bearings.len();
        let tie = DMatrix::from_fn(n, n, |i, j| if i % 6 == 0 && j % 6 == 0 { -2e4 } else { 0.0 });
        DMatrix::from_diagonal_element(n, n, 4e5) + tie
    };
    let structure = Structure { housing: Some(housing), ..structure };
    let run = operation(&structure, 4, Sense::Ccw, vec![Torque { disc: 5, torque: -TORQUE }]);
    let mut gearbox = boxed(structure.clone(), meshes.clone(), run);
    let found = gearbox.solve(0.0).unwrap();

    let mut whole = structure;
    for (mesh, meshing) in meshes.iter().zip(gearbox.train().meshing()) {
        let geometry =
            MeshGeometry { direction: meshing.direction, ..MeshGeometry::of_pair(&mesh.pair, meshing.side()) };
        whole.springs.push(MeshSpring::new(&mesh.name, mesh.discs, &geometry, 4e5).unwrap());
    }
    let assembly = Assembly::new(whole).unwrap();
    let mut k = assembly.stiffness();
    let mut load = DVector::zeros(assembly.size());
    load[assembly.disc(5).unwrap() + 5] = -TORQUE;
    let held = assembly.disc(4).unwrap() + 5;
    k.row_mut(held).fill(0.0);
    k.column_mut(held).fill(0.0);
    k[(held, held)] = 1.0;
    let q = k.lu().solve(&load).unwrap();
    let mut at = 0;
    for line in &found.shafts {
        for own in &line.displacements {
            for (axis, value) in own.iter().enumerate() {
                let size = if axis < 3 { 1e-2 } else { 1e-4 };
                assert!((value - q[at]).abs() < 1e-9 * size, "coordinate {at}: {value} beside {}", q[at]);
                at += 1;
            }
        }
    }
    assert_eq!(at, assembly.size());
    assert!(found.certificate.body_balance < 1e-9, "{:?}", found.certificate);
}

/// A pair alone, its shafts held, gives way by F/k and nothing else, in whatever direction the wheel stands.
#[test]
fn held_shafts_leave_the_spring_of_the_mesh() {
    for direction in [0.0, 0.8, 2.5, -1.3] {
        for sense in [Sense::Ccw, Sense::Cw] {
            let pair = pair([21, 40], 18.0);
            let structure = single(&pair, direction);
            let torque = sense.sign() as f64 * TORQUE;
            let mut run = operation(&structure, 2, sense, vec![Torque { disc: 3, torque }]);
            run.held = vec![0, 1];
            let meshes = vec![gearbox::GearMesh { name: "pair".into(), discs: [0, 1], pair: pair.clone() }];
            let found = boxed(structure, meshes, run).solve(0.2).unwrap();
            let cos = pair.base_helix_angle().cos();
            let normal = TORQUE / (pair.wheel.base_radius() * cos);
            let mesh = &found.meshes[0];
            // Turns alone compress the spring by te cos b_b.
            let te = normal / 4e5 / cos;
            assert!((mesh.transmission_error / te - 1.0).abs() < 1e-12, "{} beside {te}", mesh.transmission_error);
            assert_eq!([mesh.misalignment_in_plane, mesh.misalignment_across], [0.0; 2]);
            assert!((found.input_torque / (torque * 21.0 / 40.0) - 1.0).abs() < 1e-12, "{}", found.input_torque);
            let reaction = found.held_reactions[0].unwrap();
            for (axis, r) in reaction.iter().take(3).enumerate() {
                assert!((r + mesh.force[0][axis]).abs() < 1e-9 * normal, "reaction {axis}");
            }
            assert!(found.certificate.body_balance < 1e-12 && found.certificate.residual < 1e-12);
        }
    }
}

/// Turning the whole box about z turns its answers: the same error, misalignment and bearing loads where bearings are
/// alike all round.
#[test]
fn a_turned_gearbox_has_turned_answers() {
    let pair = pair([21, 40], 18.0);
    let solve = |direction: f64| {
        let mut structure = single(&pair, direction);
        for b in &mut structure.bearings {
            (b.stiffness[(0, 0)], b.stiffness[(3, 3)]) = (b.stiffness[(1, 1)], b.stiffness[(4, 4)]);
        }
        let run = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
        let meshes = vec![gearbox::GearMesh { name: "pair".into(), discs: [0, 1], pair: pair.clone() }];
        boxed(structure, meshes, run).solve(0.0).unwrap()
    };
    let (a, b) = (solve(0.0), solve(2.0));
    let same = |x: f64, y: f64, what: &str| assert!((x - y).abs() < 1e-9 * x.abs().max(1e-6), "{what}: {x} and {y}");
    same(a.meshes[0].transmission_error, b.meshes[0].transmission_error, "transmission error");
    same(a.meshes[0].misalignment_in_plane, b.meshes[0].misalignment_in_plane, "misalignment");
    for (x, y) in a.bearings.iter().zip(&b.bearings) {
        same(x.force[0].hypot(x.force[1]), y.force[0].hypot(y.force[1]), "radial force");
        same(x.force[2], y.force[2], "axial force");
    }
    assert!(a.meshes[0].misalignment_in_plane != 0.0);
}

/// Softer bearings on one side lean the wheel; the sign is that of `contact::Misalignment`: the gap opens where the
/// pinion's shaft gives way more.
#[test]
fn the_gap_opens_where_the_shaft_gives_way() {
    let pair = pair([21, 40], 0.0);
    let lean = |soft: usize| {
        let mut structure = single(&pair, 0.0);
        structure.discs[0].position = 75.0;
        structure.discs[1].position = 75.0;
        structure.bearings[soft].stiffness *= 0.2;
        let run = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
        let meshes = vec![gearbox::GearMesh { name: "pair".into(), discs: [0, 1], pair: pair.clone() }];
        boxed(structure, meshes, run).solve(0.0).unwrap().meshes[0].misalignment_in_plane
    };
    // Bearings B and D lie at larger z.
    assert!(lean(1) > 0.0 && lean(3) > 0.0, "{} {}", lean(1), lean(3));
    assert!(lean(0) < 0.0 && lean(2) < 0.0, "{} {}", lean(0), lean(2));
}

/// Without torque nothing moves; loads that drive, shafts that nothing holds and numbers that are none are refused.
#[test]
fn what_cannot_stand_is_refused() {
    let pair = pair([21, 40], 18.0);
    let structure = single(&pair, 0.0);
    let meshes = vec![gearbox::GearMesh { name: "pair".into(), discs: [0, 1], pair }];
    let with = |structure: &Structure, torque: f64| {
        let run = operation(structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque }]);
        StaticGearbox::new(structure.clone(), meshes.clone(), run, springs)
    };
    let idle = with(&structure, 0.0).unwrap().solve(1.0).unwrap();
    assert_eq!(idle.meshes[0].normal_force, 0.0);
    assert_eq!(idle.output_lags, [0.0]);
    assert!(matches!(with(&structure, -1.0), Err(GearboxError::Drives { .. })));
    assert!(matches!(with(&structure, f64::NAN), Err(GearboxError::OutOfRange { .. })));
    let loose = Structure { bearings: Vec::new(), ..structure.clone() };
    let what_is_free = |structure: &Structure| match with(structure, 1e5).err() {
        Some(GearboxError::Loose { motion, .. }) => motion,
        other => panic!("{other:?}"),
    };
    assert_eq!(what_is_free(&loose), "along x");
    let mut slides = structure.clone();
    slides.bearings.iter_mut().for_each(|b| b.stiffness[(2, 2)] = 0.0);
    assert_eq!(what_is_free(&slides), "along z");
    // Two bearings at one place hold no shaft upright.
    let mut tilts = structure.clone();
    tilts.bearings.iter_mut().for_each(|b| b.position = 40.0);
    tilts.bearings.iter_mut().for_each(|b| (3..6).for_each(|i| b.stiffness[(i, i)] = 0.0));
    assert!(what_is_free(&tilts).starts_with("tilting about"), "{}", what_is_free(&tilts));
    assert!(matches!(with(&structure, 1e5).unwrap().solve(f64::NAN), Err(GearboxError::OutOfRange { .. })));
    let mut far = operation(&structure, 2, Sense::Ccw, Vec::new());
    far.held = vec![7];
    let found = StaticGearbox::new(structure, meshes, far, springs);
    assert!(matches!(found.err(), Some(GearboxError::NoShaft { shaft: 7, .. })));
}

/// Two meshes of opposite hands hold a shaft along its axis that no bearing holds there, with the same thrust on both; a
/// weak spring beside them changes nothing, and with like hands it slides.
#[test]
fn opposite_helices_hold_a_shaft_along_its_axis() {
    let solved = |hands: [f64; 2], spring: f64| {
        let pairs = hands.map(|helix| pair([21, 40], helix));
        let mut structure = single(&pairs[0], 0.0);
        let twin = |disc: usize, name: &str| Disc {
            name: name.into(),
            position: structure.discs[disc].position + 20.0,
            ..structure.discs[disc].clone()
        };
        let twins = [twin(0, "pinion, right"), twin(1, "wheel, right")];
        let discs = [structure.discs.len(), structure.discs.len() + 1];
        structure.discs.extend(twins);
        let free = structure.discs[1].shaft;
        let own = structure.bearings.iter_mut().filter(|b| b.shaft == free);
        own.enumerate().for_each(|(i, b)| b.stiffness[(2, 2)] = if i == 0 { spring } else { 0.0 });
        let [left, right] = pairs;
        let meshes = vec![
            gearbox::GearMesh { name: "left".into(), discs: [0, 1], pair: left },
            gearbox::GearMesh { name: "right".into(), discs, pair: right },
        ];
        let run = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: 2e5 }]);
        StaticGearbox::new(structure, meshes, run, springs).and_then(|mut g| g.solve(0.1))
    };
    let forces = |spring: f64| {
        let found = solved([18.0, -18.0], spring).unwrap_or_else(|e| panic!("{spring} N/mm: {e}"));
        [0, 1].map(|i| found.meshes[i].normal_force)
    };
    let (alone, with) = (forces(0.0), forces(1e-3));
    assert!((alone[0] / alone[1] - 1.0).abs() < 1e-9, "the thrusts are {alone:?}");
    assert!((0..2).all(|i| (alone[i] / with[i] - 1.0).abs() < 1e-6), "{alone:?} beside {with:?}");
    let slides = solved([18.0, 18.0], 0.0).err();
    assert!(matches!(&slides, Some(GearboxError::Loose { motion: "along z", .. })), "{slides:?}");
}

/// Flanks that stand far apart for their load meet: the linear guess reaches a millionth of the way, and the gears turn by
/// the gap and the compliance.
#[test]
fn a_light_load_closes_a_wide_gap() {
    let pair = pair([21, 40], 18.0);
    let structure = single(&pair, 0.0);
    let meshes = vec![gearbox::GearMesh { name: "pair".into(), discs: [0, 1], pair }];
    let force = |torque: f64, excess: f64| {
        let run = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque }]);
        let mut gearbox = StaticGearbox::new(structure.clone(), meshes.clone(), run, |_, mesh, meshing| {
            let mut own = spring(mesh, meshing);
            own.excess = excess;
            Ok(Box::new(own))
        });
        gearbox.as_mut().unwrap().solve(0.0).unwrap().meshes[0].normal_force
    };
    for torque in [1e-3, 1.0, 1e5] {
        let [touching, apart] = [0.0, -0.05].map(|excess| force(torque, excess));
        assert!((apart / touching - 1.0).abs() < 1e-6, "{torque} N mm: {apart} beside {touching} N");
    }
}

/// Two meshes of one ratio between two shafts share the load, and a thicker tooth takes more of it.
#[test]
fn a_power_split_shares_the_load() {
    let pair = pair([20, 40], 0.0);
    let mut structure = single(&pair, 0.0);
    structure.discs.push(gearbox::Disc::seat("pinion 2", 0, 90.0));
    structure.discs.push(gearbox::Disc::seat("wheel 2", 1, 90.0));
    let mesh = |name: &str, discs| gearbox::GearMesh { name: name.into(), discs, pair: pair.clone() };
    let meshes = vec![mesh("left", [0, 1]), mesh("right", [4, 5])];
    let solve = |excess: f64| {
        let run = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
        let mut gearbox = StaticGearbox::new(structure.clone(), meshes.clone(), run, |i, mesh, meshing| {
            let mut own = spring(mesh, meshing);
            own.excess = if i == 1 { excess } else { 0.0 };
            Ok(Box::new(own))
        });
        gearbox.as_mut().unwrap().solve(0.0).unwrap()
    };
    let (even, thick, thin) = (solve(0.0), solve(5e-3), solve(-0.2));
    let forces = |p: &gearbox::GearboxPosition| [p.meshes[0].normal_force, p.meshes[1].normal_force];
    let whole = TORQUE / pair.wheel.base_radius();
    for p in [&even, &thick, &thin] {
        let [a, b] = forces(p);
        assert!(((a + b) / whole - 1.0).abs() < 1e-9, "{a} + {b} of {whole} N");
    }
    assert!(forces(&even).iter().all(|f| *f > 0.2 * whole), "{:?}", forces(&even));
    assert!(forces(&thick)[1] > forces(&even)[1]);
    assert_eq!(forces(&thin)[1], 0.0, "flanks that are apart carry nothing");
}

/// Whatever number stands in a structure, there is an answer or a reason, and both come to an end.
#[test]
fn no_number_is_without_an_answer() {
    let pair = pair([21, 40], 18.0);
    let meshes = vec![gearbox::GearMesh { name: "pair".into(), discs: [0, 1], pair: pair.clone() }];
    type Change = fn(&mut Structure, f64);
    let changes: [(&str, Change); 9] = [
        ("length", |s, x| s.shafts[0].pieces[0].length = x),
        ("longest element", |s, x| s.shafts[0].longest_element = x),
        ("origin", |s, x| s.shafts[1].origin[0] = x),
        ("height", |s, x| s.shafts[1].origin[2] = x),
        ("place of a gear", |s, x| s.discs[0].position = x),
        ("mass", |s, x| s.discs[0].mass = x),
        ("place of a bearing", |s, x| s.bearings[0].position = x),
        ("stiffness", |s, x| s.bearings[0].stiffness[(0, 0)] = x),
        ("coupling", |s, x| (s.bearings[0].stiffness[(0, 4)], s.bearings[0].stiffness[(4, 0)]) = (x, x)),
    ];
    let (mut answers, mut reasons) = (0, 0);
    for (name, change) in changes {
        for value in [0.0, -1.0, 1e-300, 1e300, f64::MAX, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let mut structure = single(&pair, 0.0);
            change(&mut structure, value);
            let run = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
            let solved = StaticGearbox::new(structure.clone(), meshes.clone(), run, springs);
            match solved.and_then(|mut gearbox| gearbox.solve(0.0)) {
                Ok(found) => {
                    answers += 1;
                    assert!(found.certificate.residual < 1e-6, "{name} = {value}: {:?}", found.certificate);
                }
                Err(error) => {
                    reasons += 1;
                    assert!(!error.to_string().is_empty(), "{name} = {value}");
                }
            }
            if let Ok(rotors) = Assembly::new(structure).and_then(gearbox::Rotors::new) {
                let found = rotors.whirl_modes(&[100.0, -50.0]);
                assert!(found.is_err() || found.is_ok_and(|f| f.modes.iter().all(|m| m.frequency.is_finite())));
            }
        }
    }
    assert!(answers > 3 && reasons > 30, "{answers} answers, {reasons} reasons");
}
