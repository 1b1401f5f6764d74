//! What CalculiX makes of a deck.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

#[path = "../calculix_pair/mod.rs"]
mod calculix_pair;
mod gearbox_modes;

use std::process::ExitCode;

use calculix_pair::{TORQUE, pair};
use contact::{Method, complementarity::Law, flank::GapSource};
use fem::{ElementOptions, Integration, Material};
use geometry::{GearData, Shaper, Side};
use mesh::Extent;
use study::calculix::{Body, Calculix, Deck};
use testing::{Case, Suite, quadratic};

fn main() -> ExitCode {
    let calculix = Calculix::find(1).map_err(|error| error.to_string());
    Suite::new(file!())
        .needing(&calculix, "calculix_balances_the_torque", balances_the_torque)
        .needing(&calculix, "calculix_agrees_on_a_planet_in_its_ring", agrees_on_a_planet_in_its_ring)
        .needing(&calculix, "calculix_agrees_on_a_box_of_elastic_gears", gearbox_modes::elastic_gears_in_a_box)
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

/// The planet and the ring of the second stage of NREL's 5 MW reference gearbox, a seventh of their size, the planet on its axis, under 250 N a mm of 12 mm face.
fn planet_in_ring() -> Case {
    let data = GearData {
        normal_module: 3.0,
        helix_angle: 0.0,
        face_width: 12.0,
        thickness_allowance: 0.02,
        ..GearData::default()
    };
    let planet = GearData {
        teeth: 36,
        profile_shift: 0.5039,
        bore_diameter: 60.0,
        tip_diameter: Some(36.0 * 3.0 + 2.0 * (3.0 * 1.5039 - 0.25)),
        ..data.clone()
    };
    let ring = GearData {
        teeth: 93,
        profile_shift: 0.1171,
        bore_diameter: -310.0,
        root_radius_coefficient: 0.3,
        shaper: Some(Shaper { teeth: 30, profile_shift: 0.0 }),
        ..data
    };
    quadratic([planet, ring], Some(-584.0 / 7.0), 250.0 * 12.0 * 131.1, [8, 4, 3, 2, 2], Extent::Sector(5))
}

/// A planet in its ring on the same meshes: pressed points, penalty 1e7 MPa/mm, gaps of the quadratic faces, hex20 with full integration on both sides: 0.1 %. Where a third pair presses with its tip edge on a part of a face, points must be four times as close in each direction: with 8, 16 and 32 points an edge of a face the program is 0.31 % below, 0.36 % above and 0.06 % below CalculiX, which cuts faces where they meet.
fn agrees_on_a_planet_in_its_ring(calculix: Calculix) {
    let mut case = planet_in_ring();
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
    for p in [solved(0.0, 8), solved(0.5, 32)] {
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
        let [own, other] = [p.transmission_error, radius * run.result.rotation];
        println!(
            "s {:.3}: STE {:.4} um, CalculiX {:.4} um, {:+.3} %; pairs {:.0?} N, {:.0?} N",
            p.mesh_phase,
            1e3 * own,
            1e3 * other,
            100.0 * (own / other - 1.0),
            p.pairs.iter().map(|q| q.normal_force).collect::<Vec<_>>(),
            run.result.pairs.iter().map(|q| q.size()).collect::<Vec<_>>()
        );
        assert!((own / other - 1.0).abs() < 1e-3, "{own} mm, CalculiX {other} mm");
    }
}
