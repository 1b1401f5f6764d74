//! Scaled Jacobians of one tooth; all teeth and all layers are turned copies of each other.

use geometry::Gear;

use super::{StructuredError, StructuredOptions, section::Lattice, section::Section};
use crate::ElementKind;

/// Least scaled Jacobian let through.
const LEAST: f64 = 0.1;

/// Refuses a section that makes bad elements.
pub(super) fn check(gear: &Gear, options: &StructuredOptions, section: &Section) -> Result<(), StructuredError> {
    let layer = gear.face_width() / f64::from(options.elements_face);
    let (kind, order) = (options.kind(), options.order as usize);
    for (block, lattice) in [("tooth", &section.tooth), ("rim", &section.rim)] {
        for row in 0..lattice.rows / order {
            for column in 0..lattice.columns / order {
                let nodes = middle_layer(gear, kind, order, lattice, [column, row], layer);
                let scaled_jacobian = scaled_jacobian(kind, &nodes);
                if scaled_jacobian.is_nan() || scaled_jacobian < LEAST {
                    return Err(StructuredError::Distorted { block, row, column, scaled_jacobian, least: LEAST });
                }
            }
        }
    }
    Ok(())
}

/// Nodes of the element in the layer about z = 0 (moved there, if no layer lies so).
fn middle_layer(
    gear: &Gear,
    kind: ElementKind,
    order: usize,
    lattice: &Lattice,
    cell: [usize; 2],
    layer: f64,
) -> Vec<[f64; 3]> {
    kind.reference_nodes()
        .iter()
        .map(|xi| {
            let [u, v, _] = offsets(xi, order);
            let [x, y] = lattice.at(cell[0] * order + u, cell[1] * order + v);
            let z = 0.5 * layer * xi[2];
            let (sin, cos) = (gear.twist() * z).sin_cos();
            [x * cos - y * sin, x * sin + y * cos, z]
        })
        .collect()
}

/// Lattice steps from the element's first corner to its node at reference position `xi`.
pub(super) fn offsets(xi: &[f64; 3], order: usize) -> [usize; 3] {
    xi.map(|c| ((c + 1.0) * 0.5 * order as f64).round() as usize)
}

/// Least det J over the product of the column lengths of J, at the element's nodes; NaN where J vanishes.
pub(super) fn scaled_jacobian(kind: ElementKind, nodes: &[[f64; 3]]) -> f64 {
    let mut slopes = [[0.0; 3]; 27];
    kind.reference_nodes().iter().fold(f64::INFINITY, |worst, &xi| {
        kind.shape_gradient(xi, &mut slopes);
        let mut j = nalgebra::Matrix3::zeros();
        for (p, d) in nodes.iter().zip(&slopes) {
            j += nalgebra::Vector3::from(*p) * nalgebra::RowVector3::from(*d);
        }
        let scaled = j.determinant() / j.column_iter().map(|c| c.norm()).product::<f64>();
        if scaled < worst || scaled.is_nan() { scaled } else { worst }
    })
}
