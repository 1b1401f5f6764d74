//! Element names, node order and face numbers of CalculiX, which are those of Abaqus.

use mesh::{ElementBlock, ElementKind, FaceTable, Mesh};

use super::CalculixError;

/// CalculiX's name of an element kind. It is the variant nearest to this program's default: incompatible modes for
/// linear bricks, full integration for quadratic ones.
///
/// # Errors
/// [`CalculixError::NoSuchElement`] for hex27.
pub fn element_type(kind: ElementKind) -> Result<&'static str, CalculixError> {
    match kind {
        ElementKind::Hex8 => Ok("C3D8I"),
        ElementKind::Hex20 => Ok("C3D20"),
        ElementKind::Tet4 => Ok("C3D4"),
        ElementKind::Tet10 => Ok("C3D10"),
        ElementKind::Wedge6 => Ok("C3D6"),
        ElementKind::Wedge15 => Ok("C3D15"),
        ElementKind::Hex27 => Err(CalculixError::NoSuchElement { kind: kind.name() }),
    }
}

/// Local numbers (Gmsh's) in CalculiX's order: corners, then edges round the bottom, round the top, upright.
pub(super) fn node_order(kind: ElementKind) -> &'static [usize] {
    match kind {
        ElementKind::Hex20 => &[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15],
        ElementKind::Tet10 => &[0, 1, 2, 3, 4, 5, 6, 7, 9, 8],
        ElementKind::Wedge15 => &[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11],
        // Corners come in the same order in both.
        _ => [0, 1, 2, 3, 4, 5, 6, 7].split_at(kind.corner_count()).0,
    }
}

/// Numbers (1 ..) that CalculiX gives to the faces of [`ElementKind::faces`].
pub(super) fn face_numbers(kind: ElementKind) -> &'static [u32] {
    match kind {
        ElementKind::Hex8 | ElementKind::Hex20 | ElementKind::Hex27 => &[1, 3, 6, 4, 5, 2],
        ElementKind::Tet4 | ElementKind::Tet10 => &[1, 2, 4, 3],
        ElementKind::Wedge6 | ElementKind::Wedge15 => &[1, 2, 3, 5, 4],
    }
}

/// Elements and their faces under one running number.
pub(super) struct Numbering {
    /// Number of the first element of each block, from 0.
    starts: Vec<usize>,
    table: FaceTable,
}

impl Numbering {
    pub(super) fn new(mesh: &Mesh) -> Self {
        let counts = mesh.blocks.iter().map(ElementBlock::len);
        let starts = counts
            .scan(0, |next, n| {
                *next += n;
                Some(*next - n)
            })
            .collect();
        Self { starts, table: FaceTable::new(mesh) }
    }

    /// Running number (from 0) of an element of a block.
    pub(super) fn element(&self, block: usize, element: usize) -> usize {
        self.starts[block] + element
    }

    /// Running number (from 0) of the element behind a boundary face, and CalculiX's number of the face.
    pub(super) fn face(&self, mesh: &Mesh, face: &mesh::Face) -> Option<(usize, u32)> {
        let owner = self.table.owners(face.corner_key()).next()?;
        let block = usize::from(owner.block);
        let number = *face_numbers(mesh.blocks[block].kind).get(usize::from(owner.local))?;
        Some((self.element(block, owner.element as usize), number))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abaqus's faces by corners, from 1: S1 S2 ... of brick, tetrahedron and wedge.
    fn corners(kind: ElementKind) -> &'static [&'static [usize]] {
        match kind.corner_count() {
            8 => &[&[1, 2, 3, 4], &[5, 8, 7, 6], &[1, 5, 6, 2], &[2, 6, 7, 3], &[3, 7, 8, 4], &[4, 8, 5, 1]],
            4 => &[&[1, 2, 3], &[1, 4, 2], &[2, 4, 3], &[3, 4, 1]],
            _ => &[&[1, 2, 3], &[4, 5, 6], &[1, 2, 5, 4], &[2, 3, 6, 5], &[3, 1, 4, 6]],
        }
    }

    #[test]
    fn faces_have_the_corners_of_their_numbers() {
        for kind in ElementKind::ALL {
            for ((face, local), &number) in kind.faces().iter().zip(face_numbers(kind)) {
                let sorted = |mut v: Vec<usize>| {
                    v.sort_unstable();
                    v
                };
                let ours = sorted(local[..face.corner_count()].iter().map(|n| n + 1).collect());
                let theirs = sorted(corners(kind)[number as usize - 1].to_vec());
                assert_eq!(ours, theirs, "{} S{number}", kind.name());
            }
        }
    }

    /// A mid-side node in CalculiX's order lies between the corners that its place says.
    #[test]
    fn mid_side_nodes_lie_between_their_corners() {
        let brick = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
        let tetrahedron = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
        let wedge = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];
        let kinds: [(ElementKind, &[[usize; 2]]); 3] =
            [(ElementKind::Hex20, &brick), (ElementKind::Tet10, &tetrahedron), (ElementKind::Wedge15, &wedge)];
        for (kind, edges) in kinds {
            let at = kind.reference_nodes();
            for (k, [a, b]) in edges.iter().enumerate() {
                let middle = at[node_order(kind)[kind.corner_count() + k]];
                for axis in 0..3 {
                    let mean = 0.5 * (at[*a][axis] + at[*b][axis]);
                    assert_eq!(middle[axis], mean, "{} edge {k}", kind.name());
                }
            }
        }
    }
}
