//! Vibration about equilibrium: closed forms, energies, the equation of motion, reciprocity.

use std::f64::consts::PI;

use fem::Material;
use gearbox::{
    Assembly, Disc, ElasticMesh, GearMesh, GearboxError, Held, MeshElement, MeshExcitation, MeshSample, Rotors,
    Structure, Train, Vector12, Vibration,
};
use geometry::{GearPair, Sense};
use nalgebra::{Complex, DMatrix, DVector, SVector};

use crate::{
    pairs::{LinearMesh, bearing, pair, shaft, single, spring, two_stages},
    swinging::{heavy_stages, load, vibration},
};

/// The mean mesh of one pair as a spring of a stiffness, at rest at `displacements`.
fn elastic(mesh: &GearMesh, train: &Train, i: usize, stiffness: f64) -> MeshExcitation {
    let own = LinearMesh { stiffness, ..spring(mesh, &train.meshing()[i]) };
    let h = Vector12::from_fn(|k, _| own.levers[k / 6][k % 6]);
    let displacements = 1e-3 * h / h.norm_squared();
    let reply = own.clone().evaluate(&displacements).unwrap();
    let samples =
        [0.0, 0.25, 0.5, 0.75].map(|cycles| MeshSample { cycles, displacements, reply: reply.clone(), modal: None });
    MeshExcitation::new(&samples, &[], 1, [own.levers[0][5], own.levers[1][5]]).unwrap()
}

/// Pinion and wheel of a pair on shafts that only turn.
fn two_discs(pair: &GearPair, held: &Held, order: DVector<Complex<f64>>) -> Vibration {
    let mut structure = single(pair, 0.4);
    (structure.discs[0].polar_inertia, structure.discs[1].polar_inertia) = (40.0, 700.0);
    let meshes = [GearMesh { name: "pair".into(), discs: [0, 1], pair: pair.clone() }];
    let train = Train::new(&structure, &meshes, &[0.0; 4], 2, Sense::Ccw).unwrap();
    let mut excitation = elastic(&meshes[0], &train, 0, 4e5);
    excitation.orders = vec![order];
    Vibration::new(structure, (&meshes, &train, Sense::Ccw), vec![excitation], held).unwrap()
}

/// Polar inertia of a solid steel shaft, t mm^2.
fn of_shaft(length: f64, diameter: f64) -> f64 {
    Material::STEEL.density_t_per_mm3() * PI / 32.0 * diameter.powi(4) * length
}

/// omega^2 = k cos^2(beta_b) (r_b1^2/J_1 + r_b2^2/J_2): two discs on the teeth.
#[test]
fn two_discs_on_a_mesh_have_the_closed_form() {
    let pair = pair([21, 40], 18.0);
    let held = Held { shafts: vec![0, 1], turns: Vec::new() };
    let box_ = two_discs(&pair, &held, DVector::zeros(12));
    let inertia = [40.0 + of_shaft(150.0, 30.0), 700.0 + of_shaft(150.0, 40.0)];
    let radii = [&pair.pinion, &pair.wheel].map(|g| g.base_radius() * pair.base_helix_angle().cos());
    let wanted = (4e5 * (radii[0] * radii[0] / inertia[0] + radii[1] * radii[1] / inertia[1])).sqrt();
    let found = &box_.rotors().modes_at_rest().frequencies;
    assert_eq!(found.len(), 2);
    assert_eq!(found[0], 0.0, "the train turns on");
    assert!((found[1] / wanted - 1.0).abs() < 1e-10, "{} beside {wanted} rad/s", found[1]);
    let whirl = box_.rotors().whirl_modes(&[100.0, -50.0]).unwrap();
    assert!((whirl.modes[0].frequency / wanted - 1.0).abs() < 1e-9, "{}", whirl.modes[0].frequency);
    // All the strain is in the mesh, and the kinetic energy as r^2/J.
    let mesh: f64 = whirl.modes[0].energy.strain.iter().map(|s| s.share).sum();
    assert!((mesh - 1.0).abs() < 1e-9, "{:?}", whirl.modes[0].energy);
}

/// A lone mode at its own frequency answers with 1/(2 zeta) of what it does at rest, a quarter period late.
#[test]
fn a_lone_mode_at_resonance_answers_with_one_over_two_zeta() {
    let pair = pair([21, 40], 18.0);
    let held = Held { shafts: vec![0, 1], turns: vec![2] };
    let box_ = two_discs(&pair, &held, DVector::zeros(12));
    let [own] = box_.rotors().modes_at_rest().frequencies[..] else { panic!("one coordinate is left") };
    let wheel = box_.rotors().assembly().disc(1).unwrap() + 5;
    let mut force = DVector::zeros(box_.rotors().assembly().size());
    force[wheel] = Complex::from(1e3);
    let answer = |frequency: f64| box_.rotors().response(&[0.0; 2], frequency, 0.04, &force).unwrap()[wheel];
    let ratio = answer(own) / answer(0.0);
    assert!((ratio - Complex::new(0.0, -12.5)).norm() < 1e-9, "{ratio}");
    let radius = pair.wheel.base_radius() * pair.base_helix_angle().cos();
    assert!((answer(0.0).re * 4e5 * radius * radius / 1e3 - 1.0).abs() < 1e-10, "{}", answer(0.0));
    let at = |frequency: f64| box_.rotors().response(&[0.0; 2], frequency, 0.0, &force);
    assert!(matches!(at(own), Err(GearboxError::OutOfRange { .. })) || at(own).unwrap()[wheel].norm() > 1e6);
    for wrong in [f64::NAN, -1.0, f64::INFINITY] {
        assert!(matches!(at(wrong), Err(GearboxError::OutOfRange { .. })), "{wrong}");
        let damped = box_.rotors().response(&[0.0; 2], 1.0, wrong, &force);
        assert!(matches!(damped, Err(GearboxError::OutOfRange { .. })), "{wrong}");
    }
}

/// Shafts, meshes, bearings: shares of every mode's energy are a whole, and none is negative.
#[test]
fn energy_of_a_modes_parts_adds_up() {
    let (structure, meshes) = heavy_stages();
    let run = load(&structure, Sense::Ccw);
    let box_ = vibration(&structure, &meshes, &run, &Held::default()).reduced(2e5).unwrap();
    let found = box_.rotors().whirl_modes(&box_.speeds(300.0)).unwrap();
    assert!(found.modes.len() > 30, "{} modes", found.modes.len());
    for mode in found.modes.iter().take(30) {
        for shares in [&mode.energy.strain, &mode.energy.kinetic] {
            let sum: f64 = shares.iter().map(|s| s.share).sum();
            // Entries of the stiffness are some 1e9 times the energy of a low mode.
            assert!((sum - 1.0).abs() < 1e-6, "{} rad/s: {sum}", mode.frequency);
            assert!(shares.iter().all(|s| s.share > -1e-6), "{} rad/s: {shares:?}", mode.frequency);
        }
    }
    let frequencies: Vec<f64> = found.modes.iter().map(|m| m.frequency).collect();
    assert!(frequencies.is_sorted(), "{frequencies:?}");
}

/// Gears that nothing can part turn as one: two shafts in series, the second as the first one sees it.
///
/// ```text
/// 1/k = 1/k_1 + i^2/k_2,   J_2' = J_2/i^2,   omega^2 = k (1/J_1 + 1/J_2'),   i = z_2/z_1
/// ```
#[test]
fn stiff_teeth_make_geared_rotors_an_equivalent_shaft() {
    let pair = pair([20, 50], 0.0);
    let mut structure = single(&pair, 0.0);
    structure.bearings = [0, 1].map(|s| bearing("stiff", s, 60.0, 1e9)).into();
    // Held where the teeth press: no shaft bends.
    for b in &mut structure.bearings {
        (0..2).for_each(|k| b.stiffness[(k, k)] = 1e9);
        (3..5).for_each(|k| b.stiffness[(k, k)] = 1e12);
    }
    (structure.discs[2].polar_inertia, structure.discs[3].polar_inertia) = (1e3, 9e3);
    let meshes = [GearMesh { name: "pair".into(), discs: [0, 1], pair: pair.clone() }];
    let train = Train::new(&structure, &meshes, &[0.0; 4], 2, Sense::Ccw).unwrap();
    let excitation = elastic(&meshes[0], &train, 0, 1e9);
    let box_ = Vibration::new(structure, (&meshes, &train, Sense::Ccw), vec![excitation], &Held::default()).unwrap();
    let spring = |diameter: f64, length: f64| 2.06e5 / 2.6 * PI / 32.0 * diameter.powi(4) / length;
    // Input and pinion are 60 mm apart, wheel and output 90 mm.
    let (k1, k2, i) = (spring(30.0, 60.0), spring(40.0, 90.0), 2.5);
    let k = 1.0 / (1.0 / k1 + i * i / k2);
    let wanted = (k * (1.0 / 1e3 + i * i / 9e3)).sqrt();
    let torsion = |q: SVector<f64, 6>| q[5].abs();
    let rest = box_.rotors().modes_at_rest();
    let input = box_.rotors().assembly().disc(2).unwrap();
    let own = (0..rest.frequencies.len()).filter(|&m| rest.frequencies[m] > 0.0);
    let most = own.max_by(|&a, &b| {
        let size = |m: usize| torsion(rest.shape(m).fixed_rows::<6>(input).into_owned());
        size(a).total_cmp(&size(b))
    });
    let found = rest.frequencies[most.unwrap()];
    // Shafts have some 1e-4 of the discs' inertia, teeth and bearings 1e-4 of the shafts' compliance.
    assert!((found / wanted - 1.0).abs() < 5e-4, "{found} beside {wanted} rad/s");
}

/// The answer solves the equation of motion in its own matrices: K - w^2 M + i w (C + G).
#[test]
fn the_response_solves_the_equation_of_motion() {
    let (mut structure, meshes) = heavy_stages();
    structure.bearings.iter_mut().for_each(|b| b.damping = 1e-5 * b.stiffness);
    let run = load(&structure, Sense::Ccw);
    let box_ = vibration(&structure, &meshes, &run, &Held::default());
    let (rotors, speeds) = (box_.rotors(), box_.speeds(200.0));
    let assembly = rotors.assembly();
    let mut force = DVector::zeros(assembly.size());
    (0..4).for_each(|g| force[assembly.disc(g).unwrap() + g] = Complex::new(100.0, 30.0 * g as f64));
    for frequency in [500.0, 5e3, 4e4] {
        let x = rotors.response(&speeds, frequency, 0.0, &force).unwrap();
        let parts = [x.map(|x| x.re), x.map(|x| x.im)];
        let dynamic = assembly.stiffness() - frequency * frequency * assembly.mass();
        let rates = frequency * (assembly.damping() + assembly.gyroscopic(&speeds).unwrap());
        let left = [&dynamic * &parts[0] - &rates * &parts[1], &dynamic * &parts[1] + &rates * &parts[0]];
        for (i, f) in force.iter().enumerate() {
            // Turns meet moments of some 100 N times 100 mm; entries of the stiffness are 1e9 times a mode's.
            let off = (left[0][i] - f.re).abs().max((left[1][i] - f.im).abs());
            assert!(off < 1e-3, "{frequency} rad/s, coordinate {i}: {off} N is left over");
        }
    }
}

/// What i does to j, j does to i in the machine that spins the other way; at rest, in the same one.
#[test]
fn responses_are_reciprocal() {
    let (structure, meshes) = heavy_stages();
    let run = load(&structure, Sense::Ccw);
    let box_ = vibration(&structure, &meshes, &run, &Held::default()).reduced(1e5).unwrap();
    let rotors = box_.rotors();
    let at = |disc: usize, axis: usize| rotors.assembly().disc(disc).unwrap() + axis;
    let answer = |speed: f64, from: usize, to: usize| {
        let mut force = DVector::zeros(rotors.assembly().size());
        force[from] = Complex::from(1.0);
        rotors.response(&box_.speeds(speed), 7e3, 0.02, &force).unwrap()[to]
    };
    let mut gyroscopic = 0.0f64;
    for (a, b) in [(at(0, 1), at(3, 5)), (at(1, 3), at(2, 4)), (at(0, 0), at(2, 2))] {
        for speed in [0.0, 800.0] {
            let (there, back) = (answer(speed, a, b), answer(-speed, b, a));
            assert!((there - back).norm() < 1e-9 * there.norm(), "{speed} rad/s: {there} and {back}");
        }
        gyroscopic = gyroscopic.max((answer(800.0, a, b) / answer(800.0, b, a) - 1.0).norm());
    }
    assert!(gyroscopic > 1e-6, "spin has to matter: {gyroscopic:.1e}");
}

/// Contact points off the line of action have levers of their own: a tangent of several of them still lets the train turn
/// with its teeth, and keeps what turning gear 1 alone meets.
#[test]
fn a_train_of_any_meshes_turns_on() {
    let (structure, meshes) = heavy_stages();
    let train = Train::new(&structure, &meshes, &[0.0; 6], 4, Sense::Ccw).unwrap();
    let made = |i: usize, off: f64| {
        let own = LinearMesh { stiffness: 2e5, ..spring(&meshes[i], &train.meshing()[i]) };
        let replies = [1.0 + off, 1.0 - off].map(|more| {
            let mut one = own.clone();
            one.levers[1][5] *= more;
            let h = Vector12::from_fn(|k, _| one.levers[k / 6][k % 6]);
            one.evaluate(&(1e-3 * h / h.norm_squared())).unwrap()
        });
        let displacements = Vector12::zeros();
        let samples = replies.map(|reply| MeshSample { cycles: 0.0, displacements, reply, modal: None });
        MeshExcitation::new(&samples, &[], 1, [own.levers[0][5], own.levers[1][5]]).unwrap()
    };
    let lowest = |off: f64| {
        let excitations = vec![made(0, off), made(1, off)];
        let held = Held { shafts: vec![0, 1, 2], turns: Vec::new() };
        let parts = (&meshes[..], &train, Sense::Ccw);
        let box_ = Vibration::new(structure.clone(), parts, excitations, &held).unwrap();
        let found = box_.rotors().modes_at_rest().frequencies.clone();
        (found, box_.mesh_stiffness()[0])
    };
    let ((even, stiffness), (off, other)) = (lowest(0.0), lowest(1e-3));
    assert_eq!((even[0], off[0]), (0.0, 0.0), "the train turns on: {off:?}");
    assert!((off[1] / even[1] - 1.0).abs() < 1e-5 && (other / stiffness - 1.0).abs() < 1e-5, "{off:?} beside {even:?}");
}

/// A mesh as springs and the same mesh as one stiffness are alike.
#[test]
fn a_spring_is_a_whole_stiffness() {
    let (structure, meshes) = two_stages();
    let train = Train::new(&structure, &meshes, &[0.0; 6], 4, Sense::Ccw).unwrap();
    let of = |i: usize| {
        let geometry = lumped::shaft18::MeshGeometry::of_pair(&meshes[i].pair, train.meshing()[i].side());
        let geometry = lumped::shaft18::MeshGeometry { direction: train.meshing()[i].direction, ..geometry };
        gearbox::MeshSpring::new(&meshes[i].name, meshes[i].discs, &geometry, 4e5).unwrap()
    };
    let springs = Structure { springs: vec![of(0), of(1)], ..structure.clone() };
    let whole = [0, 1].map(|i| {
        let h = Vector12::from_fn(|k, _| of(i).levers[k / 6][k % 6]);
        let stiffness = DMatrix::from_column_slice(12, 12, (4e5 * h * h.transpose()).as_slice());
        ElasticMesh { name: meshes[i].name.clone(), discs: meshes[i].discs, stiffness }
    });
    let whole = Structure { elastic_meshes: whole.into(), ..structure.clone() };
    let [a, b] = [springs, whole].map(|s| Assembly::new(s).unwrap().stiffness());
    assert!((&a - &b).amax() < 1e-12 * a.amax());
    let mut pushing = structure;
    let stiffness = -DMatrix::<f64>::identity(12, 12);
    pushing.elastic_meshes.push(ElasticMesh { name: "pushing".into(), discs: [0, 1], stiffness });
    assert!(matches!(Assembly::new(pushing), Err(GearboxError::NotElastic { .. })));
}

/// What is held and is not there is refused.
#[test]
fn what_is_not_there_cannot_be_held() {
    let structure = Structure {
        shafts: vec![shaft("alone", [0.0; 3], 100.0, 20.0)],
        discs: vec![Disc::seat("end", 0, 100.0)],
        bearings: vec![bearing("A", 0, 10.0, 1e5), bearing("B", 0, 90.0, 0.0)],
        ..Structure::default()
    };
    let hold = |shafts: Vec<usize>, turns: Vec<usize>| {
        Rotors::holding(Assembly::new(structure.clone()).unwrap(), &Held { shafts, turns })
    };
    assert!(matches!(hold(vec![3], Vec::new()), Err(GearboxError::NoShaft { shaft: 3, .. })));
    assert!(matches!(hold(Vec::new(), vec![3]), Err(GearboxError::NoDisc { disc: 3, .. })));
    assert_eq!(hold(vec![0], Vec::new()).unwrap().modes_at_rest().frequencies, [0.0]);
    let turning = hold(Vec::new(), Vec::new()).unwrap().modes_at_rest().frequencies[0];
    let standing = hold(Vec::new(), vec![0]).unwrap().modes_at_rest().frequencies[0];
    assert!(turning == 0.0 && standing > 0.0, "{turning} {standing}");
}
