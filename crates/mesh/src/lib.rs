//! Which nodes and elements, and which of them are bore, flank, tooth k?
//!
//! Lengths in mm. Node order inside an element is Gmsh's own for every kind.

pub mod element;
pub mod model;

pub use element::{ElementKind, FaceKind};
pub use model::{ElementBlock, Face, Mesh, SurfaceGroup};
