//! How the stress at a node follows from the displacement of the mesh.

use mesh::Face;

/// How the stress at a node comes from the displacement of the mesh.
#[derive(Debug, Clone, Copy)]
pub(crate) enum StressRecovery<'a> {
    /// From Gauss points of the elements, the mean over the elements of a node ([`fem::StressOperator::new`]): any
    /// node.
    Volume,
    /// From these free faces alone, the mean over the faces of a node ([`fem::StressOperator::on_surface`]): nodes on
    /// them.
    ///
    /// On a cyclic gear the faces must be whole orbits, or all that are about the nodes.
    Surface(&'a [Vec<Face>]),
}
