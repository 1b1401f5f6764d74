//! Checks the element shapes of one tooth. All teeth and all layers are rotated copies of each other.

use geometry::Gear;

use super::{StructuredError, StructuredOptions, section::Lattice, section::Section};
use crate::{BAD_SHAPE, ElementKind, min_det_j, scaled_jacobian};

/// Refuses a section that makes bad elements.
pub(super) fn check(gear: &Gear, options: &StructuredOptions, section: &Section) -> Result<(), StructuredError> {
    let layer = gear.face_width() / f64::from(options.elements_face);
    let (kind, order) = (options.kind(), options.order as usize);
    for (block, lattice) in [("tooth", &section.tooth), ("rim", &section.rim)] {
        for row in 0..lattice.rows / order {
            for column in 0..lattice.columns / order {
                let nodes = middle_layer(gear, kind, order, lattice, [column, row], layer);
                let det_j = min_det_j(kind, &nodes);
                let scaled = scaled_jacobian(kind, &nodes);
                // curved edges can turn an element inside out whose corners look sound
                let scaled_jacobian = if det_j > 0.0 { scaled } else { scaled.min(0.0) };
                if scaled_jacobian.is_nan() || scaled_jacobian < BAD_SHAPE {
                    return Err(StructuredError::Distorted { block, row, column, scaled_jacobian, least: BAD_SHAPE });
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
