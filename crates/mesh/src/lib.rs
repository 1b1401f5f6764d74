//! The finite-element mesh of a gear: nodes, elements, and which of them form the bore, the flanks and the teeth.
//!
//! Lengths are in mm. The node order inside an element is Gmsh's for every kind.

mod block;
mod bolts;
mod bore;
mod bore_coupling;
mod bore_fit;
mod bore_grid;
mod check;
pub mod element;
pub mod error;
mod face_area;
mod faces;
mod flank_fit;
mod foundation;
mod gear_mesh;
mod group_names;
mod info;
pub mod model;
pub mod msh;
mod numbered;
mod periodic;
mod quality;
mod root_fillets;
mod sector;
mod spring_point;
pub mod structured;
mod tips;

pub use bolts::{BoltPoint, Bolts};
pub use bore::face_weights;
pub use bore_coupling::BoreCoupling;
pub use bore_grid::BoreGrid;
pub use check::{BAD_SHAPE, Finding, FindingKind, MeshReport, SHOWN, Severity};
pub use element::{ElementKind, FaceKind, gauss_legendre};
pub use error::MeshError;
pub use faces::{FaceOwner, FaceTable};
pub use flank_fit::{DEFAULT_TOLERANCE_MODULES, FlankDeviation, FlankFit};
pub use foundation::Foundation;
pub use gear_mesh::MeshedGear;
pub use group_names::GroupNames;
pub use info::{GroupInfo, LikelyGear, MeshInfo};
pub use model::{ElementBlock, Face, Mesh, SurfaceGroup};
pub use msh::{MshError, MshFormat};
pub use numbered::Numbered;
pub(crate) use quality::min_det_j;
pub use quality::scaled_jacobian;
pub use root_fillets::RootFillets;
pub use sector::{Copies, Origin};
pub use spring_point::SpringPoint;
pub use structured::{Extent, FaceResolution, StructuredError, StructuredOptions, face_elements, generate};
