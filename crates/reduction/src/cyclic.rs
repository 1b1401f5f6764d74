//! Is a gear the same after a turn by one pitch?

use std::collections::HashMap;

use mesh::Mesh;

/// Permutation that a turn by `pitch` (rad) about z makes of the mesh: node i goes where node `p[i]` is.
///
/// `None` unless every node (within `tolerance` mm) and every element has an image: then the gear is cyclic and
/// all windows have the same matrices, each in its own frame.
pub fn pitch_permutation(mesh: &Mesh, pitch: f64, tolerance: f64) -> Option<Vec<u32>> {
    let nodes = node_images(&mesh.nodes, pitch, tolerance)?;
    for block in &mesh.blocks {
        let mut keys: Vec<Vec<u32>> = block.elements().map(sorted).collect();
        keys.sort_unstable();
        let mut image = Vec::new();
        for element in block.elements() {
            image.clear();
            image.extend(element.iter().map(|&n| nodes[n as usize]));
            image.sort_unstable();
            keys.binary_search(&image).ok()?;
        }
    }
    Some(nodes)
}

fn sorted(nodes: &[u32]) -> Vec<u32> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes
}

fn node_images(nodes: &[[f64; 3]], pitch: f64, tolerance: f64) -> Option<Vec<u32>> {
    let cell = 4.0 * tolerance;
    let key = |p: [f64; 3], shift: [i64; 3]| [0, 1, 2].map(|k| (p[k] / cell).floor() as i64 + shift[k]);
    // Looked up only, never walked through: the order of the map does not matter.
    let mut grid: HashMap<[i64; 3], Vec<u32>> = HashMap::with_capacity(nodes.len());
    for (i, &p) in nodes.iter().enumerate() {
        grid.entry(key(p, [0; 3])).or_default().push(i as u32);
    }
    let (sin, cos) = pitch.sin_cos();
    let mut taken = vec![false; nodes.len()];
    nodes
        .iter()
        .map(|&[x, y, z]| {
            let image = [cos * x - sin * y, sin * x + cos * y, z];
            let near = (0..27).find_map(|s: i64| {
                let around = grid.get(&key(image, [s % 3 - 1, s / 3 % 3 - 1, s / 9 - 1]))?;
                around.iter().copied().find(|&j| {
                    let q = nodes[j as usize];
                    (0..3).all(|k| (q[k] - image[k]).abs() <= tolerance)
                })
            })?;
            (!std::mem::replace(&mut taken[near as usize], true)).then_some(near)
        })
        .collect()
}
