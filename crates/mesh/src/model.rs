//! Data of a mesh: nodes, volume elements in blocks of one kind, named surface groups.

use crate::{ElementKind, FaceKind};

/// A finite-element mesh of one body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Node positions, mm; an index into this list is *the* node number inside the program.
    pub nodes: Vec<[f64; 3]>,
    /// Tag of each node in the file (1, 2, ... for a generated mesh), used in messages.
    pub node_tags: Vec<u64>,
    /// Volume elements, one block per kind.
    pub blocks: Vec<ElementBlock>,
    /// Two-dimensional physical groups, sorted by name.
    pub surfaces: Vec<SurfaceGroup>,
    /// Names of the three-dimensional physical groups, sorted.
    pub volumes: Vec<String>,
}

/// Volume elements of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct ElementBlock {
    /// Kind of all elements of the block.
    pub kind: ElementKind,
    /// Nodes of the elements, `kind.node_count()` per element, in Gmsh order.
    pub connectivity: Vec<u32>,
    /// Tag of each element in the file.
    pub tags: Vec<u64>,
}

/// A named set of boundary faces.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceGroup {
    /// Name of the physical group.
    pub name: String,
    /// Faces of the group.
    pub faces: Vec<Face>,
}

/// One boundary face: its nodes in Gmsh order (corners, then edges, then centre).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Face {
    /// Shape and order.
    pub kind: FaceKind,
    /// Nodes; entries past `kind.node_count()` are `u32::MAX`.
    nodes: [u32; 9],
}

impl Face {
    /// A face from its nodes.
    ///
    /// # Panics
    /// When the number of nodes is not `kind.node_count()`.
    pub fn new(kind: FaceKind, nodes: &[u32]) -> Self {
        assert_eq!(nodes.len(), kind.node_count(), "{kind:?} with {} nodes", nodes.len());
        let mut all = [u32::MAX; 9];
        all[..nodes.len()].copy_from_slice(nodes);
        Self { kind, nodes: all }
    }

    /// The face's nodes in Gmsh order.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes[..self.kind.node_count()]
    }

    /// The corner nodes, counter-clockwise when seen against the normal.
    pub fn corners(&self) -> &[u32] {
        &self.nodes[..self.kind.corner_count()]
    }

    /// The corner nodes in ascending order; the last entry is `u32::MAX` for a triangle. Two elements that share a face
    /// give the same key, whatever their node order and orientation.
    pub fn corner_key(&self) -> [u32; 4] {
        corner_key(self.corners())
    }

    /// This face in other node numbers.
    pub(crate) fn renumbered(&self, number: impl Fn(u32) -> u32) -> Self {
        let mut face = *self;
        for node in &mut face.nodes[..self.kind.node_count()] {
            *node = number(*node);
        }
        face
    }

    /// This face with the opposite normal.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let (corners, count) = (self.kind.corner_count(), self.kind.node_count());
        let mut turned = *self;
        turned.nodes[1..corners].reverse();
        if count >= 2 * corners {
            // Edge i joins corners i and i + 1; backwards the last edge comes first.
            turned.nodes[corners..2 * corners].reverse();
        }
        turned
    }
}

/// At most four corner nodes, ascending and filled up with `u32::MAX`.
pub(crate) fn corner_key(corners: &[u32]) -> [u32; 4] {
    let mut key = [u32::MAX; 4];
    for (slot, &node) in key.iter_mut().zip(corners) {
        *slot = node;
    }
    key.sort_unstable();
    key
}

impl ElementBlock {
    /// Number of elements.
    pub fn len(&self) -> usize {
        self.connectivity.len() / self.kind.node_count()
    }

    /// Whether the block is empty.
    pub fn is_empty(&self) -> bool {
        self.connectivity.is_empty()
    }

    /// Nodes of each element.
    pub fn elements(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        self.connectivity.chunks_exact(self.kind.node_count())
    }
}

impl Mesh {
    /// Number of volume elements.
    pub fn element_count(&self) -> usize {
        self.blocks.iter().map(ElementBlock::len).sum()
    }

    /// The surface group with this name.
    pub fn surface(&self, name: &str) -> Option<&SurfaceGroup> {
        self.surfaces.iter().find(|s| s.name == name)
    }

    /// Smallest and largest distance of some nodes from the z axis, mm; infinity and 0 for an empty list.
    pub fn radii(&self, nodes: &[u32]) -> [f64; 2] {
        let radius = |&n: &u32| self.nodes[n as usize][0].hypot(self.nodes[n as usize][1]);
        nodes.iter().map(radius).fold([f64::INFINITY, 0.0], |[low, high], r| [low.min(r), high.max(r)])
    }
}

impl SurfaceGroup {
    /// The nodes of all faces, ascending, each once.
    pub fn nodes(&self) -> Vec<u32> {
        let mut all: Vec<u32> = self.faces.iter().flat_map(|f| f.nodes().iter().copied()).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}
