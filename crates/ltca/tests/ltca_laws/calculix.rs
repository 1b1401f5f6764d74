//! `nodal` contact with penalty 1e7 MPa/mm against CalculiX on the same meshes.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]
//!
//! Source: CalculiX 2.20, surface-to-surface penalty 1e7 MPa/mm, frictionless, 2026; meshes by Gmsh,
//! `meshes/reference/` (sector of 5 teeth a gear, cut faces free, bore rigid). Default pair, 150 N m. Numbers of each
//! position as the program printed them. Tolerances: mean STE 0.5 %, peak to peak 5 %, pair forces 1 % of the total.

use contact::{complementarity::Law, flank::GapSource};
use fem::{ElementOptions, IncompatibleModes, Integration};
use ltca::{StaticHistory, StaticModel};
use testing::{Case, mean_and_peak_to_peak};

/// STE [um] and forces (N) of pairs -1, 0, +1 at s = 0, 1/8 .. 7/8.
struct Reference {
    ste_um: [f64; 8],
    pair_force_n: [[f64; 3]; 8],
}

const COARSE_C3D8I: Reference = Reference {
    ste_um: [12.6867, 12.8727, 13.3282, 13.653, 13.6791, 13.6466, 13.34, 12.8707],
    pair_force_n: [
        [0.0, 1817.8, 1727.7],
        [0.0, 2100.9, 1445.3],
        [0.0, 2358.0, 1187.1],
        [125.5, 2574.8, 844.7],
        [494.5, 2551.0, 498.3],
        [840.9, 2577.5, 126.3],
        [1184.9, 2363.1, 0.0],
        [1440.4, 2104.1, 0.0],
    ],
};

const Q_COARSE_C3D20R: Reference = Reference {
    ste_um: [9.5111, 9.6751, 10.1112, 10.4042, 10.3224, 10.4053, 10.1186, 9.6796],
    pair_force_n: [
        [0.0, 1820.6, 1726.7],
        [0.0, 2067.6, 1479.6],
        [0.0, 2327.7, 1219.6],
        [155.3, 2492.4, 899.6],
        [525.2, 2488.9, 533.1],
        [892.0, 2495.2, 160.1],
        [1213.6, 2333.7, 0.0],
        [1474.2, 2073.1, 0.0],
    ],
};

fn run(mesh: &str, elements: ElementOptions, gap: GapSource) -> StaticHistory {
    let case = Case::reference(mesh, elements);
    let mut options = case.options();
    options.contact.law = Law::Penalty(1e7);
    options.contact.gap = gap;
    options.contact.points_per_face_edge = 8;
    let mut model: StaticModel = case.reduced(options);
    model.run(8, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{mesh}: {e}"))
}

fn compare(name: &str, history: &StaticHistory, reference: &Reference) {
    let (mean, swing) = mean_and_peak_to_peak(history.positions.iter().map(|p| 1e3 * p.transmission_error));
    let (wanted_mean, wanted_swing) = mean_and_peak_to_peak(reference.ste_um.iter().copied());
    println!("{name}: mean {mean:.4} um (CalculiX {wanted_mean:.4}), p-p {swing:.4} um ({wanted_swing:.4})");
    for (p, (ste, wanted)) in history.positions.iter().zip(reference.ste_um.iter().zip(&reference.pair_force_n)) {
        let total: f64 = p.pairs.iter().map(|q| q.normal_force).sum();
        println!(
            "  s {:.3}: STE {:.4} ({ste}), pairs {:.1?} ({wanted:?}) N",
            p.mesh_phase,
            1e3 * p.transmission_error,
            p.pairs.iter().map(|q| q.normal_force).collect::<Vec<_>>()
        );
        for (q, wanted) in p.pairs.iter().zip(wanted) {
            let off = (q.normal_force - wanted) / total;
            assert!(
                off.abs() < 0.01,
                "{name}, s = {}: pair {} carries {} N, CalculiX {wanted} N",
                p.mesh_phase,
                q.pair,
                q.normal_force
            );
        }
    }
    assert!((mean / wanted_mean - 1.0).abs() < 0.005, "{name}: mean STE {mean} um, CalculiX {wanted_mean} um");
    assert!((swing / wanted_swing - 1.0).abs() < 0.05, "{name}: peak to peak {swing} um, CalculiX {wanted_swing} um");
}

/// hex20, reduced integration on both sides of the comparison.
#[test]
fn hex20_sector_agrees() {
    let elements = ElementOptions { integration: Integration::Reduced, ..ElementOptions::default() };
    compare("q_coarse C3D20R", &run("ref_qcoarse_hex20", elements, GapSource::Smooth), &Q_COARSE_C3D20R);
}

/// hex8 with the gaps of the flat faces, as CalculiX sees them: the 13.26 um come out; with smooth gaps 9.63 um do.
#[test]
fn facet_gaps_explain_the_hex8_result() {
    let elements =
        ElementOptions { incompatible_modes: IncompatibleModes::WithoutJacobianRatio, ..ElementOptions::default() };
    compare("coarse C3D8I", &run("ref_coarse_hex8", elements, GapSource::Facet), &COARSE_C3D8I);
    let smooth = run("ref_coarse_hex8", elements, GapSource::Smooth);
    let (mean, _) = mean_and_peak_to_peak(smooth.positions.iter().map(|p| 1e3 * p.transmission_error));
    println!("coarse C3D8I, smooth gaps: mean {mean:.4} um (reference 9.63)");
    assert!((mean / 9.63 - 1.0).abs() < 0.01, "smooth gaps: mean STE {mean} um, not 9.63 um");
}
