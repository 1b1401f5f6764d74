//! What CalculiX makes of a deck.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

#[path = "../calculix_pair/mod.rs"]
mod calculix_pair;
mod gearbox_modes;
mod planet_on_rollers;
mod stage;

use std::process::ExitCode;

use calculix_pair::{TORQUE, pair};
use contact::{Method, complementarity::Law, flank::GapSource};
use fem::{ElementOptions, Integration, Material};
use geometry::Side;
use mesh::Extent;
use study::calculix::{Body, Calculix, Deck};
use testing::{Suite, nrel_planet_in_ring};

fn main() -> ExitCode {
    let calculix = Calculix::find(1).map_err(|error| error.to_string());
    Suite::new(file!())
        .needing(&calculix, "calculix_balances_the_torque", balances_the_torque)
        .needing(&calculix, "calculix_agrees_on_a_planet_in_its_ring", agrees_on_a_planet_in_its_ring)
        .needing(&calculix, "calculix_agrees_on_a_box_of_elastic_gears", gearbox_modes::elastic_gears_in_a_box)
        .needing(&calculix, "calculix_agrees_on_a_planet_on_rollers", planet_on_rollers::agrees_on_a_planet_on_rollers)
        .needing(&calculix, "calculix_agrees_on_a_stage", stage::agrees_on_a_stage)
        .run()
}

/// The forces of the pairs balance the torque, and the rotation does not depend on how far the gears were closed
/// beforehand.
fn balances_the_torque(calculix: Calculix) {
    let model = pair(2);
    let scratch = tempfile::tempdir().unwrap();
    let deck = model.deck();
    let run = calculix.run(&deck, scratch.path()).unwrap_or_else(|e| panic!("{e}"));
    let radius = model.pair.wheel.base_radius();
    let te = 1e3 * radius * run.result.rotation;
    let sizes: Vec<f64> = run.result.pairs.iter().map(|p| p.size()).collect();
    assert!((5.0..20.0).contains(&te), "TE {te} um");
    // About the wheel's axis: the moment about the origin less that of the force at the axis.
    let a = model.pair.centre_distance();
    let torque: f64 = run.result.pairs.iter().map(|p| p.moment[2] - a * p.force[1]).sum();
    assert!((torque.abs() / TORQUE - 1.0).abs() < 2e-3, "{torque} N mm about the wheel's axis");
    let normal = TORQUE / radius / model.pair.base_helix_angle().cos();
    let sum: f64 = sizes.iter().sum();
    assert!((sum / normal - 1.0).abs() < 0.01, "{sum} N on the flanks, {normal} N by the torque");
    let other = calculix.run(&Deck { closing: 2.0 * deck.closing, ..deck }, scratch.path()).unwrap();
    let off = other.result.rotation / run.result.rotation - 1.0;
    assert!(off.abs() < 1e-3, "closed twice as far: rotation {off:e} off");
}

/// A planet in its ring on the same meshes: pressed points, penalty 1e7 MPa/mm, gaps of the quadratic faces, hex20 with full
/// integration on both sides: 0.1 %. Where a third pair presses with its tip edge on a part of a face, which CalculiX cuts where
/// faces meet, that takes many points: with 8, 16, 24, 32, 48 and 64 points an edge of a face the program is -0.31, +0.36,
/// +0.57, -0.06, -0.05 and -0.09 % off. From 32 on it stays.
fn agrees_on_a_planet_in_its_ring(calculix: Calculix) {
    let mut case = nrel_planet_in_ring(0.02, [8, 4, 3, 2, 2], Extent::Sector(5));
    case.elements = ElementOptions { integration: Integration::Full, ..ElementOptions::default() };
    let solved = |phase: f64, points: usize| {
        let options = case.options().with_contact(|c| {
            (c.method, c.law, c.gap) = (Method::Nodal, Law::Penalty(1e7), GapSource::Facet);
            c.points_per_face_edge = points;
        });
        case.reduced(options).solve(ale::Station { cycle: 0, phase }).unwrap_or_else(|e| panic!("{e}"))
    };
    let (pair, side, steel) = (&case.pair, Side::Left, Material::STEEL);
    let radius = pair.wheel.base_radius().abs();
    for (phase, points) in [(0.0, &[8, 32][..]), (0.5, &[32, 48, 64])] {
        let all: Vec<_> = points.iter().map(|points| solved(phase, *points)).collect();
        let p = &all[0];
        let angle = pair.middle_angle(side) + (p.mesh_phase - 0.5) * pair.pinion.pitch_angle();
        let angles = [angle, pair.wheel_angle(side, angle)];
        let pairs: Vec<[u32; 2]> = (-1i64..=1).map(|k| [k.rem_euclid(36) as u32, (-k).rem_euclid(93) as u32]).collect();
        let body = |i: usize| Body {
            gear: &case.meshes[i],
            material: &steel,
            angle: angles[i],
            centre: [[0.0, 0.0], [pair.centre_distance(), 0.0]][i],
        };
        let deck = Deck {
            bodies: [body(0), body(1)],
            driven: 1,
            side,
            pairs: &pairs,
            torque: case.torque,
            closing: 1e-3 / radius,
            penalty: 1e7,
        };
        let folder = tempfile::tempdir().unwrap();
        let run = calculix.run(&deck, folder.path()).unwrap_or_else(|e| panic!("{e}"));
        let other = radius * run.result.rotation;
        for (p, points) in all.iter().zip(points) {
            let own = p.transmission_error;
            println!(
                "s {:.3}, {points} points: STE {:.4} um, CalculiX {:.4} um, {:+.3} %; pairs {:.0?} N, {:.0?} N",
                p.mesh_phase,
                1e3 * own,
                1e3 * other,
                100.0 * (own / other - 1.0),
                p.pairs.iter().map(|q| q.normal_force).collect::<Vec<_>>(),
                run.result.pairs.iter().map(|q| q.size()).collect::<Vec<_>>()
            );
            assert!((own / other - 1.0).abs() < 1e-3, "{points} points: {own} mm, CalculiX {other} mm");
        }
    }
}
