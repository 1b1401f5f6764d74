//! Reference elements: node order, faces, shape functions (Gmsh conventions).

/// Kinds of volume elements; node order is Gmsh's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(missing_docs)]
pub enum ElementKind {
    Hex8,
    Hex20,
    Hex27,
    Tet4,
    Tet10,
    Wedge6,
    Wedge15,
}

/// Kinds of boundary faces; node order is Gmsh's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(missing_docs)]
pub enum FaceKind {
    Tri3,
    Tri6,
    Quad4,
    Quad8,
    Quad9,
}

#[allow(missing_docs)]
impl ElementKind {
    pub fn node_count(self) -> usize {
        match self {
            Self::Hex8 => 8,
            Self::Hex20 => 20,
            Self::Hex27 => 27,
            Self::Tet4 => 4,
            Self::Tet10 => 10,
            Self::Wedge6 => 6,
            Self::Wedge15 => 15,
        }
    }
    pub fn gmsh_type(self) -> i32 {
        match self {
            Self::Hex8 => 5,
            Self::Hex20 => 17,
            Self::Hex27 => 12,
            Self::Tet4 => 4,
            Self::Tet10 => 11,
            Self::Wedge6 => 6,
            Self::Wedge15 => 18,
        }
    }
    pub fn from_gmsh_type(code: i32) -> Option<Self> {
        [
            Self::Hex8,
            Self::Hex20,
            Self::Hex27,
            Self::Tet4,
            Self::Tet10,
            Self::Wedge6,
            Self::Wedge15,
        ]
        .into_iter()
        .find(|k| k.gmsh_type() == code)
    }
}

#[allow(missing_docs)]
impl FaceKind {
    pub fn node_count(self) -> usize {
        match self {
            Self::Tri3 => 3,
            Self::Tri6 => 6,
            Self::Quad4 => 4,
            Self::Quad8 => 8,
            Self::Quad9 => 9,
        }
    }
    pub fn gmsh_type(self) -> i32 {
        match self {
            Self::Tri3 => 2,
            Self::Tri6 => 9,
            Self::Quad4 => 3,
            Self::Quad8 => 16,
            Self::Quad9 => 10,
        }
    }
    pub fn from_gmsh_type(code: i32) -> Option<Self> {
        [
            Self::Tri3,
            Self::Tri6,
            Self::Quad4,
            Self::Quad8,
            Self::Quad9,
        ]
        .into_iter()
        .find(|k| k.gmsh_type() == code)
    }
}
