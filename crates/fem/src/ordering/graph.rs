//! The graph for the dissection: groups of degrees of freedom and their couplings.

use crate::{FemError, SymmetricMatrix};

/// Undirected graph without loops, in the 32-bit compressed form METIS reads.
pub(super) struct Graph {
    /// Start of each group's neighbours; one entry more than there are groups.
    pub starts: Vec<i32>,
    pub neighbours: Vec<i32>,
    /// Number of degrees of freedom of each group.
    pub weights: Vec<i32>,
    members: Vec<usize>,
    member_starts: Vec<usize>,
}

const NO_GROUP: u32 = u32::MAX;

impl Graph {
    /// Graph of the degrees of freedom that are not `left_out`.
    pub(super) fn new(matrix: &SymmetricMatrix, left_out: &[bool]) -> Result<Self, FemError> {
        let (column_starts, rows, _) = matrix.arrays();
        let n = matrix.n();
        let joins_previous = same_neighbours(matrix, left_out);
        // consecutive degrees of freedom with the same neighbours are one group
        let mut group_of = vec![NO_GROUP; n];
        let (mut members, mut member_starts) = (Vec::new(), Vec::new());
        for dof in (0..n).filter(|&d| !left_out[d]) {
            if !joins_previous[dof] {
                member_starts.push(members.len());
            }
            group_of[dof] = member_starts.len() as u32 - 1;
            members.push(dof);
        }
        let groups = member_starts.len();
        member_starts.push(members.len());

        // the first member speaks for its group
        let mut edges: Vec<(u32, u32)> = Vec::new();
        for group in 0..groups {
            let dof = members[member_starts[group]];
            let mut previous = group as u32;
            for &row in &rows[column_starts[dof]..column_starts[dof + 1]] {
                let other = group_of[row];
                if other != NO_GROUP && other != previous && other != group as u32 {
                    edges.push((group as u32, other));
                    previous = other;
                }
            }
        }
        let entries = 2 * edges.len();
        if i32::try_from(entries).is_err() || i32::try_from(n).is_err() {
            return Err(FemError::TooLarge { entries: entries.max(n) });
        }
        let mut starts = vec![0i32; groups + 1];
        for &(a, b) in &edges {
            starts[a as usize + 1] += 1;
            starts[b as usize + 1] += 1;
        }
        for k in 0..groups {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        let mut neighbours = vec![0i32; entries];
        for &(a, b) in &edges {
            for (from, to) in [(a, b), (b, a)] {
                neighbours[next[from as usize] as usize] = to as i32;
                next[from as usize] += 1;
            }
        }
        let weights = member_starts.windows(2).map(|w| (w[1] - w[0]) as i32).collect();
        Ok(Self { starts, neighbours, weights, members, member_starts })
    }

    pub(super) fn group_count(&self) -> usize {
        self.weights.len()
    }

    /// Degrees of freedom of a group, ascending.
    pub(super) fn members(&self, group: usize) -> &[usize] {
        &self.members[self.member_starts[group]..self.member_starts[group + 1]]
    }

    fn neighbours(&self, group: usize) -> &[i32] {
        &self.neighbours[self.starts[group] as usize..self.starts[group + 1] as usize]
    }

    /// Order of the same elimination that has children of the elimination tree straight before their parents.
    ///
    /// `order[new] = group`. Source: Liu, SIAM J. Matrix Anal. Appl. 11, 1990.
    pub(super) fn postorder(&self, order: &[usize]) -> Vec<usize> {
        const NONE: usize = usize::MAX;
        let n = order.len();
        let mut place = vec![0; n];
        for (new, &group) in order.iter().enumerate() {
            place[group] = new;
        }
        let (mut parent, mut ancestor) = (vec![NONE; n], vec![NONE; n]);
        for (new, &group) in order.iter().enumerate() {
            for &other in self.neighbours(group) {
                let mut k = place[other as usize];
                while k < new {
                    let up = std::mem::replace(&mut ancestor[k], new);
                    if up == NONE {
                        parent[k] = new;
                        break;
                    }
                    k = up;
                }
            }
        }
        let (mut first_child, mut next_sibling) = (vec![NONE; n], vec![NONE; n]);
        for k in (0..n).filter(|&k| parent[k] != NONE).rev() {
            next_sibling[k] = std::mem::replace(&mut first_child[parent[k]], k);
        }
        let (mut result, mut stack) = (Vec::with_capacity(n), Vec::new());
        for root in (0..n).filter(|&k| parent[k] == NONE) {
            stack.push(root);
            while let Some(&top) = stack.last() {
                let child = first_child[top];
                if child == NONE {
                    result.push(order[top]);
                    stack.pop();
                } else {
                    first_child[top] = next_sibling[child];
                    stack.push(child);
                }
            }
        }
        result
    }
}

/// Whether a degree of freedom has the same neighbours as the one before it (itself and that one included).
fn same_neighbours(matrix: &SymmetricMatrix, left_out: &[bool]) -> Vec<bool> {
    let (starts, rows, _) = matrix.arrays();
    let n = matrix.n();
    let column = |j: usize| &rows[starts[j]..starts[j + 1]];
    // in how many earlier columns a row stands, and in how many of these the row before it stands too
    let (mut alone, mut together) = (vec![0u32; n], vec![0u32; n]);
    for j in (0..n).filter(|&j| !left_out[j]) {
        let mut previous = usize::MAX;
        for &row in column(j).iter().filter(|&&row| row > j) {
            alone[row] += 1;
            if previous != usize::MAX && previous + 1 == row {
                together[row] += 1;
            }
            previous = row;
        }
    }
    (0..n)
        .map(|j| {
            if j == 0 || left_out[j] || left_out[j - 1] {
                return false;
            }
            // rows at and below j must agree, and so must the columns left of j-1; column j-1 has row j
            let above = column(j - 1).iter().filter(|&&row| row >= j && !left_out[row]);
            let own = column(j).iter().filter(|&&row| row >= j && !left_out[row]);
            let coupled = column(j - 1).binary_search(&j).is_ok();
            coupled && alone[j] == alone[j - 1] + 1 && together[j] == alone[j - 1] && above.eq(own)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two nodes of three degrees of freedom, coupled, make one group; a third that couples to one axis only stays
    /// apart.
    #[test]
    fn equal_neighbours_make_one_group() {
        let mut triplets = Vec::new();
        for i in 0..9 {
            for j in 0..=i {
                // nodes 0-1 and 1-2 are coupled, 0-2 are not
                if i / 3 - j / 3 < 2 {
                    triplets.push((i, j, 1.0));
                }
            }
        }
        let matrix = SymmetricMatrix::from_triplets(9, &triplets).unwrap();
        let graph = Graph::new(&matrix, &[false; 9]).unwrap();
        assert_eq!(graph.weights, [3, 3, 3]);
        assert_eq!(graph.starts, [0, 1, 3, 4]);
        // without dof 4, node 1 keeps two; they no longer stand side by side
        let mut left_out = [false; 9];
        left_out[3] = true;
        let graph = Graph::new(&matrix, &left_out).unwrap();
        assert_eq!(graph.weights, [3, 2, 3]);
        assert_eq!(graph.members(1), [4, 5]);
    }

    #[test]
    fn postorder_is_a_permutation_with_children_before_parents() {
        // a path 0-1-2-3-4-5-6 in dissection order: 0 2 | 1, 4 6 | 5, then 3
        let triplets: Vec<_> = (0..7).flat_map(|i| [(i, i, 2.0), (i, i.max(1) - 1, -1.0)]).collect();
        let matrix = SymmetricMatrix::from_triplets(7, &triplets).unwrap();
        let graph = Graph::new(&matrix, &[false; 7]).unwrap();
        assert_eq!(graph.postorder(&[0, 4, 2, 6, 5, 1, 3]), [4, 6, 5, 0, 2, 1, 3]);
    }
}
