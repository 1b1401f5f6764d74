//! Stress recovery.

use crate::common::{largest, nodes_where, on_threads, shaken};
use faer::Mat;
use fem::{
    BoundaryLastFactor, DofMap, ElementOptions, Material, StressOperator, assemble_stiffness, max_principal,
    nodal_stress, nodal_stresses, von_mises,
};
use mesh::{ElementKind, Mesh};

const STEEL: Material = Material::STEEL;

/// Pure bending, sigma_xx = E y / R: quadratic displacements, linear stress.
fn bending(x: [f64; 3]) -> [f64; 3] {
    let (nu, curvature) = (STEEL.poisson(), 1e-3);
    let [x, y, z] = x;
    [curvature * x * y, -0.5 * curvature * (x * x + nu * (y * y - z * z)), -nu * curvature * y * z]
}

/// Quadratic elements carry a linear stress field exactly to their nodes.
#[test]
fn quadratic_elements_recover_linear_stress() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.order() == 2) {
        // parallelepipeds: their quadratic fields are those of true coordinates
        let mesh = Mesh::block(kind, [3, 2, 2], |c| [c[0] + 0.2 * c[1], c[1] - 0.1 * c[2], c[2] + 0.15 * c[0]]);
        let u: Vec<[f64; 3]> = mesh.nodes.iter().map(|&x| bending(x)).collect();
        let stress = nodal_stress(&mesh, &STEEL, &ElementOptions::default(), &u).unwrap();
        for (x, s) in mesh.nodes.iter().zip(&stress) {
            let wanted = STEEL.young_mpa() * 1e-3 * x[1];
            let error = largest([s[0] - wanted, s[1], s[2], s[3], s[4], s[5]]);
            assert!(error < 1e-10 * STEEL.young_mpa() * 1e-3, "{} at {x:?}: {s:?}", kind.name());
        }
    }
}

/// Hex8 bends through its incompatible modes: without their strains the stress would be far off.
#[test]
fn hex8_in_pure_bending_has_the_stress_of_a_beam() {
    let cells = [8, 2, 1];
    let mesh = Mesh::block(ElementKind::Hex8, cells, |c| [c[0], 0.5 * c[1] - 0.5, c[2] - 0.5]);
    // symmetric about x = 4: hold the middle plane as bending does, move the ends
    let ends = nodes_where(&mesh, |x| x[0] < 1e-9 || x[0] > 8.0 - 1e-9);
    let n = mesh.nodes.len();
    let (all, dofs) = (DofMap::new(n, &[]), DofMap::new(n, &ends));
    let options = ElementOptions::default();
    let full = assemble_stiffness(&mesh, &STEEL, &all, &options).unwrap();
    let free = assemble_stiffness(&mesh, &STEEL, &dofs, &options).unwrap();
    let exact: Vec<[f64; 3]> = mesh.nodes.iter().map(|x| bending([x[0] - 4.0, x[1], x[2]])).collect();
    let u = crate::common::solve_prescribed(&full, &free, &dofs, &exact).unwrap();
    let stress = nodal_stress(&mesh, &STEEL, &options, &u).unwrap();
    for (x, s) in mesh.nodes.iter().zip(&stress).filter(|(x, _)| (x[0] - 4.0).abs() < 1.5 && x[1].abs() > 0.1) {
        let wanted = STEEL.young_mpa() * 1e-3 * x[1];
        assert!((s[0] / wanted - 1.0).abs() < 0.02, "at {x:?}: {} for {wanted}", s[0]);
    }
}

/// Several fields at once have the bits of each by itself, at the nodes that are wanted; the others have none.
#[test]
fn several_fields_have_the_stress_of_each() {
    for kind in ElementKind::ALL {
        let mesh = Mesh::block(kind, [3, 2, 2], shaken(0.1));
        let field =
            |k: f64| -> Vec<[f64; 3]> { mesh.nodes.iter().map(|&x| bending(x).map(|u| k * u + u * u)).collect() };
        let fields = [field(1.0), field(-0.3)];
        let all: Vec<&[[f64; 3]]> = fields.iter().map(Vec::as_slice).collect();
        let wanted = |node: u32| mesh.nodes[node as usize][0] > 1.5;
        let options = ElementOptions::default();
        let found = nodal_stresses(&mesh, &STEEL, &options, &all, wanted).unwrap();
        assert_eq!(found.len(), 2);
        for (field, found) in fields.iter().zip(&found) {
            let alone = nodal_stress(&mesh, &STEEL, &options, field).unwrap();
            for (node, (alone, found)) in (0..).zip(alone.iter().zip(found)) {
                let expected = if wanted(node) { *alone } else { [0.0; 6] };
                assert_eq!(expected, *found, "{} at node {node}", kind.name());
            }
        }
    }
}

#[test]
fn the_operator_gives_the_nodal_stress() {
    for kind in ElementKind::ALL {
        let mesh = Mesh::block(kind, [3, 2, 2], shaken(0.15));
        let fixed = nodes_where(&mesh, |x| x[0] < 0.3);
        let dofs = DofMap::new(mesh.nodes.len(), &fixed);
        let options = ElementOptions::default();
        let free: Vec<f64> = (0..dofs.free_count()).map(|i| (0.7 * i as f64).sin()).collect();
        let u = dofs.to_nodes(&free).unwrap();
        let run = || nodal_stress(&mesh, &STEEL, &options, &u).unwrap();
        let wanted = on_threads(1, run);
        assert_eq!(wanted, on_threads(2, run));
        let nodes = [5u32, 0, 11, 5];
        let operator = StressOperator::new(&mesh, &STEEL, &options, &dofs, &nodes).unwrap();
        let x = Mat::from_fn(free.len(), 2, |i, j| free[i] * (1.0 + j as f64));
        let found = operator.apply(x.as_ref()).unwrap();
        let scale = largest(wanted.iter().flatten().copied());
        for (i, &node) in nodes.iter().enumerate() {
            for k in 0..6 {
                let w = wanted[node as usize][k];
                assert!((found[(6 * i + k, 0)] - w).abs() < 1e-12 * scale, "{}", kind.name());
                assert!((found[(6 * i + k, 1)] - 2.0 * w).abs() < 1e-12 * scale);
            }
        }
    }
}

#[test]
fn equivalent_and_principal_stress_of_known_states() {
    assert!((von_mises(&[100.0, 0.0, 0.0, 0.0, 0.0, 0.0]) - 100.0).abs() < 1e-12);
    assert!((von_mises(&[0.0, 0.0, 0.0, 100.0, 0.0, 0.0]) - 3f64.sqrt() * 100.0).abs() < 1e-12);
    assert!(von_mises(&[7.0, 7.0, 7.0, 0.0, 0.0, 0.0]).abs() < 1e-12);
    assert!((max_principal(&[0.0, 0.0, 0.0, 0.0, 50.0, 0.0]) - 50.0).abs() < 1e-12);
    assert!((max_principal(&[-3.0, -2.0, -5.0, 0.0, 0.0, 0.0]) + 2.0).abs() < 1e-12);
}

/// Work and stress agree: the end load of a bar is its cross-section times its mean stress.
#[test]
fn a_pulled_bar_is_under_its_load() {
    let mesh = Mesh::block(ElementKind::Hex8, [6, 2, 2], |c| c);
    let fixed = nodes_where(&mesh, |x| x[0] < 1e-9);
    let dofs = DofMap::new(mesh.nodes.len(), &fixed);
    let options = ElementOptions::default();
    let k = assemble_stiffness(&mesh, &STEEL, &dofs, &options).unwrap();
    let mut x = Mat::zeros(dofs.free_count(), 1);
    for &node in &nodes_where(&mesh, |x| x[0] > 6.0 - 1e-9) {
        let edge = |v: f64| if (v - 1.0).abs() < 0.5 { 1.0 } else { 0.5 };
        let p = mesh.nodes[node as usize];
        x[(dofs.dof(node, 0).unwrap(), 0)] = 100.0 * edge(p[1]) * edge(p[2]); // 100 MPa
    }
    BoundaryLastFactor::new(&k, &[]).unwrap().solve(x.as_mut()).unwrap();
    let u = dofs.to_nodes(x.col_as_slice(0)).unwrap();
    let stress = nodal_stress(&mesh, &STEEL, &options, &u).unwrap();
    for &node in &nodes_where(&mesh, |x| x[0] > 3.5) {
        assert!((stress[node as usize][0] - 100.0).abs() < 0.5, "{:?}", stress[node as usize]);
    }
}
