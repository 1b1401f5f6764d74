//! Tests whether a gear is invariant under rotation by one pitch.

use std::{
    collections::HashMap,
    hash::{BuildHasherDefault, Hasher},
};

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
        let alike = gear.bore_coupling().foundation().is_none_or(|springs| springs.is_cyclic());
        if !gear.is_whole_gear() || !alike {
            return None;
        }
        let size = mesh.nodes.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
        let turn = Self::new(mesh, gear.pitches_on(1), CYCLIC_TOLERANCE * size)?;
        let image = |nodes: &[u32]| sorted(&nodes.iter().map(|&n| turn.nodes[n as usize]).collect::<Vec<_>>());
        let faces = || gear.bore().faces.iter();
        let mut keys: Vec<[u32; 4]> = faces().map(Face::corner_key).collect();
        keys.sort_unstable();
        let moved = |face: &Face| {
            let nodes: Vec<u32> = face.nodes().iter().map(|&n| turn.nodes[n as usize]).collect();
            keys.binary_search(&Face::new(face.kind, &nodes).corner_key()).is_ok()
        };
        let same_bore = faces().all(moved);
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
            // Elements by their nodes in ascending order.
            let size = block.kind.node_count();
            let mut keys = block.connectivity.clone();
            keys.chunks_exact_mut(size).for_each(<[u32]>::sort_unstable);
            let key = |element: u32| &keys[element as usize * size..][..size];
            let mut ordered: Vec<u32> = (0..block.len() as u32).collect();
            ordered.sort_unstable_by(|&a, &b| key(a).cmp(key(b)));
            let mut image = vec![0; size];
            let mut image_of = |element: &[u32]| {
                image.iter_mut().zip(element).for_each(|(to, &n)| *to = nodes[n as usize]);
                image.sort_unstable();
                ordered.binary_search_by(|&other| key(other).cmp(&image)).ok().map(|at| ordered[at])
            };
            elements.push(block.elements().map(&mut image_of).collect::<Option<Vec<u32>>>()?);
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

/// Mixes the three numbers of a cell (Fibonacci hashing, and the rotation of Fx). A mesh made to have many cells of one
/// hash would be slow, not wrong.
#[derive(Default)]
struct CellHasher(u64);

impl Hasher for CellHasher {
    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 32
    }

    fn write(&mut self, bytes: &[u8]) {
        for part in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..part.len()].copy_from_slice(part);
            self.write_u64(u64::from_le_bytes(word));
        }
    }

    fn write_u64(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }
}

fn node_images(nodes: &[[f64; 3]], pitch: f64, tolerance: f64) -> Option<Vec<u32>> {
    let cell = 4.0 * tolerance;
    let key = |p: [f64; 3], shift: [i64; 3]| [0, 1, 2].map(|k| (p[k] / cell).floor() as i64 + shift[k]);
    // Looked up only, never walked through: the order of the map does not matter. The first node of each cell, and after
    // each node the next one of its cell.
    let mut grid: HashMap<[i64; 3], u32, BuildHasherDefault<CellHasher>> =
        HashMap::with_capacity_and_hasher(nodes.len(), BuildHasherDefault::default());
    let mut next: Vec<Option<u32>> = vec![None; nodes.len()];
    for (i, &p) in nodes.iter().enumerate().rev() {
        next[i] = grid.insert(key(p, [0; 3]), i as u32);
    }
    let (sin, cos) = pitch.sin_cos();
    let mut taken = vec![false; nodes.len()];
    nodes
        .iter()
        .map(|&[x, y, z]| {
            let image = [cos * x - sin * y, sin * x + cos * y, z];
            // Mostly it is in the cell itself, the middle one of those about it.
            let near = std::iter::once(13).chain(0..27).find_map(|s: i64| {
                let first = grid.get(&key(image, [s % 3 - 1, s / 3 % 3 - 1, s / 9 - 1])).copied();
                std::iter::successors(first, |&j| next[j as usize]).find(|&j| {
                    let q = nodes[j as usize];
                    (0..3).all(|k| (q[k] - image[k]).abs() <= tolerance)
                })
            })?;
            (!std::mem::replace(&mut taken[near as usize], true)).then_some(near)
        })
        .collect()
}
