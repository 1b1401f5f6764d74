//! Reference elements: node order, faces, shape functions (Gmsh conventions).

mod quadrature;
mod shape;

pub use quadrature::{QuadraturePoint, QuadratureRule};

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
