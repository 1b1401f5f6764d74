//! Assembles the sparse stiffness and mass of a body from its elements.
//!
//! Element matrices are computed in parallel, batch by batch. Then each range of columns gathers its entries in element
//! order, so the sums have the same bits for any number of threads.

mod pattern;

use mesh::Mesh;
use rayon::prelude::*;

use crate::{
    DofMap, ElementOptions, FemError, Material, SymmetricMatrix,
    element_matrices::{MassKernel, StiffnessKernel, block_index},
};
use pattern::Pattern;
pub(crate) use pattern::check_blocks;

/// Stiffness and mass of the free degrees of freedom.
#[derive(Debug, Clone)]
pub struct System {
    /// Stiffness K, N/mm.
    pub stiffness: SymmetricMatrix,
    /// Consistent mass M, t.
    pub mass: SymmetricMatrix,
}

/// Stiffness K (N/mm) and consistent mass M (t) of the free degrees of freedom.
///
/// The result has the same bits for any number of threads.
///
/// # Errors
/// [`FemError::Inverted`], [`FemError::NodeOutOfRange`], [`FemError::RaggedBlock`], and [`FemError::Shape`] if `dofs`
/// was made for another number of nodes.
pub fn assemble(mesh: &Mesh, material: &Material, dofs: &DofMap, options: &ElementOptions) -> Result<System, FemError> {
    let pattern = Pattern::new(mesh, dofs)?;
    Ok(System { stiffness: stiffness_on(&pattern, mesh, material, options)?, mass: mass_on(&pattern, mesh, material)? })
}

/// Only the stiffness K (N/mm); see [`assemble`].
///
/// # Errors
/// The errors of [`assemble`].
pub fn assemble_stiffness(
    mesh: &Mesh,
    material: &Material,
    dofs: &DofMap,
    options: &ElementOptions,
) -> Result<SymmetricMatrix, FemError> {
    stiffness_on(&Pattern::new(mesh, dofs)?, mesh, material, options)
}

/// Only the consistent mass M (t); see [`assemble`].
///
/// # Errors
/// The errors of [`assemble`].
pub fn assemble_mass(mesh: &Mesh, material: &Material, dofs: &DofMap) -> Result<SymmetricMatrix, FemError> {
    mass_on(&Pattern::new(mesh, dofs)?, mesh, material)
}

/// Every node pair fills a 3 x 3 block; the diagonal blocks keep their lower triangle.
fn stiffness_on(
    pattern: &Pattern,
    mesh: &Mesh,
    material: &Material,
    options: &ElementOptions,
) -> Result<SymmetricMatrix, FemError> {
    // start of the three columns of free node j: 9 a pair, less the 3 above the diagonal
    let base = |j: usize| 9 * pattern.starts[j] - 3 * j;
    let nodes = pattern.node_count();
    let mut values = vec![0.0; base(nodes)];
    for block in &mesh.blocks {
        let kernel = StiffnessKernel::new(block.kind, material, options);
        let fill = |x: &[[f64; 3]], tag: u64, out: &mut [[f64; 9]]| kernel.fill(x, tag, out).map(drop);
        let add = |values: &mut [f64], column: &Column, k: &[f64; 9]| {
            let mut start = base(column.node) - column.slice_start;
            for b in 0..3 {
                for a in 0..3 {
                    if column.place == 0 && a < b {
                        continue;
                    }
                    let entry = if column.transposed { k[3 * b + a] } else { k[3 * a + b] };
                    values[start + 3 * column.place + a - b] += entry;
                }
                start += 3 * column.length - b;
            }
        };
        let buffer = kernel.buffer_len();
        pattern.gather(mesh, block, &mut values, base, buffer, &fill, &add)?;
    }
    let (mut starts, mut rows) = (vec![0; 3 * nodes + 1], Vec::with_capacity(values.len()));
    for j in 0..nodes {
        for b in 0..3 {
            let column = pattern.column(j).iter().flat_map(|&i| (0..3).map(move |a| 3 * i as usize + a));
            rows.extend(column.skip(b));
            starts[3 * j + b + 1] = rows.len();
        }
    }
    Ok(SymmetricMatrix::from_sorted_columns(3 * nodes, starts, rows, values))
}

/// Every node pair fills the diagonal of a 3 x 3 block with one number.
fn mass_on(pattern: &Pattern, mesh: &Mesh, material: &Material) -> Result<SymmetricMatrix, FemError> {
    let base = |j: usize| pattern.starts[j];
    let nodes = pattern.node_count();
    let mut pairs = vec![0.0; base(nodes)];
    for block in &mesh.blocks {
        let kernel = MassKernel::new(block.kind, material);
        let fill = |x: &[[f64; 3]], tag: u64, out: &mut [f64]| kernel.fill(x, tag, out);
        let add = |pairs: &mut [f64], column: &Column, m: &f64| {
            pairs[base(column.node) - column.slice_start + column.place] += m;
        };
        let buffer = block_index(block.kind.node_count(), 0);
        pattern.gather(mesh, block, &mut pairs, base, buffer, &fill, &add)?;
    }
    let mut starts = vec![0; 3 * nodes + 1];
    let (mut rows, mut values) = (Vec::with_capacity(3 * pairs.len()), Vec::with_capacity(3 * pairs.len()));
    for j in 0..nodes {
        for a in 0..3 {
            rows.extend(pattern.column(j).iter().map(|&i| 3 * i as usize + a));
            values.extend_from_slice(&pairs[base(j)..base(j + 1)]);
            starts[3 * j + a + 1] = rows.len();
        }
    }
    Ok(SymmetricMatrix::from_sorted_columns(3 * nodes, starts, rows, values))
}

/// Where an element's node pair goes.
struct Column {
    /// Free node that owns the column.
    node: usize,
    /// Place of the other node among the column's neighbours; 0 is the node itself.
    place: usize,
    /// Number of neighbours of the column.
    length: usize,
    /// Whether the element's block has to be mirrored.
    transposed: bool,
    /// First value of the slice being filled.
    slice_start: usize,
}

/// Ranges of columns that are gathered independently. Fixed, so that threads change nothing.
const RANGES: usize = 16;
/// Bytes of element matrices held at a time.
const BATCH_BYTES: usize = 32 << 20;

impl Pattern {
    /// Computes the element matrices of a block (`fill`) and sums them into `values` (`add`).
    #[allow(clippy::too_many_arguments)] // two closures and what they share; a struct would be used once
    fn gather<T: Copy + Default + Send + Sync>(
        &self,
        mesh: &Mesh,
        block: &mesh::ElementBlock,
        values: &mut [f64],
        base: impl Fn(usize) -> usize + Sync,
        buffer: usize,
        fill: &(impl Fn(&[[f64; 3]], u64, &mut [T]) -> Result<(), FemError> + Sync),
        add: &(impl Fn(&mut [f64], &Column, &T) + Sync),
    ) -> Result<(), FemError> {
        let nodes = block.kind.node_count();
        let ranges = self.ranges(RANGES);
        let batch = (BATCH_BYTES / (buffer * size_of::<T>())).max(1);
        let mut matrices = vec![T::default(); buffer * batch.min(block.len())];
        for (connectivity, tags) in block.connectivity.chunks(nodes * batch).zip(block.tags.chunks(batch)) {
            let results: Vec<Result<(), FemError>> = matrices
                .par_chunks_mut(buffer)
                .zip(connectivity.par_chunks(nodes))
                .zip(tags)
                .map(|((matrix, element), &tag)| {
                    let mut x = [[0.0; 3]; 27];
                    for (x, &node) in x.iter_mut().zip(element) {
                        *x = mesh.nodes[node as usize];
                    }
                    fill(&x[..nodes], tag, matrix)
                })
                .collect();
            results.into_iter().collect::<Result<(), FemError>>()?; // the first in element order
            let mut slices = Vec::with_capacity(ranges.len());
            let mut rest = &mut *values;
            for range in &ranges {
                let (slice, tail) = rest.split_at_mut(base(range.end) - base(range.start));
                slices.push(slice);
                rest = tail;
            }
            slices.into_par_iter().zip(&ranges).for_each(|(slice, range)| {
                let slice_start = base(range.start);
                for (element, matrix) in connectivity.chunks(nodes).zip(matrices.chunks(buffer)) {
                    self.for_each_pair(element, range, slice_start, |pair, column| {
                        add(slice, column, &matrix[pair]);
                    });
                }
            });
        }
        Ok(())
    }

    /// Visits the free node pairs of an element whose column lies in `range`, with their block's index.
    fn for_each_pair(
        &self,
        element: &[u32],
        range: &std::ops::Range<usize>,
        slice_start: usize,
        mut visit: impl FnMut(usize, &Column),
    ) {
        let mut free = [None; 27];
        for (free, &node) in free.iter_mut().zip(element) {
            *free = self.position(node);
        }
        for i in 0..element.len() {
            let Some(pi) = free[i] else { continue };
            for (j, pj) in free[..=i].iter().enumerate() {
                let Some(pj) = *pj else { continue };
                let (row, node) = (pi.max(pj), pi.min(pj));
                if !range.contains(&node) {
                    continue;
                }
                let neighbours = self.column(node);
                // every pair of an element is in the pattern
                let Ok(place) = neighbours.binary_search(&(row as u32)) else {
                    continue;
                };
                let mut column = Column { node, place, length: neighbours.len(), transposed: pi < pj, slice_start };
                visit(block_index(i, j), &column);
                // a collapsed element has one node twice: block and mirror image meet on the diagonal
                if i != j && pi == pj {
                    column.transposed = true;
                    visit(block_index(i, j), &column);
                }
            }
        }
    }
}
