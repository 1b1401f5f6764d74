//! A pinion in a ring at rest: laws, search, reduced gears and full ones.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use geometry::{Driver, Gear, GearData, GearPair};
use ltca::{StaticHistory, StaticOptions};
use mesh::{Extent, GroupNames, MeshedGear, StructuredOptions};
use testing::{Case, nrel_planet_in_ring, planet_in_ring, quadratic};

fn case(beta_deg: f64, extent: Extent) -> Case {
    quadratic(planet_in_ring(beta_deg), None, 300e3, [4, 4, 2, 4, 2], extent)
}

fn run(case: &Case, positions: usize) -> StaticHistory {
    case.reduced(case.slice_options()).run(positions, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"))
}

/// Meshes of a ring: sound elements, a volume between tip and outside, all teeth copies of one, flanks on their helicoids as the fit finds them.
#[test]
fn the_mesher_makes_rings() {
    for beta in [0.0, 25.0] {
        let [_, ring] = planet_in_ring(beta).map(|d| Gear::new(d).unwrap());
        let options = StructuredOptions {
            elements_profile: 4,
            elements_face: 4,
            elements_rim: 3,
            ..StructuredOptions::default()
        };
        let mesh = mesh::generate(&ring, &options).unwrap_or_else(|e| panic!("{e}"));
        let unnamed = mesh::Mesh { surfaces: Vec::new(), ..mesh.clone() };
        let (found, fit) = MeshedGear::find(unnamed, &ring, &GroupNames::default()).unwrap_or_else(|e| panic!("{e}"));
        let fit = fit.unwrap();
        assert!(fit.largest_deviation() < 1e-6, "{} mm off", fit.largest_deviation());
        assert_eq!(fit.flanks.len(), 104, "flanks");
        assert!(fit.flanks.iter().all(|f| f.coverage > 0.98), "{:?}", fit.flanks[0]);
        let named = MeshedGear::find(mesh, &ring, &GroupNames::default()).unwrap().0;
        for tooth in [0, 1, 51] {
            for side in [geometry::Side::Left, geometry::Side::Right] {
                let nodes = |gear: &MeshedGear| {
                    let mut all: Vec<u32> =
                        gear.flank(tooth, side).unwrap().iter().flat_map(|f| f.nodes()).copied().collect();
                    all.sort_unstable();
                    all.dedup();
                    all
                };
                assert_eq!(nodes(&found), nodes(&named), "tooth {tooth} {side:?}");
            }
        }
        assert_eq!(found.bore_nodes(), named.bore_nodes());
    }
}

/// Torque, contact and action = reaction close; the whole gear and its sector have the same answer.
#[test]
fn a_ring_under_load_obeys_the_laws() {
    for beta in [0.0, 20.0] {
        let whole = case(beta, Extent::Whole);
        let sector = case(beta, Extent::Periodic);
        let [a, b] = [run(&whole, 4), run(&sector, 4)];
        for (p, q) in a.positions.iter().zip(&b.positions) {
            let certificate = &p.certificate;
            assert!(certificate.torque_residual < 1e-9, "torque {}", certificate.torque_residual);
            assert!(certificate.complementarity_residual < 1e-9, "{}", certificate.complementarity_residual);
            assert!(certificate.action_reaction_residual < 1e-12, "{}", certificate.action_reaction_residual);
            println!("beta {beta}, s {}: STE {} um, {} pairs", p.mesh_phase, 1e3 * p.transmission_error, p.pairs.len());
            assert!(p.transmission_error > 0.0, "the driven ring lags");
            let off = (p.transmission_error / q.transmission_error - 1.0).abs();
            assert!(off < 1e-8, "whole {} and sector {}", p.transmission_error, q.transmission_error);
        }
    }
}

/// All degrees of freedom kept, or reduced: the same answer.
#[test]
fn reduced_gears_are_the_full_ones() {
    let case = case(20.0, Extent::Sector(5));
    let reduced = run(&case, 2);
    let full = case.full(case.slice_options()).run(2, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"));
    for (p, q) in reduced.positions.iter().zip(&full.positions) {
        let off = (p.transmission_error / q.transmission_error - 1.0).abs();
        assert!(off < 1e-7, "reduced {} and full {}", p.transmission_error, q.transmission_error);
    }
}

/// The ring drives as well as the pinion: the same flanks under the same base force have the same approach; and the other sense is the mirror image of a spur pair.
#[test]
fn the_ring_drives_too() {
    let case = case(0.0, Extent::Periodic);
    let pair: &GearPair = &case.pair;
    let ratio = pair.pinion.base_radius() / pair.wheel.base_radius().abs();
    let with = |driver: Driver, sense: geometry::Sense, torque: f64| {
        let mut options = case.slice_options().with_contact(|c| (c.driver, c.sense) = (driver, sense));
        options.torque = torque;
        case.reduced(options).run(3, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"))
    };
    let torque = case.torque;
    let [first, mirrored] = [geometry::Sense::Ccw, geometry::Sense::Cw].map(|s| with(Driver::Pinion, s, torque));
    // The ring drives clockwise, so that the same left flanks carry.
    let back = with(Driver::Wheel, geometry::Sense::Cw, torque * ratio);
    for ((p, q), r) in first.positions.iter().zip(&mirrored.positions).zip(&back.positions) {
        let [p, q, r] = [p, q, r].map(|x| x.transmission_error);
        assert!((p / q - 1.0).abs() < 1e-6, "mirrored: {p} and {q}");
        println!("pinion drives {p}, ring drives {r}");
    }
    let mean = |h: &StaticHistory| h.positions.iter().map(|p| p.transmission_error).sum::<f64>() / 3.0;
    assert!((mean(&first) / mean(&back) - 1.0).abs() < 0.02, "{} and {}", mean(&first), mean(&back));
}

/// Below the loaded flank a root is pulled, behind it pressed, in pinion and ring, in the fillet and not on the flank; the whole ring and a sector of
/// five teeth, reduced gears and full ones have one root stress.
#[test]
fn roots_of_a_ring_are_pulled_below_the_load() {
    let stressed = |case: &Case| StaticOptions { root_stress: true, ..case.slice_options() };
    let [whole, five] = [Extent::Periodic, Extent::Sector(5)].map(|extent| case(20.0, extent));
    let history = whole.reduced(stressed(&whole)).run(3, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"));
    let side = geometry::Side::Left;
    for p in &history.positions {
        let heaviest = p.pairs.iter().max_by(|a, b| a.normal_force.total_cmp(&b.normal_force)).unwrap();
        for (gear, tooth) in [heaviest.pinion_tooth, heaviest.wheel_tooth].into_iter().enumerate() {
            let of = |side| *p.root_stress[gear].iter().find(|f| (f.tooth, f.side) == (tooth, side)).unwrap();
            let (pulled, pressed) = (of(side), of(side.opposite()));
            let at = format!("phase {}, gear {gear}, tooth {tooth}", p.mesh_phase);
            println!("{at}: {:.2} and {:.2} MPa", pulled.max_principal.stress, pressed.min_principal.stress);
            assert!(pulled.max_principal.stress > 1.5 * pressed.max_principal.stress, "{at}: {pulled:?} {pressed:?}");
            assert!(-pressed.min_principal.stress > 1.5 * pressed.max_principal.stress, "{at}: {pressed:?}");
            let exact = [&whole.pair.pinion, &whole.pair.wheel][gear];
            let mut ends = [exact.root_radius().abs(), exact.form_radius().abs()];
            ends.sort_by(f64::total_cmp);
            for peak in [pulled.max_principal, pressed.min_principal] {
                assert!(ends[0] - 1e-3 < peak.radius && peak.radius < ends[1] + 1e-3, "{at}: {peak:?}, {ends:?}");
            }
        }
    }
    let reduced = five.reduced(stressed(&five)).run(1, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"));
    let full = five.full(stressed(&five)).run(1, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"));
    for gear in 0..2 {
        for (a, b) in reduced.positions[0].root_stress[gear].iter().zip(&full.positions[0].root_stress[gear]) {
            let [a, b] = [a, b].map(|f| f.max_principal.stress);
            assert!((a - b).abs() < 1e-6 * a.abs().max(1.0), "gear {gear}: reduced {a} MPa, full {b} MPa");
        }
    }
}

/// Transmission errors of a planet in its ring on the default mesh are those of meshes finer in every direction: 0.3 %. The mean stiffness
/// is that of ISO 6336-1 within 25 %: c_gamma_alpha 20.563 N/(mm um) after KISSsoft, with the solid bodies of its gears.
#[test]
fn a_planet_in_its_ring_is_settled_and_as_stiff_as_iso_says() {
    let solved = |counts| {
        let case = nrel_planet_in_ring(GearData::default().thickness_allowance, counts, Extent::Periodic);
        case.reduced(case.slice_options()).run(4, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"))
    };
    let default = solved([6, 6, 4, 6, 5]);
    let finer = if testing::cases(1, 2) == 1 { [9, 9, 6, 9, 8] } else { [12, 12, 8, 12, 10] };
    for (own, settled) in default.positions.iter().zip(&solved(finer).positions) {
        let [a, b] = [own, settled].map(|p| 1e3 * p.transmission_error);
        println!("s {:.2}: {a:.4} um, {b:.4} on the finer mesh, {:+.3} %", own.mesh_phase, 100.0 * (a / b - 1.0));
        assert!((a / b - 1.0).abs() < 3e-3, "s {}: {a} um, {b} on the finer mesh", own.mesh_phase);
    }
    let mean = default.positions.iter().map(|p| 1e-3 * p.secant_stiffness / 12.0).sum::<f64>() / 4.0;
    let off = mean / 20.563 - 1.0;
    println!("mean stiffness {mean:.3} N/(mm um), ISO 20.563, {:+.1} %", 100.0 * off);
    assert!(off.abs() < 0.25, "mean stiffness {mean} N/(mm um), {off} off");
}
