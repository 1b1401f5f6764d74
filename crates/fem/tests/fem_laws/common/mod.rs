//! What the laws of elements are shown on.

use std::collections::BTreeMap;

use fem::{DofMap, FemError, SymmetricMatrix};
use mesh::Mesh;

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
