//! Which degrees of freedom are free, and their positions in the matrices.

use crate::FemError;

/// Numbering of the free degrees of freedom: three (x, y, z) for each node that is not fixed.
///
/// Free nodes keep their order; the p-th free node owns rows 3p, 3p+1, 3p+2.
///
/// # Example
/// ```
/// let dofs = fem::DofMap::new(3, &[1]);
/// assert_eq!(dofs.free_count(), 6);
/// assert_eq!(dofs.dof(2, 0), Some(3));
/// assert_eq!(dofs.dof(1, 0), None);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DofMap {
    position: Vec<u32>,
    free_nodes: Vec<u32>,
}

const FIXED: u32 = u32::MAX;

impl DofMap {
    /// Numbering for `node_count` nodes; the nodes in `fixed` do not move.
    ///
    /// Entries of `fixed` may repeat; entries beyond the last node have no effect.
    pub fn new(node_count: usize, fixed: &[u32]) -> Self {
        let mut position = vec![0; node_count];
        for &node in fixed {
            if let Some(entry) = position.get_mut(node as usize) {
                *entry = FIXED;
            }
        }
        let mut free_nodes = Vec::with_capacity(node_count);
        for (node, entry) in position.iter_mut().enumerate() {
            if *entry != FIXED {
                *entry = free_nodes.len() as u32;
                free_nodes.push(node as u32);
            }
        }
        Self { position, free_nodes }
    }

    /// Number of nodes, fixed ones included.
    pub fn node_count(&self) -> usize {
        self.position.len()
    }

    /// Number of free degrees of freedom: the order of the matrices.
    pub fn free_count(&self) -> usize {
        3 * self.free_nodes.len()
    }

    /// The free nodes, ascending.
    pub fn free_nodes(&self) -> &[u32] {
        &self.free_nodes
    }

    /// Position of a node among the free ones; `None` if it is fixed or unknown.
    pub fn position(&self, node: u32) -> Option<usize> {
        self.position.get(node as usize).filter(|&&p| p != FIXED).map(|&p| p as usize)
    }

    /// Matrix row of a node's displacement along `axis` (0, 1, 2); `None` if it is fixed or unknown.
    pub fn dof(&self, node: u32, axis: usize) -> Option<usize> {
        if axis < 3 { self.position(node).map(|p| 3 * p + axis) } else { None }
    }

    /// Node and axis of a matrix row.
    pub fn node_and_axis(&self, dof: usize) -> Option<(u32, usize)> {
        self.free_nodes.get(dof / 3).map(|&node| (node, dof % 3))
    }

    /// Displacement of every node (mm) from those of the free degrees of freedom; fixed nodes have zero displacement.
    ///
    /// # Errors
    /// [`FemError::Shape`] if `free` does not have `free_count()` entries.
    pub fn to_nodes(&self, free: &[f64]) -> Result<Vec<[f64; 3]>, FemError> {
        if free.len() != self.free_count() {
            return Err(FemError::Shape { what: "free displacements", expected: self.free_count(), found: free.len() });
        }
        let mut all = vec![[0.0; 3]; self.node_count()];
        for (&node, u) in self.free_nodes.iter().zip(free.chunks_exact(3)) {
            all[node as usize].copy_from_slice(u);
        }
        Ok(all)
    }
}
