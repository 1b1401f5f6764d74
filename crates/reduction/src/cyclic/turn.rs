//! Is a gear the same after a turn by one pitch?

use std::collections::HashMap;

use geometry::Side;
use mesh::{Face, Mesh, MeshedGear};

/// How far a node may be from the place of its image for a gear to count as cyclic, relative to its size.
const CYCLIC_TOLERANCE: f64 = 1e-9;

/// Where a turn by one pitch takes the nodes and elements of a mesh.
#[derive(Debug)]
pub(crate) struct PitchTurn {
    /// Node i goes where node `nodes[i]` is.
    pub nodes: Vec<u32>,
    /// Element j of each block goes where element `elements[block][j]` is.
    pub elements: Vec<Vec<u32>>,
}

impl PitchTurn {
    /// Turn by one pitch of a whole gear; `None` unless every node, element, flank and held node has its image.
    pub(crate) fn of_gear(gear: &MeshedGear) -> Option<Self> {
        let mesh = gear.mesh();
        if !gear.is_whole_gear() {
            return None;
        }
        let size = mesh.nodes.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
        let turn = Self::new(mesh, gear.pitches_on(1), CYCLIC_TOLERANCE * size)?;
        let image = |nodes: &[u32]| sorted(&nodes.iter().map(|&n| turn.nodes[n as usize]).collect::<Vec<_>>());
        let same_bore = image(gear.bore_nodes()) == gear.bore_nodes();
        let mut flanks = gear.teeth().into_iter().flat_map(|t| [(t, Side::Left), (t, Side::Right)]);
        let nodes = |tooth, side| gear.flank(tooth, side).map(face_nodes);
        let same_flanks = flanks.all(|(tooth, side)| nodes(tooth, side).map(|n| image(&n)) == nodes(tooth + 1, side));
        (same_bore && same_flanks).then_some(turn)
    }

    /// By `pitch` (rad) about z; `None` unless every node (within `tolerance` mm) and every element has an image: then the
    /// gear is cyclic and all windows have the same matrices, each in its own frame.
    fn new(mesh: &Mesh, pitch: f64, tolerance: f64) -> Option<Self> {
        let nodes = node_images(&mesh.nodes, pitch, tolerance)?;
        let mut elements = Vec::with_capacity(mesh.blocks.len());
        for block in &mesh.blocks {
            let mut keys: Vec<(Vec<u32>, u32)> = block.elements().map(sorted).zip(0..).collect();
            keys.sort_unstable();
            let images: Option<Vec<u32>> = block
                .elements()
                .map(|element| {
                    let image = sorted(&element.iter().map(|&n| nodes[n as usize]).collect::<Vec<_>>());
                    keys.binary_search_by(|(key, _)| key.cmp(&image)).ok().map(|at| keys[at].1)
                })
                .collect();
            elements.push(images?);
        }
        Some(Self { nodes, elements })
    }
}

/// Nodes of some faces, ascending, each once.
pub(crate) fn face_nodes(faces: &[Face]) -> Vec<u32> {
    let mut nodes: Vec<u32> = faces.iter().flat_map(|f| f.nodes()).copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
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
            // Mostly it is in the cell itself, the middle one of those about it.
            let near = std::iter::once(13).chain(0..27).find_map(|s: i64| {
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
