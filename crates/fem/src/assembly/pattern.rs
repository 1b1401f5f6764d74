//! Block pattern of the lower triangle: which free nodes share an element.

use std::ops::Range;

use mesh::Mesh;
use rayon::prelude::*;

use crate::{DofMap, FemError};

/// For each free node the free nodes of equal or higher number that share an element with it, ascending.
pub(super) struct Pattern {
    /// Start of each node's list in `neighbours`; one entry more than there are free nodes.
    pub starts: Vec<usize>,
    neighbours: Vec<u32>,
    dofs: DofMap,
}

/// Nodes that one parallel task works on.
const CHUNK: usize = 512;

impl Pattern {
    pub(super) fn new(mesh: &Mesh, dofs: &DofMap) -> Result<Self, FemError> {
        check(mesh, dofs)?;
        let touching = ElementsOfNode::new(mesh, dofs);
        let lists: Vec<(Vec<usize>, Vec<u32>)> = dofs
            .free_nodes()
            .par_chunks(CHUNK)
            .enumerate()
            .map(|(chunk, nodes)| {
                let (mut counts, mut all, mut own) = (Vec::new(), Vec::new(), Vec::new());
                for position in chunk * CHUNK..chunk * CHUNK + nodes.len() {
                    own.clear();
                    for &(block, element) in touching.of(position) {
                        let block = &mesh.blocks[block as usize];
                        let nodes = block.kind.node_count();
                        let element = &block.connectivity[element as usize * nodes..][..nodes];
                        let free = element.iter().filter_map(|&node| dofs.position(node));
                        own.extend(free.filter(|&p| p >= position).map(|p| p as u32));
                    }
                    own.sort_unstable();
                    own.dedup();
                    if own.is_empty() {
                        own.push(position as u32); // a node of no element still has its diagonal
                    }
                    counts.push(own.len());
                    all.extend_from_slice(&own);
                }
                (counts, all)
            })
            .collect();
        let mut starts = Vec::with_capacity(dofs.free_nodes().len() + 1);
        let mut neighbours = Vec::with_capacity(lists.iter().map(|(_, all)| all.len()).sum());
        let mut total = 0;
        starts.push(total);
        for (counts, all) in lists {
            for count in counts {
                total += count;
                starts.push(total);
            }
            neighbours.extend_from_slice(&all);
        }
        Ok(Self { starts, neighbours, dofs: dofs.clone() })
    }

    pub(super) fn node_count(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn position(&self, node: u32) -> Option<usize> {
        self.dofs.position(node)
    }

    /// Neighbours of a free node, itself first.
    pub(super) fn column(&self, position: usize) -> &[u32] {
        &self.neighbours[self.starts[position]..self.starts[position + 1]]
    }

    /// Splits the free nodes into `count` ranges with about equally many neighbours.
    pub(super) fn ranges(&self, count: usize) -> Vec<Range<usize>> {
        let mut ends: Vec<usize> =
            (1..count).map(|k| self.starts.partition_point(|&s| s < self.neighbours.len() * k / count)).collect();
        ends.push(self.node_count());
        let mut start = 0;
        ends.into_iter().map(|end| std::mem::replace(&mut start, end)..end).collect()
    }
}

/// For each free node the elements it belongs to, as (block, element), ascending.
struct ElementsOfNode {
    starts: Vec<usize>,
    elements: Vec<(u32, u32)>,
}

impl ElementsOfNode {
    fn new(mesh: &Mesh, dofs: &DofMap) -> Self {
        let mut starts = vec![0usize; dofs.free_nodes().len() + 1];
        for node in mesh.blocks.iter().flat_map(|b| &b.connectivity) {
            if let Some(p) = dofs.position(*node) {
                starts[p + 1] += 1;
            }
        }
        for p in 1..starts.len() {
            starts[p] += starts[p - 1];
        }
        let mut next = starts.clone();
        let mut elements = vec![(0, 0); starts[starts.len() - 1]];
        for (b, block) in mesh.blocks.iter().enumerate() {
            for (e, element) in block.elements().enumerate() {
                for p in element.iter().filter_map(|&node| dofs.position(node)) {
                    elements[next[p]] = (b as u32, e as u32);
                    next[p] += 1;
                }
            }
        }
        Self { starts, elements }
    }

    fn of(&self, position: usize) -> &[(u32, u32)] {
        &self.elements[self.starts[position]..self.starts[position + 1]]
    }
}

/// The mesh's own consistency, as far as assembly relies on it.
fn check(mesh: &Mesh, dofs: &DofMap) -> Result<(), FemError> {
    if dofs.node_count() != mesh.nodes.len() {
        return Err(FemError::Shape {
            what: "nodes of the numbering",
            expected: mesh.nodes.len(),
            found: dofs.node_count(),
        });
    }
    check_blocks(mesh)
}

/// Every block has whole elements, one tag each, and nodes that exist.
pub(crate) fn check_blocks(mesh: &Mesh) -> Result<(), FemError> {
    for block in &mesh.blocks {
        if block.connectivity.len() != block.tags.len() * block.kind.node_count() {
            return Err(FemError::RaggedBlock {
                kind: block.kind.name(),
                connectivity: block.connectivity.len(),
                tags: block.tags.len(),
            });
        }
        for (element, &tag) in block.elements().zip(&block.tags) {
            if let Some(&node) = element.iter().find(|&&node| node as usize >= mesh.nodes.len()) {
                return Err(FemError::NodeOutOfRange { tag, node, node_count: mesh.nodes.len() });
            }
        }
    }
    Ok(())
}
