//! Finite elements: stiffness K and mass M of a mesh, their factors, and stress.
//!
//! The steps from a mesh to its matrices and factors:
//!
//! 1. [`Material`], [`ElementOptions`], [`DofMap`]: the inputs;
//! 2. [`assemble`]: sparse stiffness (N/mm) and consistent mass (t);
//! 3. [`BoundaryLastFactor`]: one sparse Cholesky factor that gives the condensed stiffness, the compliance and the
//!    constraint modes of chosen boundary coordinates; [`PartedFactor`]: the same for a large body, with only part of
//!    the factor in memory at a time;
//! 4. [`IndefiniteFactor`]: the same for a system with constraints;
//! 5. [`nodal_stress`], [`StressOperator`], [`mass_properties`]: results from displacements and mesh.
//!
//! For shafts the crate also has [`beam`] elements, the static [`Condensation`] and the [`natural_modes`] of small
//! systems.
//!
//! Units: mm, N, MPa, t, s. Results have the same bits for any number of threads.

mod assembly;
pub mod beam;
mod column_blocks;
mod condensation;
pub mod dense;
mod dofs;
mod element_matrices;
mod error;
mod factor;
mod indefinite;
mod mass_properties;
mod material;
mod modes;
mod ordering;
mod stress;
mod symmetric;

pub use assembly::{System, assemble, assemble_mass, assemble_stiffness};
pub use condensation::Condensation;
pub use dofs::DofMap;
pub use element_matrices::{
    ElementOptions, IncompatibleModes, Integration, element_mass, element_stiffness, locks_from,
};
pub use error::{FemError, Wanted, unless_unwanted};
pub use factor::{BoundaryLastFactor, KeptFactor, PartedFactor};
pub use indefinite::IndefiniteFactor;
pub use mass_properties::{MassProperties, mass_properties};
pub use material::Material;
pub use modes::{Modes, natural_modes};
pub use ordering::Ordering;
pub use stress::{StressOperator, max_principal, min_principal, nodal_stress, nodal_stresses, von_mises};
pub use symmetric::SymmetricMatrix;
