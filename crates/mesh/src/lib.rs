//! Which nodes and elements, and which of them are bore, flank, tooth k?
//!
//! Lengths in mm. Node order inside an element is Gmsh's own for every kind.

pub mod element;
pub mod error;
mod faces;
mod gear_mesh;
mod group_names;
pub mod model;
pub mod msh;

pub use element::{ElementKind, FaceKind};
pub use error::MeshError;
pub use faces::{FaceOwner, FaceTable};
pub use gear_mesh::GearMesh;
pub use group_names::GroupNames;
pub use model::{ElementBlock, Face, Mesh, SurfaceGroup};
pub use msh::{MshError, MshFormat};
