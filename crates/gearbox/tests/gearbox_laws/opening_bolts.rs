//! A ring of teeth on bolts that open, with four planets inside.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{
    f64::consts::FRAC_PI_2,
    sync::{Arc, Mutex},
};

use gearbox::{BoltForce, ExactMesh, GearboxPosition, MeshElement, StaticGearbox, Train};
use mesh::{Bolts, BoreCoupling, Foundation};
use reduction::ElasticGear;
use testing::Case;

use crate::{
    pairs::{SECTOR, options},
    planets::{STAGE, Stage},
};

/// Outside of the ring, mm, and torque of the ring, N mm.
const OUTSIDE: f64 = 300.0;
const TORQUE: f64 = 4e5;
/// Disc of the ring.
const RING: usize = 1;

const BOLTS: Bolts = Bolts {
    count: 6,
    first_angle: 0.3,
    width: 12.0,
    heights: None,
    stiffness: [2e5, 1e5, 1e5],
    opens_beyond: Some(0.0),
};

/// A stage of four planets, all at the same phase of their meshes, whose ring has bolts; the gears of all meshes.
struct OnBolts {
    gearbox: StaticGearbox,
    gears: Vec<Arc<[ElasticGear; 2]>>,
}

fn on_bolts(bolts: Bolts) -> OnBolts {
    let stage = Stage { count: 4, torque: TORQUE, ..STAGE };
    let (structure, meshes, run) = stage.parts();
    let train = Train::new(&structure, &meshes, &run.keys, run.input, run.sense).unwrap();
    let coupling = BoreCoupling::Elastic(Foundation::new([0.0; 3], Some(bolts)).unwrap());
    let gears = Mutex::new(Vec::new());
    let gearbox = StaticGearbox::new(structure, meshes, run, |i, mesh, meshing| {
        let own = options(&mesh.pair, meshing, TORQUE);
        let mut case = Case::meshed(mesh.pair.clone(), &SECTOR, TORQUE);
        if mesh.discs[1] == RING {
            let angle = train.counted_from(i)[1];
            case.meshes[1] = case.meshes[1].clone().coupled(coupling.counted_from(angle));
        }
        let made = Arc::new(case.reduced_gears(&own));
        gears.lock().unwrap().push(Arc::clone(&made));
        Ok(Box::new(ExactMesh::new(mesh.pair.clone(), made, own)?) as Box<dyn MeshElement>)
    });
    let gearbox = gearbox.unwrap_or_else(|e| panic!("{e}")).joined();
    OnBolts { gearbox, gears: gears.into_inner().unwrap() }
}

fn solve(gearbox: &mut StaticGearbox, angle: f64) -> GearboxPosition {
    let found = gearbox.solve(angle).unwrap_or_else(|e| panic!("{e}"));
    let certificate = &found.certificate;
    assert!(certificate.body_balance < 1e-9 && certificate.iterations < 20, "{certificate:?}");
    found
}

fn radial(found: &GearboxPosition) -> Vec<f64> {
    found.bolts[RING].iter().map(|own| own.radial).collect()
}

fn off(a: &[f64], b: &[f64]) -> f64 {
    let most = b.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / most
}

/// Bolts that are pressed so hard that none opens are springs: how hard makes no difference to lag and meshes, is added to what
/// they carry, and they carry what bolts carry that do not open, which resist along the radius by the place and not by their mean.
#[test]
fn bolts_that_are_pressed_hard_are_springs() {
    let of = |opens_beyond: Option<f64>| {
        let mut own = on_bolts(Bolts { opens_beyond, ..BOLTS });
        solve(&mut own.gearbox, 0.1)
    };
    let [light, hard, closed] = [Some(2e4), Some(5e4), None].map(of);
    let carried =
        |found: &GearboxPosition, preload: f64| -> Vec<f64> { radial(found).iter().map(|own| own - preload).collect() };
    let [a, b, c] = [carried(&light, 2e4), carried(&hard, 5e4), carried(&closed, 0.0)];
    let lag = (light.output_lags[0] / hard.output_lags[0] - 1.0).abs();
    let closed_lag = (light.output_lags[0] / closed.output_lags[0] - 1.0).abs();
    println!("{a:?} N, {c:?} N without opening; lag off by {lag:e}, {closed_lag:e}");
    assert!(light.bolts[RING].iter().all(|own| !own.open));
    // 5e4 N are taken off again.
    assert!(off(&a, &b) < 1e-7 && lag < 1e-10, "{a:?}, {b:?}: lag off by {lag:e}");
    assert!(off(&a, &c) < 0.05 && closed_lag < 1e-3, "{a:?}, {c:?}: lag off by {closed_lag:e}");
}

/// A bolt presses or has lifted off: with the forces of all meshes and bolts on the ring each one that presses is as far in as
/// its force over its stiffness, each that carries nothing stands off; what they carry along the circle is the torque of the ring.
#[test]
fn a_bolt_presses_or_has_lifted_off() {
    for preload in [0.0, 400.0] {
        let mut own = on_bolts(Bolts { opens_beyond: Some(preload), ..BOLTS });
        let found = solve(&mut own.gearbox, 0.1);
        let forces: &[BoltForce] = &found.bolts[RING];
        let mut opening = vec![0.0; forces.len()];
        let mut torque = 0.0;
        for (i, mesh) in (0..own.gears.len()).filter(|i| i % 2 == 1).enumerate() {
            let ElasticGear::Reduced(ring) = &own.gears[mesh][1] else { panic!("reduced") };
            let [_, on_ring] = own.gearbox.flank_forces(mesh).unwrap();
            let on_ring = on_ring.by_node();
            let windows: Vec<_> = (0..80).map(|tooth| ring.window(tooth).unwrap()).collect();
            let all = |w: &&reduction::Window| on_ring.iter().all(|f| w.reduced.position(f.0).is_some());
            let window = windows.iter().find(all).unwrap();
            let known = ring.bolts_and_flanks(window).unwrap();
            for (node, force) in &on_ring {
                let at = window.reduced.position(*node).unwrap();
                for (k, force) in force.iter().enumerate() {
                    (0..forces.len()).for_each(|bolt| opening[bolt] += known.flanks[(3 * at + k, bolt)] * force);
                }
            }
            if i == 0 {
                let own = ring.bolt_compliance().unwrap();
                for (bolt, by) in (0..forces.len()).flat_map(|bolt| (0..forces.len()).map(move |by| (bolt, by))) {
                    opening[bolt] += own.openings[(bolt, by)] * (forces[by].radial - preload);
                }
            }
            torque += found.meshes[mesh].moment[1][2];
        }
        let open = forces.iter().filter(|own| own.open).count();
        println!("preload {preload} N: {forces:?}, openings {opening:?} mm, {open} open");
        assert!(if preload == 0.0 { open > 1 } else { open < 4 }, "{open} open");
        for (own, opening) in forces.iter().zip(&opening) {
            let k = BOLTS.stiffness[0];
            if own.open {
                assert!(k * opening > preload && own.radial.abs() < 1e-9, "{own:?} at {opening} mm");
            } else {
                assert!((own.radial - preload + k * opening).abs() < 1e-4 * TORQUE / OUTSIDE, "{own:?} at {opening}");
            }
        }
        let along: f64 = forces.iter().map(|own| own.tangential * 0.5 * OUTSIDE).sum();
        println!("torque {torque} N mm, bolts {along} N mm");
        assert!((along / torque + 1.0).abs() < 0.01, "{along} beside {torque} N mm");
    }
}

/// Bolts are fixed to the ring, in every mesh of it, though teeth are counted anew round the ring of gears: turned on by a quarter
/// they are to each planet what they were to the one before.
#[test]
fn bolts_stand_at_the_same_places_in_all_meshes_of_a_ring() {
    let of = |first_angle: f64| {
        let mut own = on_bolts(Bolts { first_angle, ..BOLTS });
        solve(&mut own.gearbox, 0.1)
    };
    let [a, b] = [of(BOLTS.first_angle), of(BOLTS.first_angle + FRAC_PI_2)];
    let meshes = |found: &GearboxPosition, on: usize| -> Vec<f64> {
        (0..4).map(|planet| found.meshes[2 * ((planet + on) % 4) + 1].normal_force).collect()
    };
    let [own, turned] = [meshes(&a, 0), meshes(&b, 1)];
    let apart = off(&own, &turned);
    // Bolt 0 of the second is where planet 1 is what planet 0 was to that of the first.
    let forces = off(&radial(&a), &radial(&b));
    println!("{own:?} N, turned {turned:?} N: {apart:e}; bolts {:?} N: {forces:e}", radial(&a));
    assert!(off(&own, &meshes(&a, 1)) > 1e-4, "planets differ by their bolts: {own:?}");
    assert!(apart < 1e-8 && forces < 1e-8, "{apart:e}, {forces:e}");
}
