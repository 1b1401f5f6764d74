//! Which nodes and elements, and which of them are bore, flank, tooth k?
//!
//! Lengths in mm. Node order inside an element is Gmsh's own for every kind.

pub mod element;
pub mod error;
pub mod model;
pub mod msh;
pub mod structured;

pub use element::{ElementKind, FaceKind};
pub use error::MeshError;
pub use model::{ElementBlock, Face, Mesh, SurfaceGroup};
pub use msh::{MshError, MshFormat};
pub use structured::{Extent, StructuredError, StructuredOptions, generate};
