//! Gears in several meshes as one elastic body: every mesh hears the others.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::sync::Arc;

use gearbox::{ExactMesh, GearMesh, GearboxPosition, MeshElement, Operation, StaticGearbox, Structure};
use mesh::{BoreCoupling, Foundation, MeshedGear, StructuredOptions};
use testing::Case;

use crate::{
    idlers::row,
    pairs::{SECTOR, options, reduced},
    planets::{STAGE, Stage},
};

type Parts = (Structure, Vec<GearMesh>, Operation);

/// The gearbox with exact contacts, bores held by a coupling, each mesh alone on the bodies of its gears or joined with the
/// others.
fn exact((structure, meshes, run): Parts, torque: f64, coupling: BoreCoupling, joined: bool) -> StaticGearbox {
    let made = StaticGearbox::new(structure, meshes, run, |_, mesh, meshing| {
        let own = options(&mesh.pair, meshing, torque);
        let mut case = Case::meshed(mesh.pair.clone(), &SECTOR, torque);
        case.meshes = case.meshes.map(|own: MeshedGear| own.coupled(coupling));
        let gears = Arc::new(case.reduced_gears(&own));
        Ok(Box::new(ExactMesh::new(mesh.pair.clone(), gears, own)?) as Box<dyn MeshElement>)
    });
    let made = made.unwrap_or_else(|e| panic!("{e}"));
    if joined { made.joined() } else { made }
}

/// Springs all around a bore, as soft as a needle bearing's.
fn on_springs() -> BoreCoupling {
    BoreCoupling::Elastic(Foundation::new([2e3, 1e3, 1e3], None).unwrap())
}

fn solve(gearbox: &mut StaticGearbox, angle: f64) -> GearboxPosition {
    let found = gearbox.solve(angle).unwrap_or_else(|e| panic!("{e}"));
    let certificate = &found.certificate;
    assert!(certificate.body_balance < 1e-9 && certificate.iterations < 20, "{certificate:?}");
    found
}

/// Planets, all at the same phase of their meshes, carry alike, whoever of them is looked at: sun and ring pass on between all
/// of them what turns with the stage, though teeth are counted anew round the ring of gears. Rigid bores let bodies pass on
/// little, bores that are held by their means or on springs let them pass on more.
#[test]
fn planets_at_one_phase_carry_alike_on_common_bodies() {
    let stage = Stage { count: 4, torque: 2e5, ..STAGE };
    let passed_on = [BoreCoupling::Kinematic, BoreCoupling::Distributing, on_springs()].map(|coupling| {
        let mut lags = [[0.0; 2]; 2];
        for (joined, lags) in [false, true].into_iter().zip(&mut lags) {
            let mut gearbox = exact(stage.parts(), stage.torque, coupling, joined);
            for (angle, lag) in [0.0, 0.11].into_iter().zip(lags) {
                let found = solve(&mut gearbox, angle);
                for kind in 0..2 {
                    let force = |n: usize| found.meshes[2 * n + kind].normal_force;
                    let off = (1..4).map(|n| (force(n) / force(0) - 1.0).abs()).fold(0.0, f64::max);
                    println!("{coupling:?}, joined {joined}, {angle} rad, kind {kind}: planets apart by {off:.1e}");
                    assert!(off < 1e-9, "{coupling:?}, joined {joined}: planets carry {off:e} more or less");
                }
                *lag = found.output_lags[0];
            }
        }
        println!("{coupling:?}: lags {:?} rad alone, {:?} rad on common bodies", lags[0], lags[1]);
        lags[0].iter().zip(&lags[1]).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
    });
    let [rigid, means, springs] = passed_on;
    assert!(rigid > 1e-4 && means > 2.0 * rigid, "the lag changes by {rigid:e} of itself, and by {means:e}");
    assert!(springs > 2.0 * rigid, "the lag changes by {rigid:e} of itself, and by {springs:e}");
}

/// Windows of both meshes of an idler change their teeth at instants of their own; the compliance between them goes with the
/// teeth, and nothing jumps.
#[test]
fn nothing_jumps_where_teeth_change_on_a_common_body() {
    use BoreCoupling::{Distributing, Kinematic};
    for (helix_deg, coupling) in [(0.0, Kinematic), (15.0, Kinematic), (15.0, Distributing), (15.0, on_springs())] {
        let mut gearbox = exact(row(1.0, helix_deg, true), 1.5e5, coupling, true);
        let pitch = std::f64::consts::TAU / 20.0;
        let mut changes = 0;
        for mesh in 0..2 {
            // Where a cycle ends, and teeth change.
            let of = |gearbox: &StaticGearbox, angle: f64| gearbox.train().cycles(angle)[mesh];
            let at = of(&gearbox, 0.0);
            let slope = of(&gearbox, 1.0) - at;
            for turn in 1..4 {
                let angle = (f64::from(turn) - at.rem_euclid(1.0)) / slope;
                let step = 1e-9 * pitch;
                let [before, after] = [solve(&mut gearbox, angle - step), solve(&mut gearbox, angle + step)];
                let lag = |p: &GearboxPosition| p.output_lags[0];
                let jump = (lag(&after) - lag(&before)).abs() / lag(&before).abs();
                let cycles = [&before, &after].map(|p| p.meshes[mesh].cycles.floor());
                assert!(cycles[0] != cycles[1], "a cycle ends: {cycles:?}");
                changes += 1;
                assert!(jump < 1e-8, "helix {helix_deg}, mesh {mesh}: the lag jumps by {jump:e} of itself");
                println!(
                    "helix {helix_deg}, mesh {mesh}, turn {turn}: lag moves by {jump:.1e} of itself in {:.0e} pitches",
                    2e-9
                );
            }
        }
        assert_eq!(changes, 6);
    }
}

/// What goes in comes out, whatever the bodies pass on: the mean torque of the input over a cycle of both meshes is that of
/// the load by the teeth of pinion and wheel, for the contact has one energy.
#[test]
fn common_bodies_keep_energy() {
    let mut gearbox = exact(row(1.0, 15.0, false), 1.5e5, BoreCoupling::Kinematic, true);
    let ratio = gearbox.train().ratios()[2];
    let mut torque = |k: u32| solve(&mut gearbox, std::f64::consts::TAU / 20.0 * f64::from(k) / 64.0).input_torque;
    let off = (0..64).map(&mut torque).sum::<f64>() / 64.0 / (1.5e5 * ratio) - 1.0;
    println!("mean torque off by {off:.1e}");
    // Trapezoids over slices that come into contact one by one.
    assert!(off.abs() < 1e-5, "{off:e}");
}

/// Meshes that no gear joins are what they are alone, to the bit.
#[test]
fn meshes_without_a_common_gear_are_not_joined() {
    let (structure, meshes) = crate::pairs::two_stages();
    let run =
        crate::pairs::operation(&structure, 4, geometry::Sense::Ccw, vec![gearbox::Torque { disc: 5, torque: -4e5 }]);
    let parts = || (structure.clone(), meshes.clone(), run.clone());
    let [a, b] = [false, true].map(|joined| solve(&mut exact(parts(), 1e5, BoreCoupling::Kinematic, joined), 0.1));
    assert_eq!(a.output_lags, b.output_lags);
}

/// A gear that is reduced in two ways, or from two meshes, has no common body, and that is said.
#[test]
fn a_gear_of_two_meshes_of_its_own_is_refused() {
    let (structure, meshes, run) = row(1.0, 0.0, true);
    let made = StaticGearbox::new(structure, meshes, run, |i, mesh, meshing| {
        let own = options(&mesh.pair, meshing, 1.5e5);
        let gears = if i == 0 {
            reduced(&mesh.pair, &own)
        } else {
            let finer = StructuredOptions { elements_face: 4, ..SECTOR };
            Arc::new(Case::meshed(mesh.pair.clone(), &finer, 1.5e5).reduced_gears(&own))
        };
        Ok(Box::new(ExactMesh::new(mesh.pair.clone(), gears, own)?) as Box<dyn MeshElement>)
    });
    let refused = made.unwrap().joined().solve(0.0).unwrap_err();
    assert!(refused.to_string().contains("another mesh"), "{refused}");
    assert!(refused.hint().is_some_and(|hint| hint.contains("same mesh")), "{:?}", refused.hint());
}
