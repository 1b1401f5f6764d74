//! Stress of free surfaces from their own displacement.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::FRAC_PI_2;

use crate::common::{boundary_faces, largest, nodes_where, shaken};
use faer::Mat;
use fem::{DofMap, ElementOptions, FemError, Material, StressOperator, assemble_stiffness, nodal_stress};
use mesh::{ElementKind, Face, Mesh};

const STEEL: Material = Material::STEEL;

/// Stress at `nodes` of a field given at every node.
fn surface_stress(mesh: &Mesh, faces: &[Face], nodes: &[u32], u: &[[f64; 3]]) -> Vec<[f64; 6]> {
    let dofs = DofMap::new(mesh.nodes.len(), &[]);
    let operator = StressOperator::on_surface(mesh, &STEEL, &dofs, &[faces.to_vec()], nodes).unwrap();
    let stress = operator.apply(Mat::from_fn(3 * u.len(), 1, |i, _| u[i / 3][i % 3]).as_ref()).unwrap();
    (0..nodes.len()).map(|i| [0, 1, 2, 3, 4, 5].map(|k| stress[(6 * i + k, 0)])).collect()
}

/// Boundary faces all of whose nodes are where `choose` says, and their nodes.
fn faces_where(mesh: &Mesh, choose: impl Fn([f64; 3]) -> bool) -> (Vec<Face>, Vec<u32>) {
    let on = |nodes: &[u32]| nodes.iter().all(|&n| choose(mesh.nodes[n as usize]));
    let all = boundary_faces(mesh).into_iter().filter(|(_, nodes)| on(nodes));
    let faces: Vec<Face> = all.map(|(kind, nodes)| Face::new(kind, &nodes)).collect();
    let mut nodes: Vec<u32> = faces.iter().flat_map(|f| f.nodes().to_vec()).collect();
    nodes.sort_unstable();
    nodes.dedup();
    (faces, nodes)
}

/// Uniform uniaxial stress on every kind of face, exact on shaken meshes; the free faces are those along the pull.
#[test]
fn uniform_stress_is_exact() {
    let (young, nu) = (STEEL.young_mpa(), STEEL.poisson());
    for kind in ElementKind::ALL {
        // Shaken along the pull alone, so that the free faces stay plane.
        let shake = shaken(0.15);
        let mesh = Mesh::block(kind, [3, 2, 2], |c| [shake(c)[0] + 0.1 * c[1], c[1], c[2]]);
        let u: Vec<[f64; 3]> =
            mesh.nodes.iter().map(|x| [x[0], -nu * x[1], -nu * x[2]].map(|c| 100.0 / young * c)).collect();
        for at in [0.0, 2.0] {
            let (faces, nodes) = faces_where(&mesh, |x| (x[1] - at).abs() < 1e-9);
            for s in surface_stress(&mesh, &faces, &nodes, &u) {
                let off = largest([s[0] - 100.0, s[1], s[2], s[3], s[4], s[5]]);
                assert!(off < 1e-10 * 100.0, "{}: {s:?}", kind.name());
            }
        }
    }
}

/// Pure bending: quadratic displacements, stress linear along one pair of free faces. Quadratic faces carry it exactly
/// to their nodes, in any position in space; linear faces have it at their centres.
#[test]
fn linear_stress_is_exact_on_quadratic_faces() {
    let (young, nu, curvature) = (STEEL.young_mpa(), STEEL.poisson(), 1e-3);
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.7, 1.1);
    for kind in ElementKind::ALL.into_iter().filter(|k| k.order() == 2) {
        let straight = Mesh::block(kind, [3, 2, 2], |c| [c[0] + 0.2 * c[1], c[1], c[2]]);
        let field = |[x, y, z]: [f64; 3]| {
            let down = -0.5 * curvature * (x * x + nu * (y * y - z * z));
            [curvature * x * y, down, -nu * curvature * y * z]
        };
        let turned = |x: [f64; 3]| -> [f64; 3] { (turn * nalgebra::Vector3::from(x)).into() };
        let u: Vec<[f64; 3]> = straight.nodes.iter().map(|&x| turned(field(x))).collect();
        let mut mesh = straight.clone();
        mesh.nodes.iter_mut().for_each(|x| *x = turned(*x));
        for axis in [1, 2] {
            let (faces, nodes) = faces_where(&straight, |x| x[axis].abs() < 1e-9);
            for (s, &node) in surface_stress(&mesh, &faces, &nodes, &u).iter().zip(&nodes) {
                let wanted = young * curvature * straight.nodes[node as usize][1];
                let tensor = nalgebra::Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]);
                let back = turn.matrix().transpose() * tensor * turn.matrix();
                let mut exact = nalgebra::Matrix3::zeros();
                exact[(0, 0)] = wanted;
                assert!((back - exact).amax() < 1e-10 * young * curvature, "{}: {back} for {wanted}", kind.name());
            }
        }
    }
}

/// Whatever moves as a rigid body is free of stress, and the surface bears no traction, however the face is bent.
#[test]
fn rigid_motion_is_free_of_stress_and_the_surface_of_traction() {
    for kind in ElementKind::ALL {
        let mut mesh = Mesh::block(kind, [2, 2, 2], |c| c);
        mesh.nodes.iter_mut().for_each(|x| *x = polar([1.0 + x[0], 0.3 * x[1], x[2] + 0.1 * x[0] * x[1]]));
        let u: Vec<[f64; 3]> = mesh
            .nodes
            .iter()
            .map(|[x, y, z]| [0.3 - y + 0.2 * z, 0.1 + x - 0.4 * z, 0.7 - 0.2 * x + 0.4 * y])
            .collect();
        let (faces, nodes) = faces_where(&mesh, |x| (x[0].hypot(x[1]) - 1.0).abs() < 0.02);
        assert!(nodes.len() >= 9, "{}", nodes.len());
        let stress = surface_stress(&mesh, &faces, &nodes, &u);
        assert!(largest(stress.iter().flatten().copied()) < 1e-9 * STEEL.young_mpa(), "{}", kind.name());
    }
    // One curved face: no traction across its own normal, whatever its displacement.
    let mut mesh = Mesh::block(ElementKind::Hex20, [1, 1, 1], |c| c);
    mesh.nodes.iter_mut().for_each(|x| *x = polar([1.0 + x[0], 0.5 * x[1], x[2]]));
    let (faces, nodes) = faces_where(&mesh, |x| (x[0].hypot(x[1]) - 1.0).abs() < 1e-9);
    let u: Vec<[f64; 3]> = (0..mesh.nodes.len()).map(|i| [0, 1, 2].map(|a| (1.7 * (3 * i + a) as f64).sin())).collect();
    let stress = surface_stress(&mesh, &faces, &nodes, &u);
    let scale = largest(stress.iter().flatten().copied());
    for (s, &node) in stress.iter().zip(&nodes) {
        // The normal of the quadratic face is within its sagitta of the radius.
        let [x, y, _] = mesh.nodes[node as usize];
        let across = [s[0] * x + s[3] * y, s[3] * x + s[1] * y, s[5] * x + s[4] * y];
        assert!(largest(across) < 0.01 * scale, "{across:?} of {scale}");
    }
}

fn polar([r, angle, z]: [f64; 3]) -> [f64; 3] {
    [r * angle.cos(), r * angle.sin(), z]
}

/// Kirsch's displacement about a hole of radius 1 under tension S = 1 MPa along x, plane strain.
///
/// Source: Kirsch, Z. VDI 42, 1898; in this form Muskhelishvili, Some Basic Problems, section 56.
fn kirsch([x, y, _]: [f64; 3]) -> [f64; 3] {
    let (r, t, nu) = (x.hypot(y), y.atan2(x), STEEL.poisson());
    let (kappa, mu) = (3.0 - 4.0 * nu, STEEL.young_mpa() / (2.0 * (1.0 + nu)));
    let c2 = (2.0 * t).cos();
    let radial = r * (kappa - 1.0 + 2.0 * c2) + 2.0 / r * (1.0 + (kappa + 1.0) * c2) - 2.0 / r.powi(3) * c2;
    let around = -2.0 * (2.0 * t).sin() * (r + (kappa - 1.0) / r + 1.0 / r.powi(3));
    let (u, v) = (radial / (8.0 * mu), around / (8.0 * mu));
    [u * t.cos() - v * t.sin(), u * t.sin() + v * t.cos(), 0.0]
}

/// Largest error of the hoop stress S (1 - 2 cos 2 theta) on the free hole, over its maximum 3 S: surface, volume.
fn errors_at_the_hole(kind: ElementKind, n: usize) -> [f64; 2] {
    let cells = [n, 2 * n, 2];
    let mut mesh = Mesh::block(kind, cells, |c| c);
    for x in &mut mesh.nodes {
        // Layers that grow with the distance from the hole.
        *x = polar([3f64.powf(x[0] / n as f64), FRAC_PI_2 * x[1] / (2 * n) as f64, x[2] - 1.0]);
    }
    let edge = |x: [f64; 3]| x[2].abs() > 1.0 - 1e-9 || x[0] < 1e-9 || x[1] < 1e-9 || x[0].hypot(x[1]) > 3.0 - 1e-9;
    let ends = nodes_where(&mesh, edge);
    let (all, free) = (DofMap::new(mesh.nodes.len(), &[]), DofMap::new(mesh.nodes.len(), &ends));
    let options = ElementOptions::default();
    let [full, part] = [&all, &free].map(|dofs| assemble_stiffness(&mesh, &STEEL, dofs, &options).unwrap());
    let exact: Vec<[f64; 3]> = mesh.nodes.iter().map(|&x| kirsch(x)).collect();
    let u = crate::common::solve_prescribed(&full, &part, &free, &exact).unwrap();
    let (faces, nodes) = faces_where(&mesh, |x| (x[0].hypot(x[1]) - 1.0).abs() < 0.3 * (1.0 / n as f64).powi(2));
    let stress = surface_stress(&mesh, &faces, &nodes, &u);
    let volume = nodal_stress(&mesh, &STEEL, &options, &u).unwrap();
    let mut worst = [0.0f64; 2];
    for (s, &node) in stress.iter().zip(&nodes) {
        let [x, y, z] = mesh.nodes[node as usize];
        let angle = y.atan2(x);
        if z.abs() > 1e-9 || !(0.2..1.37).contains(&angle) {
            continue;
        }
        let (sin, cos) = angle.sin_cos();
        let hoop = |s: &[f64; 6]| s[0] * sin * sin + s[1] * cos * cos - 2.0 * s[3] * sin * cos;
        let wanted = 1.0 - 2.0 * (2.0 * angle).cos();
        for (w, found) in worst.iter_mut().zip([hoop(s), hoop(&volume[node as usize])]) {
            *w = w.max((found - wanted).abs() / 3.0);
        }
    }
    worst
}

/// The notch with a closed form: one order more than carried face by face, and nearer than the values carried from
/// Gauss points.
#[test]
fn stress_at_a_hole_converges() {
    for (kind, order, most) in
        [(ElementKind::Hex20, 3.5, 0.0005), (ElementKind::Tet10, 2.6, 0.001), (ElementKind::Hex8, 1.7, 0.02)]
    {
        let [coarse, fine] = [3, 6].map(|n| errors_at_the_hole(kind, n));
        let rate = (coarse[0] / fine[0]).log2();
        println!(
            "{}: surface {:.4}, {:.4} (order {rate:.2}); volume {:.4}, {:.4}",
            kind.name(),
            coarse[0],
            fine[0],
            coarse[1],
            fine[1]
        );
        assert!(rate > order && fine[0] < most, "{}: {coarse:?}, {fine:?}", kind.name());
        assert!(fine[0] < fine[1], "{}: {fine:?}", kind.name());
    }
}

#[test]
fn nodes_and_faces_must_exist() {
    let mesh = Mesh::block(ElementKind::Hex8, [1, 1, 1], |c| c);
    let dofs = DofMap::new(8, &[]);
    let (faces, _) = faces_where(&mesh, |x| x[2] == 0.0);
    let of = |faces: &[Face], nodes: &[u32]| StressOperator::on_surface(&mesh, &STEEL, &dofs, &[faces.to_vec()], nodes);
    assert!(matches!(of(&faces, &[8]), Err(FemError::Shape { .. })));
    assert!(matches!(of(&[Face::new(mesh::FaceKind::Tri3, &[0, 1, 99])], &[0]), Err(FemError::Shape { .. })));
    let off = nodes_where(&mesh, |x| x[2] == 1.0);
    let stress = of(&faces, &off).unwrap().apply(Mat::from_fn(24, 1, |i, _| i as f64).as_ref()).unwrap();
    assert_eq!(stress, Mat::<f64>::zeros(24, 1), "nodes on none of the faces");
}
