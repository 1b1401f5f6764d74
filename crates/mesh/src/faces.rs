//! Faces of the volume elements: which of them bound the body, and which elements they belong to.

use rayon::prelude::*;

use crate::{Face, Mesh, model::corner_key};

/// All faces of all volume elements, sorted by their corners.
///
/// A face of one element lies on the boundary of the body; a face of two elements lies inside.
#[derive(Debug, Clone)]
pub struct FaceTable {
    entries: Vec<Entry>,
}

/// A face of one element.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Entry {
    corners: [u32; 4],
    owner: FaceOwner,
}

/// A face of an element: the element and the number of the face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct FaceOwner {
    /// Number of the element in its block.
    pub element: u32,
    /// Number of the block in [`Mesh::blocks`].
    pub block: u16,
    /// Number of the face in [`ElementKind::faces`](crate::ElementKind::faces).
    pub local: u16,
}

impl FaceOwner {
    /// The face in global node numbers; its normal points out of the element.
    pub fn face(&self, mesh: &Mesh) -> Face {
        let block = &mesh.blocks[usize::from(self.block)];
        let (kind, local) = block.kind.faces()[usize::from(self.local)];
        let first = self.element as usize * block.kind.node_count();
        let mut nodes = [u32::MAX; 9];
        for (node, &l) in nodes.iter_mut().zip(local) {
            *node = block.connectivity[first + l];
        }
        Face::new(kind, &nodes[..local.len()])
    }

    /// The file's tag of the element.
    pub(crate) fn element_tag(&self, mesh: &Mesh) -> u64 {
        mesh.blocks[usize::from(self.block)].tags[self.element as usize]
    }
}

impl FaceTable {
    /// All faces of a mesh. The cost is n log n in the number of elements.
    pub fn new(mesh: &Mesh) -> Self {
        let count: usize = mesh.blocks.iter().map(|b| b.len() * b.kind.faces().len()).sum();
        let mut entries = Vec::with_capacity(count);
        for (block, of_kind) in (0_u16..).zip(&mesh.blocks) {
            for (element, nodes) in (0_u32..).zip(of_kind.elements()) {
                for (local, (kind, order)) in (0_u16..).zip(of_kind.kind.faces()) {
                    let mut corners = [u32::MAX; 4];
                    for (corner, &l) in corners.iter_mut().zip(&order[..kind.corner_count()]) {
                        *corner = nodes[l];
                    }
                    let owner = FaceOwner { element, block, local };
                    entries.push(Entry { corners: corner_key(&corners), owner });
                }
            }
        }
        entries.par_sort_unstable();
        Self { entries }
    }

    /// The elements that have a face with these corners (see [`Face::corner_key`]): none, one for a boundary face, two
    /// for an inner face.
    pub fn owners(&self, corner_key: [u32; 4]) -> impl ExactSizeIterator<Item = FaceOwner> + '_ {
        let first = self.entries.partition_point(|e| e.corners < corner_key);
        let count = self.entries[first..].iter().take_while(|e| e.corners == corner_key).count();
        self.entries[first..first + count].iter().map(|e| e.owner)
    }

    /// Faces that bound the body, in the order of elements.
    pub fn boundary(&self) -> Vec<FaceOwner> {
        let mut owners: Vec<FaceOwner> =
            self.shared().filter(|owners| owners.len() == 1).map(|owners| owners[0].owner).collect();
        owners.sort_unstable_by_key(|o| (o.block, o.element, o.local));
        owners
    }

    /// Faces inside the body with the two elements that share each.
    pub(crate) fn inner(&self) -> impl Iterator<Item = [FaceOwner; 2]> + '_ {
        self.shared().filter_map(|owners| match owners {
            [a, b] => Some([a.owner, b.owner]),
            _ => None,
        })
    }

    /// Faces of more than two elements: two bodies overlap, or elements are turned inside out.
    pub fn crowded(&self) -> Vec<FaceOwner> {
        self.shared().filter(|owners| owners.len() > 2).map(|owners| owners[0].owner).collect()
    }

    /// Runs of entries with the same corners.
    fn shared(&self) -> impl Iterator<Item = &[Entry]> {
        self.entries.chunk_by(|a, b| a.corners == b.corners)
    }
}
