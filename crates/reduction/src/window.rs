//! The reduced gear of one window.

use std::sync::{Arc, OnceLock};

use faer::{Mat, MatRef};
use fem::dense;
use geometry::Side;

use crate::cyclic::ToothBlocks;

/// Compliance of a window.
pub(crate) enum Compliance {
    /// As it is.
    Whole(Mat<f64>),
    /// Of teeth that are all alike.
    Teeth(ToothBlocks),
}

/// A gear reduced to the flanks of some neighbouring teeth.
#[derive(Debug, Clone)]
pub struct ReducedGear {
    /// Teeth, counter-clockwise, 0 .. z-1, numbered as in the frame of the matrices.
    pub teeth: Vec<u32>,
    /// Sides of the teeth whose nodes are kept.
    pub sides: Vec<Side>,
    /// Boundary nodes, as numbers of the mesh, ascending (for a gear reduced to grids: 0, 1, ... through its grids in
    /// order). Coordinate 3 i + axis belongs to `nodes[i]`.
    pub nodes: Vec<u32>,
    compliance: OnceLock<Mat<f64>>,
    /// What C is made of, where its teeth are all alike.
    blocks: Option<ToothBlocks>,
    stiffness: OnceLock<Option<Mat<f64>>>,
}

impl ReducedGear {
    pub(crate) fn new(teeth: Vec<u32>, sides: Vec<Side>, nodes: Vec<u32>, compliance: Compliance) -> Self {
        let (compliance, blocks) = match compliance {
            Compliance::Whole(compliance) => (OnceLock::from(compliance), None),
            Compliance::Teeth(blocks) => (OnceLock::new(), Some(blocks)),
        };
        Self { teeth, sides, nodes, compliance, blocks, stiffness: OnceLock::new() }
    }

    /// C, mm/N, 3 n x 3 n. For a gear condensed by its layers ([`crate::LayerStack`]) it has only the columns of its
    /// first tooth, whose nodes come first. For identical teeth it is computed on first request, because contact by
    /// tables does not need it.
    pub fn compliance(&self) -> &Mat<f64> {
        let joined = || self.blocks.as_ref().map(|blocks| blocks.columns(self.nodes.len())).unwrap_or_else(Mat::new);
        self.compliance.get_or_init(joined)
    }

    /// What C is made of, where the teeth are all alike.
    pub(crate) fn blocks(&self) -> Option<&ToothBlocks> {
        self.blocks.as_ref()
    }

    /// Number of coordinates, three per boundary node.
    pub fn coordinates(&self) -> usize {
        3 * self.nodes.len()
    }

    /// Position of a mesh node among the boundary nodes.
    pub fn position(&self, node: u32) -> Option<usize> {
        self.nodes.binary_search(&node).ok()
    }

    /// K^ = C^-1, N/mm, 3 n x 3 n, computed on first request, because contact needs only C.
    ///
    /// `None` if C is singular (a grid has more nodes than the mesh can resolve) or is not known completely.
    pub fn stiffness(&self) -> Option<&Mat<f64>> {
        let inverse = || {
            if self.compliance().ncols() < self.compliance().nrows() {
                return None;
            }
            let factor = dense::cholesky(self.compliance().as_ref()).ok()?;
            Some(dense::inverse_of_product(factor.as_ref()))
        };
        self.stiffness.get_or_init(inverse).as_ref()
    }

    /// Forces K^ u (N) that hold the coordinates at u (mm); one step of refinement makes up for the round-off of the
    /// inverse.
    pub(crate) fn forces(&self, u: &[f64]) -> Option<Vec<f64>> {
        let f = self.forces_of(MatRef::from_column_major_slice(u, u.len(), 1))?;
        Some(f.col_as_slice(0).to_vec())
    }

    /// [`Self::forces`] of several u, column by column: the matrices are gone through once for all.
    pub(crate) fn forces_of(&self, u: MatRef<'_, f64>) -> Option<Mat<f64>> {
        let stiffness = self.stiffness()?;
        let mut f = dense::product(stiffness.as_ref(), u);
        let left = u - dense::product(self.compliance().as_ref(), f.as_ref());
        f += dense::product(stiffness.as_ref(), left.as_ref());
        Some(f)
    }

    /// Strain energy u' K^ u / 2, N mm; NaN if there is no K^ or `u` belongs to another window.
    pub fn strain_energy(&self, u: &[f64]) -> f64 {
        if u.len() != self.coordinates() {
            return f64::NAN;
        }
        self.forces(u).map_or(f64::NAN, |f| 0.5 * f.iter().zip(u).map(|(f, u)| f * u).sum::<f64>())
    }
}

/// A reduced gear and its position on the gear.
#[derive(Debug, Clone)]
pub struct Window {
    /// Matrices, shared by all windows of a cyclic gear.
    pub reduced: Arc<ReducedGear>,
    /// Pitches by which the frame of the matrices is rotated relative to the gear's own frame: tooth t of the matrices
    /// is the gear's tooth t + `shift` (mod z).
    pub shift: u32,
}
