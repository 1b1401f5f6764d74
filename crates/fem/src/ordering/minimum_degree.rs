//! Order by approximate minimum degree, where METIS cannot be linked: in a browser.

use dyn_stack::{MemBuffer, MemStack};
use faer::sparse::{SymbolicSparseColMatRef, linalg::amd};

use super::{Dissection, graph::Graph};
use crate::FemError;

/// What [`FemError::Ordering`] says of an index that does not fit.
const OVERFLOW: i32 = -1;

/// Fill-reducing order of the graph's groups. All of them are one piece, whatever number of pieces is wanted: those that
/// are left are empty, and no two have a common edge.
///
/// # Errors
/// [`FemError::OutOfMemory`]; [`FemError::Ordering`] where the graph is too large for the indices of this machine.
pub(super) fn nested_dissection(graph: &Graph, _pieces: usize) -> Result<Dissection, FemError> {
    let nodes = graph.group_count();
    let starts: Vec<usize> = graph.starts.iter().map(|&start| start as usize).collect();
    let neighbours: Vec<usize> = graph.neighbours.iter().map(|&group| group as usize).collect();
    let pattern = SymbolicSparseColMatRef::new_unsorted_checked(nodes, nodes, &starts, None, &neighbours);
    let scratch = amd::order_maybe_unsorted_scratch::<usize>(nodes, neighbours.len());
    let bytes = scratch.unaligned_bytes_required();
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| FemError::OutOfMemory { bytes })?;
    let (mut order, mut inverse) = (vec![0usize; nodes], vec![0usize; nodes]);
    amd::order_maybe_unsorted(&mut order, &mut inverse, pattern, Default::default(), MemStack::new(&mut memory))
        .map_err(|_| FemError::Ordering { nodes, status: OVERFLOW })?;
    Ok(Dissection { order, piece: vec![0; nodes] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SymmetricMatrix;

    /// A path of nodes that are numbered at random fills nothing in: every node is eliminated while it has one neighbour
    /// left at most.
    #[test]
    fn a_path_fills_nothing_in() {
        let names = [4, 0, 7, 2, 9, 5, 1, 8, 3, 6];
        let mut triplets: Vec<(usize, usize, f64)> = (0..names.len()).map(|i| (i, i, 2.0)).collect();
        triplets.extend(names.windows(2).map(|pair| (pair[0].max(pair[1]), pair[0].min(pair[1]), -1.0)));
        let matrix = SymmetricMatrix::from_triplets(names.len(), &triplets).unwrap();
        let graph = Graph::new(&matrix, &[false; 10]).unwrap();
        let found = nested_dissection(&graph, 4).unwrap();
        assert_eq!(found.piece, vec![0; 10]);
        let mut seen = [false; 10];
        for group in found.order {
            let place = names.iter().position(|&name| name == graph.members(group)[0]).unwrap();
            let left = [place.checked_sub(1), Some(place + 1)].into_iter().flatten();
            let left = left.filter_map(|at| names.get(at)).filter(|&&name| !seen[name]).count();
            assert!(left <= 1, "{left} neighbours are left");
            seen[names[place]] = true;
        }
        assert_eq!(seen, [true; 10]);
    }
}
