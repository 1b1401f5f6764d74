//! Names, counts, Gmsh type numbers, reference nodes, edges and outward faces of every element kind.

use super::{
    ElementKind::{self, Hex8, Hex20, Hex27, Tet4, Tet10, Wedge6, Wedge15},
    FaceKind::{self, Quad4, Quad8, Quad9, Tri3, Tri6},
};

/// A face of an element: its kind and its nodes in the element's local numbers.
type LocalFace = (FaceKind, &'static [usize]);

impl ElementKind {
    /// All kinds; in each family linear kinds come before quadratic ones.
    pub const ALL: [Self; 7] = [Hex8, Hex20, Hex27, Tet4, Tet10, Wedge6, Wedge15];

    /// Number of nodes.
    pub const fn node_count(self) -> usize {
        match self {
            Hex8 => 8,
            Hex20 => 20,
            Hex27 => 27,
            Tet4 => 4,
            Tet10 => 10,
            Wedge6 => 6,
            Wedge15 => 15,
        }
    }

    /// Number of corners; the first nodes of an element are its corners.
    pub const fn corner_count(self) -> usize {
        match self {
            Hex8 | Hex20 | Hex27 => 8,
            Tet4 | Tet10 => 4,
            Wedge6 | Wedge15 => 6,
        }
    }

    /// Polynomial order: 1 or 2.
    pub const fn order(self) -> usize {
        match self {
            Hex8 | Tet4 | Wedge6 => 1,
            Hex20 | Hex27 | Tet10 | Wedge15 => 2,
        }
    }

    /// Gmsh's number of this kind, as in `.msh` files.
    pub const fn gmsh_type(self) -> i32 {
        match self {
            Hex8 => 5,
            Hex20 => 17,
            Hex27 => 12,
            Tet4 => 4,
            Tet10 => 11,
            Wedge6 => 6,
            Wedge15 => 18,
        }
    }

    /// The kind of that Gmsh number, if it is a volume element known here.
    pub(crate) fn from_gmsh_type(number: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|k| k.gmsh_type() == number)
    }

    /// Short name for messages and tables, such as `hex20`.
    pub const fn name(self) -> &'static str {
        match self {
            Hex8 => "hex8",
            Hex20 => "hex20",
            Hex27 => "hex27",
            Tet4 => "tet4",
            Tet10 => "tet10",
            Wedge6 => "wedge6",
            Wedge15 => "wedge15",
        }
    }

    /// Positions of the nodes in the reference element.
    pub const fn reference_nodes(self) -> &'static [[f64; 3]] {
        match self {
            // each lower order is the head of the higher one's list
            Hex8 => HEX_NODES.split_at(8).0,
            Hex20 => HEX_NODES.split_at(20).0,
            Hex27 => &HEX_NODES,
            Tet4 => TET_NODES.split_at(4).0,
            Tet10 => &TET_NODES,
            Wedge6 => WEDGE_NODES.split_at(6).0,
            Wedge15 => &WEDGE_NODES,
        }
    }

    /// Centre of the reference element.
    pub const fn centre(self) -> [f64; 3] {
        match self {
            Hex8 | Hex20 | Hex27 => [0.0; 3],
            Tet4 | Tet10 => [0.25; 3],
            Wedge6 | Wedge15 => [1.0 / 3.0, 1.0 / 3.0, 0.0],
        }
    }

    /// Pairs of corners that form the edges. In quadratic kinds node `corner_count() + k` lies on edge k.
    pub const fn edges(self) -> &'static [[usize; 2]] {
        match self {
            Hex8 | Hex20 | Hex27 => &HEX_EDGES,
            Tet4 | Tet10 => &TET_EDGES,
            Wedge6 | Wedge15 => &WEDGE_EDGES,
        }
    }

    /// Faces with their local node numbers, ordered so that the normal points outwards.
    pub const fn faces(self) -> &'static [(FaceKind, &'static [usize])] {
        match self {
            Hex8 => &HEX8_FACES,
            Hex20 => &HEX20_FACES,
            Hex27 => &HEX27_FACES,
            Tet4 => &TET4_FACES,
            Tet10 => &TET10_FACES,
            Wedge6 => &WEDGE6_FACES,
            Wedge15 => &WEDGE15_FACES,
        }
    }
}

impl FaceKind {
    /// All kinds; in each family linear kinds come before quadratic ones.
    pub const ALL: [Self; 5] = [Tri3, Tri6, Quad4, Quad8, Quad9];

    /// Number of nodes.
    pub const fn node_count(self) -> usize {
        match self {
            Tri3 => 3,
            Tri6 => 6,
            Quad4 => 4,
            Quad8 => 8,
            Quad9 => 9,
        }
    }

    /// Number of corners; the first nodes of a face are its corners.
    pub const fn corner_count(self) -> usize {
        match self {
            Tri3 | Tri6 => 3,
            Quad4 | Quad8 | Quad9 => 4,
        }
    }

    /// Polynomial order: 1 or 2.
    pub const fn order(self) -> usize {
        match self {
            Tri3 | Quad4 => 1,
            Tri6 | Quad8 | Quad9 => 2,
        }
    }

    /// Gmsh's number of this kind, as in `.msh` files.
    pub const fn gmsh_type(self) -> i32 {
        match self {
            Tri3 => 2,
            Tri6 => 9,
            Quad4 => 3,
            Quad8 => 16,
            Quad9 => 10,
        }
    }

    /// The kind of that Gmsh number, if it is a face known here.
    pub(crate) fn from_gmsh_type(number: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|k| k.gmsh_type() == number)
    }

    /// Short name for messages and tables, such as `quad8`.
    pub const fn name(self) -> &'static str {
        match self {
            Tri3 => "tri3",
            Tri6 => "tri6",
            Quad4 => "quad4",
            Quad8 => "quad8",
            Quad9 => "quad9",
        }
    }

    /// Positions of the nodes in the reference face.
    pub const fn reference_nodes(self) -> &'static [[f64; 2]] {
        match self {
            Tri3 => TRI_NODES.split_at(3).0,
            Tri6 => &TRI_NODES,
            Quad4 => QUAD_NODES.split_at(4).0,
            Quad8 => QUAD_NODES.split_at(8).0,
            Quad9 => &QUAD_NODES,
        }
    }

    /// Centre of the reference face.
    pub const fn centre(self) -> [f64; 2] {
        match self {
            Tri3 | Tri6 => [1.0 / 3.0; 2],
            Quad4 | Quad8 | Quad9 => [0.0; 2],
        }
    }
}

/// Hexahedron: 8 corners, 12 edges, 6 faces, centre.
const HEX_NODES: [[f64; 3]; 27] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [0.0, -1.0, -1.0],
    [-1.0, 0.0, -1.0],
    [-1.0, -1.0, 0.0],
    [1.0, 0.0, -1.0],
    [1.0, -1.0, 0.0],
    [0.0, 1.0, -1.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [0.0, -1.0, 1.0],
    [-1.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [0.0, 0.0, -1.0],
    [0.0, -1.0, 0.0],
    [-1.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, 0.0],
];

const HEX_EDGES: [[usize; 2]; 12] =
    [[0, 1], [0, 3], [0, 4], [1, 2], [1, 5], [2, 3], [2, 6], [3, 7], [4, 5], [4, 7], [5, 6], [6, 7]];

const TET_NODES: [[f64; 3]; 10] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.5, 0.0, 0.0],
    [0.5, 0.5, 0.0],
    [0.0, 0.5, 0.0],
    [0.0, 0.0, 0.5],
    [0.0, 0.5, 0.5],
    [0.5, 0.0, 0.5],
];

const TET_EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [0, 2], [0, 3], [2, 3], [1, 3]];

const WEDGE_NODES: [[f64; 3]; 15] = [
    [0.0, 0.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [0.5, 0.0, -1.0],
    [0.0, 0.5, -1.0],
    [0.0, 0.0, 0.0],
    [0.5, 0.5, -1.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.5, 0.0, 1.0],
    [0.0, 0.5, 1.0],
    [0.5, 0.5, 1.0],
];

const WEDGE_EDGES: [[usize; 2]; 9] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 4], [2, 5], [3, 4], [3, 5], [4, 5]];

const TRI_NODES: [[f64; 2]; 6] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];

const QUAD_NODES: [[f64; 2]; 9] =
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, 0.0]];

// Faces in the order of hex27's face nodes: z-, y-, x-, x+, y+, z+.
const HEX8_FACES: [LocalFace; 6] = [
    (Quad4, &[0, 3, 2, 1]),
    (Quad4, &[0, 1, 5, 4]),
    (Quad4, &[0, 4, 7, 3]),
    (Quad4, &[1, 2, 6, 5]),
    (Quad4, &[2, 3, 7, 6]),
    (Quad4, &[4, 5, 6, 7]),
];

const HEX20_FACES: [LocalFace; 6] = [
    (Quad8, &[0, 3, 2, 1, 9, 13, 11, 8]),
    (Quad8, &[0, 1, 5, 4, 8, 12, 16, 10]),
    (Quad8, &[0, 4, 7, 3, 10, 17, 15, 9]),
    (Quad8, &[1, 2, 6, 5, 11, 14, 18, 12]),
    (Quad8, &[2, 3, 7, 6, 13, 15, 19, 14]),
    (Quad8, &[4, 5, 6, 7, 16, 18, 19, 17]),
];

const HEX27_FACES: [LocalFace; 6] = [
    (Quad9, &[0, 3, 2, 1, 9, 13, 11, 8, 20]),
    (Quad9, &[0, 1, 5, 4, 8, 12, 16, 10, 21]),
    (Quad9, &[0, 4, 7, 3, 10, 17, 15, 9, 22]),
    (Quad9, &[1, 2, 6, 5, 11, 14, 18, 12, 23]),
    (Quad9, &[2, 3, 7, 6, 13, 15, 19, 14, 24]),
    (Quad9, &[4, 5, 6, 7, 16, 18, 19, 17, 25]),
];

const TET4_FACES: [LocalFace; 4] = [(Tri3, &[0, 2, 1]), (Tri3, &[0, 1, 3]), (Tri3, &[0, 3, 2]), (Tri3, &[1, 2, 3])];

const TET10_FACES: [LocalFace; 4] = [
    (Tri6, &[0, 2, 1, 6, 5, 4]),
    (Tri6, &[0, 1, 3, 4, 9, 7]),
    (Tri6, &[0, 3, 2, 7, 8, 6]),
    (Tri6, &[1, 2, 3, 5, 8, 9]),
];

const WEDGE6_FACES: [LocalFace; 5] =
    [(Tri3, &[0, 2, 1]), (Tri3, &[3, 4, 5]), (Quad4, &[0, 1, 4, 3]), (Quad4, &[0, 3, 5, 2]), (Quad4, &[1, 2, 5, 4])];

const WEDGE15_FACES: [LocalFace; 5] = [
    (Tri6, &[0, 2, 1, 7, 9, 6]),
    (Tri6, &[3, 4, 5, 12, 14, 13]),
    (Quad8, &[0, 1, 4, 3, 6, 10, 12, 8]),
    (Quad8, &[0, 3, 5, 2, 8, 13, 11, 7]),
    (Quad8, &[1, 2, 5, 4, 9, 11, 14, 10]),
];
