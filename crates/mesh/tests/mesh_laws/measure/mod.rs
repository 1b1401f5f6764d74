//! Measures of a mesh, independent of the code under test.

use geometry::{Gear, Vec3};
use mesh::Mesh;
use mesh::element::QuadratureRule;

/// Volume by quadrature and the least Jacobian determinant at quadrature points and nodes, mm^3.
pub fn volume_and_least_jacobian(mesh: &Mesh) -> (f64, f64) {
    let (mut volume, mut least) = (0.0, f64::INFINITY);
    let mut slopes = [[0.0; 3]; 27];
    for block in &mesh.blocks {
        for element in block.elements() {
            let mut det = |xi| {
                block.kind.shape_gradient(xi, &mut slopes);
                let mut j = nalgebra::Matrix3::zeros();
                for (&node, d) in element.iter().zip(&slopes) {
                    j += Vec3::from(mesh.nodes[node as usize]) * nalgebra::RowVector3::from(*d);
                }
                let det = j.determinant();
                least = least.min(det);
                det
            };
            for point in block.kind.quadrature(QuadratureRule::Mass) {
                volume += point.weight * det(point.xi);
            }
            for &xi in block.kind.reference_nodes() {
                det(xi);
            }
        }
    }
    (volume, least)
}

/// Area of one tooth's section by Green's theorem on a fine polygon, minus the bore, mm^2.
pub fn tooth_area(gear: &Gear) -> f64 {
    let (profile, n) = (gear.profile(), 20_000);
    let (tip, form) = (profile.roll_tip(), profile.roll_form());
    let mut half: Vec<(f64, f64)> = vec![(profile.radius(tip), 0.0)];
    let part = |i: usize| i as f64 / n as f64;
    half.extend((0..=n).map(|i| tip + part(i) * (form - tip)).map(|u| (profile.radius(u), profile.half_angle(u))));
    half.extend((0..=n).map(|i| profile.fillet(1.0 - part(i))));
    half.push((gear.root_radius(), 0.5 * gear.pitch_angle()));
    // sectors of a polar curve: exact on arcs, second order elsewhere
    let sector: f64 = half.windows(2).map(|w| 0.25 * (w[0].0.powi(2) + w[1].0.powi(2)) * (w[1].1 - w[0].1)).sum();
    2.0 * sector - 0.125 * gear.data().bore_diameter.powi(2) * gear.pitch_angle()
}
