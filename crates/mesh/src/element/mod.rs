//! Reference elements: node order, faces, shape functions, integration points.
//!
//! Node order and reference coordinates follow Gmsh:
//!
//! | family | reference element                                   | volume |
//! |--------|-----------------------------------------------------|--------|
//! | hex    | [-1, 1]^3                                           | 8      |
//! | tet    | x, y, z >= 0, x + y + z <= 1                        | 1/6    |
//! | wedge  | x, y >= 0, x + y <= 1 times z in [-1, 1]            | 1      |
//! | quad   | [-1, 1]^2                                           | 4      |
//! | tri    | x, y >= 0, x + y <= 1                               | 1/2    |
//!
//! Corners come first, then the midpoints of the edges in the order of `edges()`, then the centres of faces in the
//! order of `faces()`, then the centre of the element.

mod face_shape;
mod gauss;
mod quadrature;
mod shape;
mod topology;

pub use gauss::gauss_legendre;
pub use quadrature::{FaceQuadraturePoint, QuadraturePoint, QuadratureRule};

/// Kinds of volume elements; the node order is Gmsh's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ElementKind {
    /// Trilinear brick.
    Hex8,
    /// Quadratic brick of the serendipity family.
    Hex20,
    /// Triquadratic brick.
    Hex27,
    /// Linear tetrahedron.
    Tet4,
    /// Quadratic tetrahedron.
    Tet10,
    /// Linear wedge: triangle times line.
    Wedge6,
    /// Quadratic wedge of the serendipity family.
    Wedge15,
}

/// Kinds of boundary faces; the node order is Gmsh's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FaceKind {
    /// Linear triangle.
    Tri3,
    /// Quadratic triangle.
    Tri6,
    /// Bilinear quadrilateral.
    Quad4,
    /// Quadratic quadrilateral of the serendipity family.
    Quad8,
    /// Biquadratic quadrilateral.
    Quad9,
}
