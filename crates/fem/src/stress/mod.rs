//! Stress at nodes, computed from displacements.
//!
//! In each element the stress is evaluated at the points where it is most accurate (hex: 2^3 Gauss points, tet10: 4,
//! tet4: 1, wedge: 3 x 2). The linear field through these points is extrapolated to the nodes and averaged over the
//! elements of a node. For hex8 the strains of the incompatible modes are included. Source of the points: Barlow, IJNME
//! 10, 1976.
//!
//! Components: xx, yy, zz, xy, yz, zx, MPa.

mod element;
mod patch;
mod surface;

use faer::{Mat, MatRef};
use mesh::{Face, Mesh};
use rayon::prelude::*;

use crate::{
    DofMap, ElementOptions, FemError, Material,
    assembly::check_blocks,
    column_blocks::{ColumnBlocks, ColumnBlocksMut},
};
use element::ElementStress;
use patch::Patches;

/// Stress at nodes in their order, MPa.
type NodalStress = Vec<[f64; 6]>;

/// Stress at every node (MPa) from the displacement of every node (mm).
///
/// Nodes that belong to no element get zero. The result has the same bits for any number of threads.
///
/// # Errors
/// [`FemError::Shape`] if there is not one displacement per node; [`FemError::Inverted`], [`FemError::NodeOutOfRange`],
/// [`FemError::RaggedBlock`].
pub fn nodal_stress(
    mesh: &Mesh,
    material: &Material,
    options: &ElementOptions,
    displacement: &[[f64; 3]],
) -> Result<Vec<[f64; 6]>, FemError> {
    let all = nodal_stresses(mesh, material, options, &[displacement], |_| true)?;
    Ok(all.into_iter().next().unwrap_or_default())
}

/// [`nodal_stress`] for several displacement fields at the `wanted` nodes; other nodes get zero. Quantities that depend
/// only on the shape of an element are computed once for all fields. Elements without a wanted node are skipped.
///
/// # Errors
/// The errors of [`nodal_stress`], for elements with wanted nodes.
pub fn nodal_stresses(
    mesh: &Mesh,
    material: &Material,
    options: &ElementOptions,
    displacements: &[&[[f64; 3]]],
    wanted: impl Fn(u32) -> bool + Sync,
) -> Result<Vec<Vec<[f64; 6]>>, FemError> {
    check_blocks(mesh)?;
    if let Some(wrong) = displacements.iter().find(|u| u.len() != mesh.nodes.len()) {
        return Err(FemError::Shape { what: "displacements", expected: mesh.nodes.len(), found: wrong.len() });
    }
    let mut sums = vec![vec![[0.0; 6]; mesh.nodes.len()]; displacements.len()];
    let mut counts = vec![0u32; mesh.nodes.len()];
    for block in &mesh.blocks {
        let kernel = ElementStress::new(block.kind, material, options);
        let of_element = |(element, &tag): (&[u32], &u64)| {
            if !element.iter().any(|&node| wanted(node)) {
                return Ok(None);
            }
            let at = |list: &[[f64; 3]]| -> Vec<[f64; 3]> { element.iter().map(|&node| list[node as usize]).collect() };
            let prepared = kernel.prepare(&at(&mesh.nodes), tag)?;
            Ok(Some(displacements.iter().map(|u| kernel.at_nodes(&prepared, &at(u))).collect::<Vec<_>>()))
        };
        let stresses: Vec<Result<Option<Vec<NodalStress>>, FemError>> =
            block.connectivity.par_chunks(block.kind.node_count()).zip(&block.tags).map(of_element).collect();
        for (element, stresses) in block.elements().zip(stresses) {
            let Some(stresses) = stresses? else { continue };
            for (i, &node) in element.iter().enumerate().filter(|(_, node)| wanted(**node)) {
                for (sum, stress) in sums.iter_mut().zip(&stresses) {
                    (0..6).for_each(|k| sum[node as usize][k] += stress[i][k]);
                }
                counts[node as usize] += 1;
            }
        }
    }
    for sum in &mut sums {
        for (total, count) in sum.iter_mut().zip(&counts) {
            *total = total.map(|s| s / f64::from((*count).max(1)));
        }
    }
    Ok(sums)
}

/// Von Mises equivalent stress, MPa.
pub fn von_mises(stress: &[f64; 6]) -> f64 {
    let [x, y, z, xy, yz, zx] = *stress;
    let normal = (x - y).powi(2) + (y - z).powi(2) + (z - x).powi(2);
    (0.5 * normal + 3.0 * (xy * xy + yz * yz + zx * zx)).sqrt()
}

/// Largest principal stress, MPa (positive in tension).
pub fn max_principal(stress: &[f64; 6]) -> f64 {
    principal_range(stress)[1]
}

/// Smallest principal stress, MPa (negative in compression).
pub fn min_principal(stress: &[f64; 6]) -> f64 {
    principal_range(stress)[0]
}

/// Smallest and largest principal stress, MPa.
fn principal_range(stress: &[f64; 6]) -> [f64; 2] {
    let [x, y, z, xy, yz, zx] = *stress;
    let values = nalgebra::Matrix3::new(x, xy, zx, xy, y, yz, zx, yz, z).symmetric_eigenvalues();
    [values.min(), values.max()]
}

/// Stress at chosen nodes as a linear map of the free displacements: the left factor of stress modes.
///
/// ```text
/// sigma = S u,   row 6 i + k: component k at the i-th node asked for   [MPa/mm]
/// ```
/// The stress modes of a reduced body are S times its expanded boundary displacements.
#[derive(Debug, Clone)]
pub struct StressOperator {
    /// For each node asked for: (free node, 6 x 3 block, row-major).
    rows: Vec<Vec<(usize, [f64; 18])>>,
    free_count: usize,
}

impl StressOperator {
    /// Prepares the map for `nodes`. Displacements of fixed nodes are zero.
    ///
    /// # Errors
    /// [`FemError::Shape`] if `dofs` was made for another number of nodes or a node does not exist;
    /// [`FemError::Inverted`], [`FemError::NodeOutOfRange`], [`FemError::RaggedBlock`].
    pub fn new(
        mesh: &Mesh,
        material: &Material,
        options: &ElementOptions,
        dofs: &DofMap,
        nodes: &[u32],
    ) -> Result<Self, FemError> {
        check_blocks(mesh)?;
        let places = places(mesh, dofs, nodes)?;
        let mut rows = vec![(Vec::new(), 0u32); nodes.len()];
        for block in &mesh.blocks {
            let kernel = ElementStress::new(block.kind, material, options);
            for (element, &tag) in block.elements().zip(&block.tags) {
                if element.iter().all(|&node| places[node as usize].is_empty()) {
                    continue;
                }
                let x: Vec<[f64; 3]> = element.iter().map(|&n| mesh.nodes[n as usize]).collect();
                let prepared = kernel.prepare(&x, tag)?;
                let mut u = vec![[0.0; 3]; element.len()];
                // column by column: the stress of a unit move
                let mut blocks = vec![vec![[0.0; 18]; element.len()]; element.len()];
                for j in 0..element.len() {
                    for axis in 0..3 {
                        u[j][axis] = 1.0;
                        for (i, stress) in kernel.at_nodes(&prepared, &u).iter().enumerate() {
                            (0..6).for_each(|k| blocks[i][j][3 * k + axis] = stress[k]);
                        }
                        u[j][axis] = 0.0;
                    }
                }
                for (&node, blocks) in element.iter().zip(&blocks) {
                    for &place in &places[node as usize] {
                        let (row, touching) = &mut rows[place];
                        *touching += 1;
                        for (&other, block) in element.iter().zip(blocks) {
                            if let Some(position) = dofs.position(other) {
                                row.push((position, *block));
                            }
                        }
                    }
                }
            }
        }
        let rows = rows.into_iter().map(|(row, touching)| merge(row, touching)).collect();
        Ok(Self { rows, free_count: dofs.free_count() })
    }

    /// Stress on free surfaces, computed only from the displacement of their faces: strains in the tangent plane, no
    /// traction across it. Theory (22c), (22d).
    ///
    /// Around each corner a polynomial is fitted through the most accurate points of the adjacent faces; it never
    /// combines points of different surfaces. The stress at a node is the mean over its faces, or zero if it is on
    /// none. The faces around the nodes must be free of traction.
    ///
    /// # Errors
    /// [`FemError::Shape`] if `dofs` was made for another number of nodes, or a node (in `nodes` or of a face) does not
    /// exist.
    pub fn on_surface(
        mesh: &Mesh,
        material: &Material,
        dofs: &DofMap,
        surfaces: &[Vec<Face>],
        nodes: &[u32],
    ) -> Result<Self, FemError> {
        let places = places(mesh, dofs, nodes)?;
        let last = surfaces.iter().flatten().flat_map(Face::nodes).max().map_or(0, |&n| n as usize);
        if last >= mesh.nodes.len() && last > 0 {
            return Err(FemError::Shape { what: "nodes", expected: mesh.nodes.len(), found: last });
        }
        let mut rows = vec![(Vec::new(), 0u32); nodes.len()];
        let each = surfaces.iter().map(|faces| (Patches::new(&mesh.nodes, faces, material), faces));
        for (mut patches, faces) in each {
            for (number, face) in faces.iter().enumerate() {
                for (i, &node) in face.nodes().iter().enumerate().filter(|(_, n)| !places[**n as usize].is_empty()) {
                    let blocks = patches.at_node(number, i);
                    if blocks.is_empty() {
                        continue;
                    }
                    for &place in &places[node as usize] {
                        let (row, touching) = &mut rows[place];
                        *touching += 1;
                        row.extend(blocks.iter().filter_map(|&(other, block)| Some((dofs.position(other)?, block))));
                    }
                }
            }
        }
        let rows = rows.into_iter().map(|(row, touching)| merge(row, touching)).collect();
        Ok(Self { rows, free_count: dofs.free_count() })
    }

    /// Number of chosen nodes.
    pub fn node_count(&self) -> usize {
        self.rows.len()
    }

    /// Free nodes whose displacement affects the stress of any of several maps, as positions among the free nodes,
    /// ascending.
    pub fn moved<'a>(operators: impl Iterator<Item = &'a Self>) -> Vec<usize> {
        let mut moved: Vec<usize> = operators.flat_map(|o| &o.rows).flatten().map(|(position, _)| *position).collect();
        moved.sort_unstable();
        moved.dedup();
        moved
    }

    /// The same map restricted to the displacement of the free nodes `moved` (ascending), which must include all nodes
    /// that it depends on.
    #[must_use]
    pub fn of(mut self, moved: &[usize]) -> Self {
        for (position, _) in self.rows.iter_mut().flatten() {
            *position = moved.partition_point(|p| p < position);
        }
        self.free_count = 3 * moved.len();
        self
    }

    /// Rows of the nodes in `range`, as columns, n x 6 nodes, MPa/mm: (S')_i, with which the adjoint method starts.
    ///
    /// # Errors
    /// [`FemError::Shape`] if the range exceeds the number of nodes.
    pub fn transposed(&self, range: std::ops::Range<usize>) -> Result<Mat<f64>, FemError> {
        let count = self.rows.len();
        let rows = self.rows.get(range.clone());
        let rows = rows.ok_or(FemError::Shape { what: "stress nodes", expected: count, found: range.end })?;
        let mut columns = Mat::zeros(self.free_count, 6 * rows.len());
        for (i, row) in rows.iter().enumerate() {
            for (position, block) in row {
                for k in 0..6 {
                    for axis in 0..3 {
                        columns[(3 * position + axis, 6 * i + k)] = block[3 * k + axis];
                    }
                }
            }
        }
        Ok(columns)
    }

    /// Stress for one or many columns of free displacements (n x k, mm): 6 x nodes rows, k columns, MPa.
    ///
    /// # Errors
    /// [`FemError::Shape`] if `displacement` does not have one row per free degree of freedom.
    pub fn apply(&self, displacement: MatRef<'_, f64>) -> Result<Mat<f64>, FemError> {
        if displacement.nrows() != self.free_count {
            return Err(FemError::Shape { what: "rows", expected: self.free_count, found: displacement.nrows() });
        }
        let mut result = Mat::zeros(6 * self.rows.len(), displacement.ncols());
        result.as_mut().par_col_chunks_mut(1).zip(displacement.par_col_chunks(1)).for_each(|(mut stress, u)| {
            let u: Vec<f64> = u.col(0).iter().copied().collect();
            for (i, row) in self.rows.iter().enumerate() {
                let mut sum = [0.0; 6];
                for (position, block) in row {
                    let u = &u[3 * position..3 * position + 3];
                    for (s, b) in sum.iter_mut().zip(block.chunks_exact(3)) {
                        *s += b[0] * u[0] + b[1] * u[1] + b[2] * u[2];
                    }
                }
                sum.into_iter().enumerate().for_each(|(k, s)| stress[(6 * i + k, 0)] = s);
            }
        });
        Ok(result)
    }
}

/// Where in `nodes` each node of the mesh is asked for.
fn places(mesh: &Mesh, dofs: &DofMap, nodes: &[u32]) -> Result<Vec<Vec<usize>>, FemError> {
    let count = mesh.nodes.len();
    let wrong = nodes.iter().map(|&n| n as usize).find(|&n| n >= count);
    if let Some(found) = wrong.or((dofs.node_count() != count).then_some(dofs.node_count())) {
        return Err(FemError::Shape { what: "nodes", expected: count, found });
    }
    let mut places: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (place, &node) in nodes.iter().enumerate() {
        places[node as usize].push(place);
    }
    Ok(places)
}

/// Sums the blocks of one node by free node and divides by the number of elements.
fn merge(mut row: Vec<(usize, [f64; 18])>, touching: u32) -> Vec<(usize, [f64; 18])> {
    row.sort_by_key(|&(position, _)| position); // stable: sums keep their order
    let mut merged: Vec<(usize, [f64; 18])> = Vec::new();
    for (position, block) in row {
        match merged.last_mut() {
            Some((last, sum)) if *last == position => {
                sum.iter_mut().zip(block).for_each(|(s, b)| *s += b);
            }
            _ => merged.push((position, block)),
        }
    }
    let share = 1.0 / f64::from(touching.max(1));
    merged.iter_mut().for_each(|(_, block)| block.iter_mut().for_each(|b| *b *= share));
    merged
}
