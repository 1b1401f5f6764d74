//! Regression on the meshes that Gmsh wrote (`meshes/`): what comes out of each of them.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use fem::{ElementOptions, Material};
use geometry::Sense;
use ltca::StaticHistory;
use mesh::{GroupNames, Mesh, MeshedGear};
use reduction::ElasticGear;
use testing::{Case, mean_and_peak_to_peak, meshes_folder};

fn run(pinion: &str, wheel: &str) -> (StaticHistory, bool) {
    let case = Case::read(pinion, wheel, ElementOptions::default());
    let mut model = case.reduced(case.options().with_contact(|c| c.sense = Sense::Ccw));
    let cyclic = model.gears().iter().all(|g| matches!(g, ElasticGear::Reduced(r) if r.is_cyclic()));
    (model.run(8, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{pinion}: {e}")), cyclic)
}

/// Whole gears of rising fineness: the transmission error grows as the local approach is resolved (the reference sector
/// shows the same), all equilibrium certificates hold, and Gmsh's rotated sectors are recognised as cyclic.
#[test]
fn whole_gear_pairs() {
    let mut means = Vec::new();
    for name in ["coarse_hex8", "medium_hex8", "coarse_hex20"] {
        let (history, cyclic) = run(&format!("{name}_pinion.msh"), &format!("{name}_wheel.msh"));
        let (mean, swing) = mean_and_peak_to_peak(history.positions.iter().map(|p| 1e3 * p.transmission_error));
        println!("{name}: mean STE {mean:.3} um, peak to peak {swing:.3} um");
        assert!(cyclic, "{name} is cyclic");
        for p in &history.positions {
            let c = &p.certificate;
            assert!(c.torque_residual < 1e-8 && c.complementarity_residual < 1e-10, "{name}: {c:?}");
        }
        means.push(mean);
    }
    // Reference (validation.md): the whole gear lies at 8.30 um on a coarse hex8 mesh of ten elements along the
    // profile; these have four and eight. hex20 with four is softer than hex8 with eight.
    assert!(means[0] < means[1] && means[1] < means[2], "{means:?}");
    assert!((means[1] / 8.30 - 1.0).abs() < 0.10, "medium hex8: {} um", means[1]);
}

/// One periodic sector, repeated, is the whole gear: the same answer.
#[test]
fn a_periodic_sector_is_the_whole_gear() {
    let (whole, _) = run("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh");
    let mut case = Case::read("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh", ElementOptions::default());
    let sector = Mesh::read(meshes_folder().join("periodic_hex8.msh")).unwrap();
    case.meshes[0] = MeshedGear::from_groups(sector, &GroupNames::default(), 30).unwrap().whole().unwrap();
    let from_sector = case.reduced(case.options()).run(8, 1, |_, _, _| ()).unwrap();
    for (a, b) in whole.positions.iter().zip(&from_sector.positions) {
        let off = a.transmission_error / b.transmission_error - 1.0;
        assert!(off.abs() < 1e-9, "phase {}: {off:e}", a.mesh_phase);
    }
}

/// Every flavour of one mesh gives the same model, node for node.
#[test]
fn every_flavour_is_the_same_model() {
    let read = |flavour: &str| {
        let mesh = Mesh::read(meshes_folder().join(format!("sector3_hex8_{flavour}.msh"))).unwrap();
        MeshedGear::from_groups(mesh, &GroupNames::default(), 30).unwrap()
    };
    let first = read("v41_binary");
    for flavour in ["v41_ascii", "v22_binary", "v22_ascii"] {
        let other = read(flavour);
        assert_eq!(first.teeth(), other.teeth(), "{flavour}");
        assert_eq!(first.bore_nodes(), other.bore_nodes(), "{flavour}");
        for tooth in first.teeth() {
            for side in [geometry::Side::Left, geometry::Side::Right] {
                assert_eq!(first.flank(tooth, side), other.flank(tooth, side), "{flavour}: tooth {tooth}");
            }
        }
        assert_eq!(first.mesh().blocks, other.mesh().blocks, "{flavour}");
        // Gmsh writes 16 digits: its text is off by one unit in the last place.
        let far = first.mesh().nodes.iter().flatten().zip(other.mesh().nodes.iter().flatten());
        let worst = far.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-14 * 60.0, "{flavour}: nodes {worst:e} mm apart");
    }
}

/// Phi_IC against direct solves K_II u = -K_IB e on a gear that Gmsh meshed: 1e-10.
#[test]
fn constraint_modes_equal_direct_solves() {
    let case = Case::read("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh", ElementOptions::default());
    let model = case.reduced(case.options());
    let ElasticGear::Reduced(gear) = &model.gears()[0] else { unreachable!() };
    let window = &model.contact_set().windows().unwrap()[0];
    let boundary: Vec<usize> = window
        .reduced
        .nodes
        .iter()
        .flat_map(|&n| (0..3).map(move |axis| (n, axis)))
        .map(|(n, axis)| gear.dofs().dof(n, axis).unwrap())
        .collect();
    let columns = [0, 100, window.reduced.coordinates() - 1];
    let modes = gear.constraint_modes(&columns).unwrap();
    // K_II alone, factored anew: the interior block of the assembled stiffness.
    let (mesh, elements) = (gear.gear().mesh(), gear.elements());
    let stiffness = fem::assemble_stiffness(mesh, gear.material(), gear.dofs(), elements).unwrap();
    let n = stiffness.n();
    let mut interior = vec![usize::MAX; n];
    let mut count = 0;
    for (dof, number) in interior.iter_mut().enumerate() {
        if !boundary.contains(&dof) {
            *number = count;
            count += 1;
        }
    }
    let inside = |d: usize| interior[d] != usize::MAX;
    let entries: Vec<_> = stiffness
        .entries()
        .filter(|&(i, j, _)| inside(i) && inside(j))
        .map(|(i, j, v)| (interior[i], interior[j], v))
        .collect();
    let k_ii = fem::SymmetricMatrix::from_triplets(count, &entries).unwrap();
    let factor = fem::BoundaryLastFactor::new(&k_ii, &[]).unwrap();
    for (c, &column) in columns.iter().enumerate() {
        let mut rhs = faer::Mat::<f64>::zeros(count, 1);
        for (i, j, v) in stiffness.entries() {
            for (row, from) in [(i, j), (j, i)] {
                if inside(row) && from == boundary[column] {
                    rhs[(interior[row], 0)] -= v;
                }
            }
        }
        factor.solve(rhs.as_mut()).unwrap();
        let mut worst = 0.0f64;
        for dof in (0..n).filter(|&d| inside(d)) {
            worst = worst.max((rhs[(interior[dof], 0)] - modes[(dof, c)]).abs());
        }
        println!("mode {column}: {worst:.1e} from the direct solve (unit displacement)");
        assert!(worst < 1e-10, "mode {column}: {worst:e}");
    }
}

/// M^ = T' M T: a rigid motion of the whole gear is outside it (the bore is held), but mass is symmetric positive and a
/// flank motion's kinetic energy equals that of the field it stands for.
#[test]
fn condensed_mass_has_the_fields_energy() {
    let case = testing::generated(20.0, [2, 2, 2, 3, 1]);
    let model = case.reduced(case.options());
    let ElasticGear::Reduced(gear) = &model.gears()[0] else { unreachable!() };
    let window = &model.contact_set().windows().unwrap()[0];
    let mass = gear.condensed_mass().unwrap();
    let n = window.reduced.coordinates();
    let u: Vec<f64> = (0..n).map(|i| (0.1 * i as f64).sin()).collect();
    let condensed: f64 =
        (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).map(|(i, j)| u[i] * mass[(i, j)] * u[j]).sum();
    let field = gear.expand(window, &u).unwrap();
    let full = fem::assemble_mass(gear.gear().mesh(), &Material::STEEL, gear.dofs()).unwrap();
    let free: Vec<f64> = gear.dofs().free_nodes().iter().flat_map(|&node| field[node as usize]).collect();
    let momentum = full.multiply_vector(&free).unwrap();
    let energy: f64 = free.iter().zip(&momentum).map(|(a, b)| a * b).sum();
    assert!((condensed / energy - 1.0).abs() < 1e-10, "{condensed:e} and {energy:e} t mm^2");
}

/// A free tetrahedral gear is not cyclic: it takes the general way, window by window, and turns on to the next tooth.
#[test]
fn a_free_tetrahedral_gear_runs() {
    let case = Case::read("free_tet10_pinion.msh", "coarse_hex20_wheel.msh", ElementOptions::default());
    let mut model = case.reduced(case.options());
    let cyclic = matches!(&model.gears()[0], ElasticGear::Reduced(r) if r.is_cyclic());
    assert!(!cyclic, "a free mesh is not cyclic");
    let history = model.run(2, 2, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"));
    assert!(history.positions.iter().any(|p| p.tooth_changes > 0), "the window has moved on");
    let (mean, _) = mean_and_peak_to_peak(history.positions.iter().map(|p| 1e3 * p.transmission_error));
    let (hex, _) = run("coarse_hex20_pinion.msh", "coarse_hex20_wheel.msh");
    let (hex, _) = mean_and_peak_to_peak(hex.positions.iter().step_by(4).map(|p| 1e3 * p.transmission_error));
    println!("free tet10 pinion: mean STE {mean:.3} um, hex20 {hex:.3} um at the same positions");
    assert!((mean / hex - 1.0).abs() < 0.05, "{mean} and {hex}");
}
