//! Boxes meshed with every kind of element.

use std::collections::BTreeMap;

use fem::{DofMap, FemError, SymmetricMatrix};
use mesh::{ElementBlock, ElementKind, Mesh};

/// A box of `cells` grid cells; `place` maps grid coordinates (0..=cells, whole numbers at corners) to mm.
///
/// A cell is one hexahedron, two wedges or six tetrahedra; edge nodes lie midway between corners.
pub fn box_mesh(kind: ElementKind, cells: [usize; 3], place: impl Fn([f64; 3]) -> [f64; 3]) -> Mesh {
    let linear = match kind.corner_count() {
        8 => ElementKind::Hex8,
        6 => ElementKind::Wedge6,
        _ => ElementKind::Tet4,
    };
    let mut numbers: BTreeMap<[usize; 3], u32> = BTreeMap::new();
    let mut mesh = Mesh::default();
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

/// Shakes the corners of a grid by up to `amount` of a cell, the same way each time.
pub fn shaken(amount: f64) -> impl Fn([f64; 3]) -> [f64; 3] {
    move |c| {
        let noise = |a: usize| {
            let phase = 12.9898 * c[0] + 78.233 * c[1] + 37.719 * c[2] + 4.1 * a as f64;
            let wave = (phase.sin() * 43758.5453).fract();
            amount * wave
        };
        [0, 1, 2].map(|a| c[a] + noise(a))
    }
}

/// Nodes for which `choose` holds.
pub fn nodes_where(mesh: &Mesh, choose: impl Fn([f64; 3]) -> bool) -> Vec<u32> {
    (0..mesh.nodes.len() as u32).filter(|&i| choose(mesh.nodes[i as usize])).collect()
}

/// Coordinates of the first element.
pub fn first_element(mesh: &Mesh) -> Vec<[f64; 3]> {
    let block = &mesh.blocks[0];
    let nodes = block.elements().next().expect("an element");
    nodes.iter().map(|&i| mesh.nodes[i as usize]).collect()
}

/// Faces of elements that belong to one element only, as node lists with their kind.
pub fn boundary_faces(mesh: &Mesh) -> Vec<(mesh::FaceKind, Vec<u32>)> {
    let mut seen: BTreeMap<Vec<u32>, Option<(mesh::FaceKind, Vec<u32>)>> = BTreeMap::new();
    for block in &mesh.blocks {
        for element in block.elements() {
            for (kind, local) in block.kind.faces() {
                let nodes: Vec<u32> = local.iter().map(|&i| element[i]).collect();
                let mut key = nodes.clone();
                key.sort_unstable();
                seen.entry(key).and_modify(|f| *f = None).or_insert(Some((*kind, nodes)));
            }
        }
    }
    seen.into_values().flatten().collect()
}

/// Nodes on the boundary.
pub fn boundary_nodes(mesh: &Mesh) -> Vec<u32> {
    let mut nodes: Vec<u32> = boundary_faces(mesh).into_iter().flat_map(|(_, n)| n).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Rows of the free degrees of freedom, picked from a vector over all of them.
pub fn pick_free(dofs: &DofMap, all: &[f64]) -> Vec<f64> {
    dofs.free_nodes().iter().flat_map(|&n| (0..3).map(move |a| all[3 * n as usize + a])).collect()
}

/// Result of `f` on a pool of that many threads.
pub fn on_threads<T: Send>(threads: usize, f: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(f)
}

/// Largest entry by absolute value.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |m, v| m.max(v.abs()))
}

/// Interior displacements under prescribed boundary displacements: K_ff u_f = -K_fc u_c, all nodes returned.
pub fn solve_prescribed(
    full: &SymmetricMatrix,
    reduced: &SymmetricMatrix,
    dofs: &DofMap,
    prescribed: &[[f64; 3]],
) -> Result<Vec<[f64; 3]>, FemError> {
    let mut u: Vec<f64> = prescribed.iter().flatten().copied().collect();
    for &node in dofs.free_nodes() {
        u[3 * node as usize..][..3].fill(0.0);
    }
    let force = pick_free(dofs, &full.multiply_vector(&u)?);
    let mut x = faer::Mat::from_fn(force.len(), 1, |i, _| -force[i]);
    fem::BoundaryLastFactor::new(reduced, &[])?.solve(x.as_mut())?;
    let mut all = prescribed.to_vec();
    for (k, &node) in dofs.free_nodes().iter().enumerate() {
        all[node as usize] = [0, 1, 2].map(|a| x[(3 * k + a, 0)]);
    }
    Ok(all)
}
