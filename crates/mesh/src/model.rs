//! The mesh as data: nodes, volume elements in blocks of one kind, named surface groups.

use crate::{ElementKind, FaceKind};

/// A finite-element mesh of one body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Node positions, mm; an index into this list is *the* node number inside the program.
    pub nodes: Vec<[f64; 3]>,
    /// The file's own tag of each node (1, 2, ... for a generated mesh), for messages.
    pub node_tags: Vec<u64>,
    /// Volume elements, one block a kind.
    pub blocks: Vec<ElementBlock>,
    /// Physical groups of dimension 2 by name, in name order.
    pub surfaces: Vec<SurfaceGroup>,
    /// Names of the physical groups of dimension 3, in name order.
    pub volumes: Vec<String>,
}

/// Volume elements of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct ElementBlock {
    /// Kind of every element here.
    pub kind: ElementKind,
    /// Nodes, `kind.node_count()` an element, in Gmsh order.
    pub connectivity: Vec<u32>,
    /// The file's own tag of each element.
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

/// One boundary face: nodes in Gmsh order (corners, then edges, then centre).
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

    /// The corner nodes, counter-clockwise seen from where the normal points.
    pub fn corners(&self) -> &[u32] {
        &self.nodes[..self.kind.corner_count()]
    }

    /// The corner nodes ascending, the last `u32::MAX` for a triangle: the same for the two
    /// elements that share a face, whatever their order and orientation.
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

    /// This face seen from the other side: the normal is turned.
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

    /// Nodes of each element in turn.
    pub fn elements(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        self.connectivity.chunks_exact(self.kind.node_count())
    }
}

impl Mesh {
    /// Number of volume elements.
    pub fn element_count(&self) -> usize {
        self.blocks.iter().map(ElementBlock::len).sum()
    }

    /// The surface group of that name.
    pub fn surface(&self, name: &str) -> Option<&SurfaceGroup> {
        self.surfaces.iter().find(|s| s.name == name)
    }

    /// Least and largest distance of some nodes from the z axis, mm; infinity and 0 of none.
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
