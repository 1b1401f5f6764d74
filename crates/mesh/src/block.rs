//! A block of elements of any kind, for patch tests, cantilevers and other small models.

use std::collections::BTreeMap;

use crate::{ElementBlock, ElementKind, Mesh};

impl Mesh {
    /// A block of `cells` grid cells; `place` maps grid coordinates (0..=cells, whole numbers at corners) to mm.
    ///
    /// A cell is one hexahedron, two wedges or six tetrahedra; edge nodes lie midway between corners. The mesh has no
    /// groups.
    pub fn block(kind: ElementKind, cells: [usize; 3], place: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let linear = match kind.corner_count() {
            8 => ElementKind::Hex8,
            6 => ElementKind::Wedge6,
            _ => ElementKind::Tet4,
        };
        let mut numbers: BTreeMap<[usize; 3], u32> = BTreeMap::new();
        let mut mesh = Self::default();
        let mut block = ElementBlock { kind, connectivity: Vec::new(), tags: Vec::new() };
        let mut n = [0.0; 8];
        for z in 0..cells[2] {
            for y in 0..cells[1] {
                for x in 0..cells[0] {
                    for corners in pieces(linear) {
                        let corners: Vec<[f64; 3]> =
                            corners.iter().map(|c| [(x + c[0]) as f64, (y + c[1]) as f64, (z + c[2]) as f64]).collect();
                        let placed: Vec<[f64; 3]> = corners.iter().map(|&c| place(c)).collect();
                        for &xi in kind.reference_nodes() {
                            linear.shape(xi, &mut n);
                            let mix = |points: &[[f64; 3]]| {
                                [0, 1, 2].map(|a| points.iter().zip(&n).map(|(p, n)| n * p[a]).sum::<f64>())
                            };
                            let key = mix(&corners).map(|v| (2.0 * v).round() as usize);
                            let number = *numbers.entry(key).or_insert_with(|| {
                                mesh.nodes.push(mix(&placed));
                                mesh.nodes.len() as u32 - 1
                            });
                            block.connectivity.push(number);
                        }
                        block.tags.push(block.tags.len() as u64 + 1);
                    }
                }
            }
        }
        mesh.node_tags = (1..=mesh.nodes.len() as u64).collect();
        mesh.blocks.push(block);
        mesh
    }
}

/// Corners of the elements a unit cell is cut into.
fn pieces(linear: ElementKind) -> Vec<Vec<[usize; 3]>> {
    let cell = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
    let pick = |list: &[usize]| list.iter().map(|&i| cell[i]).collect();
    match linear {
        ElementKind::Hex8 => vec![cell.to_vec()],
        ElementKind::Wedge6 => vec![pick(&[0, 1, 2, 4, 5, 6]), pick(&[0, 2, 3, 4, 6, 7])],
        // all six share the diagonal 0-6
        _ => [[1, 2], [2, 3], [3, 7], [7, 4], [4, 5], [5, 1]].iter().map(|[a, b]| pick(&[0, *a, *b, 6])).collect(),
    }
}
