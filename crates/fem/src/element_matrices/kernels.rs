//! Element matrices as lower triangles of node blocks.

use faer::Mat;
use mesh::{ElementKind, element::QuadratureRule};

use super::{
    BUBBLES, ElementOptions, IncompatibleModes, Integration, Table,
    blocks::block_index,
    bubble_gradients, checked_jacobian, gradients,
    incompatible::{Condensed, condense},
};
use crate::{FemError, Material};

/// Largest number of block rows: 27 nodes, or 8 nodes and 3 bubbles.
const MAX_ROWS: usize = 27;

/// Stiffness of elements of one kind; one 3 x 3 block (row-major, N/mm) a node pair.
pub(crate) struct StiffnessKernel {
    kind: ElementKind,
    modes: IncompatibleModes,
    table: Table,
    centre_dn: Vec<[f64; 3]>,
    lambda: f64,
    mu: f64,
}

impl StiffnessKernel {
    pub(crate) fn new(kind: ElementKind, material: &Material, options: &ElementOptions) -> Self {
        let rule = match options.integration {
            Integration::Full => QuadratureRule::Stiffness,
            Integration::Reduced => QuadratureRule::Reduced,
        };
        let modes = match kind {
            ElementKind::Hex8 => options.incompatible_modes,
            _ => IncompatibleModes::Off,
        };
        let mut centre_dn = vec![[0.0; 3]; kind.node_count()];
        kind.shape_gradient(kind.centre(), &mut centre_dn);
        let (lambda, mu) = material.lame_mpa();
        Self { kind, modes, table: Table::new(kind, rule), centre_dn, lambda, mu }
    }

    /// Block rows that [`StiffnessKernel::fill`] works on: the nodes, and the bubbles where there are any.
    fn rows(&self) -> usize {
        let bubbles = if self.modes == IncompatibleModes::Off { 0 } else { BUBBLES };
        self.kind.node_count() + bubbles
    }

    /// Length of the buffer for [`StiffnessKernel::fill`].
    pub(crate) fn buffer_len(&self) -> usize {
        block_index(self.rows(), 0)
    }

    /// Writes the stiffness; its blocks are the first `block_index(node_count, 0)` entries of `blocks`.
    ///
    /// Returns what is needed to recover the incompatible modes where there are any.
    pub(crate) fn fill(
        &self,
        coordinates: &[[f64; 3]],
        tag: u64,
        blocks: &mut [[f64; 9]],
    ) -> Result<Option<Condensed>, FemError> {
        let nodes = self.kind.node_count();
        let rows = self.rows();
        let blocks = &mut blocks[..block_index(rows, 0)];
        blocks.fill([0.0; 9]);
        let mut g = [[0.0; 3]; MAX_ROWS];
        let centre =
            if rows > nodes { Some(checked_jacobian(self.kind, tag, coordinates, &self.centre_dn)?) } else { None };
        for point in &self.table.points {
            let (inverse, det) = checked_jacobian(self.kind, tag, coordinates, &point.dn)?;
            gradients(&inverse, &point.dn, &mut g);
            if let Some((inverse_centre, det_centre)) = &centre {
                let bubbles = bubble_gradients(self.modes, point.xi, inverse_centre, *det_centre, det);
                g[nodes..rows].copy_from_slice(&bubbles);
            }
            let volume = point.weight * det;
            self.add_point(&g[..rows], volume, blocks);
        }
        if centre.is_none() {
            return Ok(None);
        }
        match condense(blocks) {
            Some(condensed) => Ok(Some(condensed)),
            None => Err(FemError::Inverted { kind: self.kind.name(), tag, det_j_mm3: 0.0 }),
        }
    }

    /// Adds one point's share: K_ij += dV (lambda g_i g_j' + mu g_j g_i' + mu (g_i . g_j) I).
    fn add_point(&self, g: &[[f64; 3]], volume: f64, blocks: &mut [[f64; 9]]) {
        let (lambda, mu) = (self.lambda * volume, self.mu * volume);
        let mut blocks = blocks.iter_mut();
        for (i, gi) in g.iter().enumerate() {
            let (l, m) = (gi.map(|v| lambda * v), gi.map(|v| mu * v));
            for (gj, block) in g[..=i].iter().zip(blocks.by_ref()) {
                let dot = m[0] * gj[0] + m[1] * gj[1] + m[2] * gj[2];
                for a in 0..3 {
                    for b in 0..3 {
                        block[3 * a + b] += l[a] * gj[b] + m[b] * gj[a];
                    }
                    block[4 * a] += dot;
                }
            }
        }
    }
}

/// Consistent mass of elements of one kind; one scalar (t) a node pair, the same for x, y and z.
pub(crate) struct MassKernel {
    kind: ElementKind,
    table: Table,
    density: f64,
}

impl MassKernel {
    pub(crate) fn new(kind: ElementKind, material: &Material) -> Self {
        let table = Table::new(kind, QuadratureRule::Mass);
        Self { kind, table, density: material.density_t_per_mm3() }
    }

    /// Writes the lower triangle, row by row.
    pub(crate) fn fill(&self, coordinates: &[[f64; 3]], tag: u64, entries: &mut [f64]) -> Result<(), FemError> {
        entries.fill(0.0);
        for point in &self.table.points {
            let (_, det) = checked_jacobian(self.kind, tag, coordinates, &point.dn)?;
            let mass = self.density * point.weight * det;
            let mut entries = entries.iter_mut();
            for (i, &ni) in point.n.iter().enumerate() {
                for (&nj, entry) in point.n[..=i].iter().zip(entries.by_ref()) {
                    *entry += mass * ni * nj;
                }
            }
        }
        Ok(())
    }
}

/// Stiffness matrix of one element, 3n x 3n (N/mm). Row 3i + axis belongs to local node i.
///
/// # Errors
/// [`FemError::Shape`] for a wrong number of nodes, [`FemError::Inverted`] with the given `tag`.
pub fn element_stiffness(
    kind: ElementKind,
    coordinates_mm: &[[f64; 3]],
    tag: u64,
    material: &Material,
    options: &ElementOptions,
) -> Result<Mat<f64>, FemError> {
    let nodes = checked_count(kind, coordinates_mm)?;
    let kernel = StiffnessKernel::new(kind, material, options);
    let mut blocks = vec![[0.0; 9]; kernel.buffer_len()];
    kernel.fill(coordinates_mm, tag, &mut blocks)?;
    let mut dense = Mat::zeros(3 * nodes, 3 * nodes);
    for i in 0..nodes {
        for j in 0..=i {
            for a in 0..3 {
                for b in 0..3 {
                    let value = blocks[block_index(i, j)][3 * a + b];
                    dense[(3 * i + a, 3 * j + b)] = value;
                    dense[(3 * j + b, 3 * i + a)] = value;
                }
            }
        }
    }
    Ok(dense)
}

/// Consistent mass matrix of one element for one direction, n x n (t).
///
/// # Errors
/// The errors of [`element_stiffness`].
pub fn element_mass(
    kind: ElementKind,
    coordinates_mm: &[[f64; 3]],
    tag: u64,
    material: &Material,
) -> Result<Mat<f64>, FemError> {
    let nodes = checked_count(kind, coordinates_mm)?;
    let mut entries = vec![0.0; block_index(nodes, 0)];
    MassKernel::new(kind, material).fill(coordinates_mm, tag, &mut entries)?;
    Ok(Mat::from_fn(nodes, nodes, |i, j| entries[block_index(i.max(j), i.min(j))]))
}

fn checked_count(kind: ElementKind, coordinates: &[[f64; 3]]) -> Result<usize, FemError> {
    let expected = kind.node_count();
    if coordinates.len() == expected {
        Ok(expected)
    } else {
        Err(FemError::Shape { what: "nodes of an element", expected, found: coordinates.len() })
    }
}
