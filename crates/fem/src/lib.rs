//! What are K and M?
//!
//! From a mesh to its matrices and their factors:
//!
//! 1. [`Material`], [`ElementOptions`], [`DofMap`]: what is meant;
//! 2. [`assemble`]: sparse stiffness (N/mm) and consistent mass (t);
//! 3. [`BoundaryLastFactor`]: one sparse Cholesky factor that holds the condensed stiffness, the compliance
//!    and the constraint modes of chosen boundary coordinates;
//!    [`PartedFactor`]: the same of a large body, of which a part at a time is held;
//! 4. [`IndefiniteFactor`]: the same for a system with constraints;
//! 5. [`nodal_stress`], [`StressOperator`], [`mass_properties`]: what follows from displacements and mesh.
//!
//! Beside it, for shafts: [`beam`] elements, the static [`Condensation`] and the [`natural_modes`] of small systems.
//!
//! Units: mm, N, MPa, t, s. Results are the same to the last bit for any number of threads.

mod assembly;
pub mod beam;
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
