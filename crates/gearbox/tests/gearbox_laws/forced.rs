//! Orders of the meshes over speed: the loaded box at rest, phases, few modes beside all, sums.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use gearbox::{GearMesh, Held, MeanMesh, MeshElement, MeshExcitation, StaticGearbox, Train, Vibration, rms};
use geometry::Sense;
use nalgebra::Complex;

use crate::swinging::{POSITIONS, Wavy, cycles, heavy_stages, load, vibration};

/// Far below all frequencies the orders of a mesh add up to what the loaded box does at rest, from node to node and
/// from bearing to bearing.
#[test]
fn slow_orders_are_the_loaded_box_at_rest() {
    let (structure, meshes) = heavy_stages();
    for sense in [Sense::Ccw, Sense::Cw] {
        let run = load(&structure, sense);
        let held = Held { shafts: Vec::new(), turns: vec![run.input] };
        let box_ = vibration(&structure, &meshes, &run, &held);
        // A millionth of the first mode: inertia is 1e-12 of the forces.
        let slow = 1e-6 * box_.rotors().modes_at_rest().frequencies[0];
        let harmonics = box_.harmonics(slow / box_.mesh_orders()[0], 0.0).unwrap();
        assert_eq!(harmonics.len(), 2 * (POSITIONS / 2));
        let samples = cycles(&structure, &meshes, &run);
        let means: Vec<MeanMesh> = samples.iter().map(|(s, _)| MeanMesh::of(s).unwrap()).collect();
        for own in 0..2 {
            let elements = |i: usize, mesh: &GearMesh, meshing: &gearbox::Meshing| {
                let wavy = Box::new(Wavy::new(mesh, meshing)) as Box<dyn MeshElement>;
                Ok(if i == own { wavy } else { Box::new(means[i].clone()) })
            };
            let mut rest = StaticGearbox::new(structure.clone(), meshes.clone(), run.clone(), elements).unwrap();
            let slope = rest.train().cycles(1.0)[own] - rest.train().cycles(0.0)[own];
            let angles: Vec<f64> = (0..POSITIONS).map(|i| i as f64 / POSITIONS as f64 / slope).collect();
            let solved: Vec<_> = angles.iter().map(|&angle| rest.solve(angle).unwrap()).collect();
            let nodes = |p: &gearbox::GearboxPosition| -> Vec<f64> {
                p.shafts.iter().flat_map(|s| s.displacements.clone()).flatten().collect()
            };
            let forces = |p: &gearbox::GearboxPosition| -> Vec<f64> {
                p.bearings.iter().flat_map(|b| b.force.into_iter().chain(b.moment).map(|x| -x)).collect()
            };
            let normal =
                |p: &gearbox::GearboxPosition| -> Vec<f64> { p.meshes.iter().map(|m| m.normal_force).collect() };
            let swung = |of: &dyn Fn(&gearbox::Harmonic) -> Vec<Complex<f64>>, angle: f64| -> Vec<f64> {
                let turned = angle.abs() * box_.mesh_orders()[own];
                let all = harmonics.iter().filter(|h| h.mesh == own).map(|h| {
                    let turn = Complex::from_polar(1.0, h.order as f64 * turned);
                    of(h).into_iter().map(|x| (x * turn).re).collect::<Vec<f64>>()
                });
                all.reduce(|a, b| a.iter().zip(&b).map(|(x, y)| x + y).collect()).unwrap()
            };
            type Pair<'a> = (
                &'static str,
                &'a dyn Fn(&gearbox::GearboxPosition) -> Vec<f64>,
                &'a dyn Fn(&gearbox::Harmonic) -> Vec<Complex<f64>>,
                f64,
            );
            // Displacements of some um, forces of some kN; a train without a ring has the same normal force always.
            let pairs: [Pair<'_>; 3] = [
                ("displacement", &nodes, &|h| h.displacements.iter().copied().collect(), 1e-9),
                ("bearing", &forces, &|h| h.bearing_forces.iter().copied().collect(), 1e-3),
                ("normal force", &normal, &|h| h.mesh_forces.clone(), 1e-3),
            ];
            for (what, at_rest, swinging, near) in pairs {
                let rows: Vec<Vec<f64>> = solved.iter().map(at_rest).collect();
                let count = rows.len() as f64;
                let mean = |k: usize| rows.iter().map(|r| r[k]).sum::<f64>() / count;
                for (row, angle) in rows.iter().zip(&angles) {
                    for (k, (a, b)) in row.iter().zip(swung(swinging, *angle)).enumerate() {
                        let a = a - mean(k);
                        assert!((a - b).abs() < near, "{what} {k} of mesh {own} at {angle}: {b} beside {a}");
                    }
                }
            }
            let moved = nodes(&solved[3]).iter().zip(nodes(&solved[0])).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(moved > 1e-5, "nothing moves: {moved}");
        }
    }
}

/// Modes up to twice the highest frequency, and what the gears' forces need at rest, answer as all modes do.
#[test]
fn few_modes_and_their_rest_answer_as_all_do() {
    let (structure, meshes) = heavy_stages();
    let run = load(&structure, Sense::Ccw);
    let whole = vibration(&structure, &meshes, &run, &Held::default());
    let speed = 400.0;
    let highest = whole.mesh_orders().iter().fold(0.0, |m: f64, o| m.max(*o)) * 7.0 * speed;
    let few = whole.reduced(2.0 * highest).unwrap();
    let kept = few.rotors().modes_at_rest().frequencies.len();
    let all = whole.rotors().modes_at_rest().frequencies.len();
    let (a, b) = (whole.harmonics(speed, 0.03).unwrap(), few.harmonics(speed, 0.03).unwrap());
    let mut worst = 0.0f64;
    for (a, b) in a.iter().zip(&b) {
        for (x, y) in a.mesh_forces.iter().zip(&b.mesh_forces) {
            let size = a.mesh_forces.iter().map(|f| f.norm()).fold(0.0, f64::max);
            worst = worst.max((x - y).norm() / size);
        }
        let size = a.bearing_forces.map(|f| f.norm()).max();
        worst = worst.max((&a.bearing_forces - &b.bearing_forces).map(|f| f.norm()).max() / size);
    }
    println!("{kept} modes beside {all}: {worst:.1e} of the largest force of an order");
    assert!(kept < all * 2 / 3 && worst < 2e-3 && worst > 0.0, "{kept} of {all}: {worst:.1e}");
}

/// Turning gear 3 on its shaft shifts the phase of its own mesh by the part of a pitch, times the order, and that of the
/// first mesh by nothing. Counted by hand: gear 3 set ahead (in its sense) by a quarter pitch is a quarter cycle early.
#[test]
fn a_key_shifts_the_phase_of_its_own_mesh() {
    let (structure, meshes) = heavy_stages();
    for sense in [Sense::Ccw, Sense::Cw] {
        let mut run = load(&structure, sense);
        let plain = vibration(&structure, &meshes, &run, &Held::default()).harmonics(100.0, 0.03).unwrap();
        // The middle shaft turns against the input; 19 teeth.
        run.keys[2] = -(sense.sign() as f64) * TAU / 19.0 / 4.0;
        let ahead = vibration(&structure, &meshes, &run, &Held::default()).harmonics(100.0, 0.03).unwrap();
        for (a, b) in plain.iter().zip(&ahead).filter(|(a, _)| a.order <= 2) {
            let wanted = if a.mesh == 0 { 0.0 } else { a.order as f64 * 0.25 };
            let (x, y) = (a.mesh_forces[a.mesh], b.mesh_forces[a.mesh]);
            let turn = Complex::from_polar(1.0, TAU * wanted);
            // Samples lie elsewhere in the cycle then: what 15 of them fold back is a millionth.
            assert!((y - x * turn).norm() < 1e-4 * x.norm(), "mesh {} order {}: {x} {y}", a.mesh, a.order);
        }
    }
}

/// Meshes of an idler have one frequency: their answers are added up before they are squared, others after.
#[test]
fn harmonics_of_one_frequency_are_added_up() {
    let (a, b) = (Complex::new(3.0, 4.0), Complex::new(-3.0, -4.0));
    assert_eq!(rms([(10.0, a), (10.0, b)]), 0.0);
    assert!((rms([(10.0, a), (20.0, b)]) - 5.0).abs() < 1e-15);
    assert!((rms([(20.0, b), (10.0, a), (20.0, b)]) - (12.5f64 + 50.0).sqrt()).abs() < 1e-12);
    assert_eq!(rms([]), 0.0);
}

/// Forces of two meshes together do what they do one by one, and twice the force does twice as much.
#[test]
fn answers_of_the_meshes_add_up() {
    let (structure, meshes) = heavy_stages();
    let run = load(&structure, Sense::Ccw);
    let box_ = vibration(&structure, &meshes, &run, &Held::default());
    let train = Train::new(&structure, &meshes, &run.keys, run.input, run.sense).unwrap();
    let scaled = |first: f64, second: f64| {
        let mut own: Vec<MeshExcitation> = box_.excitations().cloned().collect();
        for (e, s) in own.iter_mut().zip([first, second]) {
            e.orders.iter_mut().for_each(|o| *o *= Complex::from(s));
        }
        let made = Vibration::new(structure.clone(), (&meshes, &train, run.sense), own, &Held::default()).unwrap();
        made.harmonics(150.0, 0.03).unwrap()
    };
    let (both, first, second) = (scaled(1.0, 1.0), scaled(1.0, 0.0), scaled(0.0, 2.0));
    for ((both, a), b) in both.iter().zip(&first).zip(&second) {
        let sum = &a.bearing_forces + &b.bearing_forces * Complex::from(0.5);
        let off = (&both.bearing_forces - sum).map(|x| x.norm()).max();
        assert!(off <= 1e-9 * both.bearing_forces.map(|x| x.norm()).max(), "mesh {}: {off}", both.mesh);
    }
}
