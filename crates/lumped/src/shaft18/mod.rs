//! Shafts with gears after Prohl and Myklestad: masses at stations, massless elastic shaft between them, helical meshes
//! that couple bending, torsion and axial motion.
//!
//! The files in the order of the model:
//!
//! 1. [`ShaftSystem`] and its parts: what the user says;
//! 2. [`bending_influence`], [`equivalent_torsional_stiffness`]: elasticity of a stepped shaft;
//! 3. [`LumpedShaft`]: matrices of one shaft in the coordinates that are kept;
//! 4. [`MeshLine`]: what a displacement of either gear does to the flanks between them;
//! 5. [`ShaftMechanism`]: equations of motion, static equilibrium, natural frequencies, [`ShaftRow`]s of a history;
//! 6. [`continuum_modes`]: the same system with beam elements, for comparison.
//!
//! With two shafts that keep the six coordinates of their gear and x, y and turn of the coupled end it has the 18
//! coordinates of its name.
//!
//! Seed: "Modeling and Nonlinear Analysis of Helical Gear Transmission Systems Using Prohl-Myklested Method". Its
//! relation between displacements and compression of the mesh has cosines of products of angles and is replaced by
//! [`MeshLine`], derived from the geometry; one exponent of its flexibility coefficients is a misprint, see
//! [`bending_influence`]; its claim of chaos without backlash cannot hold, since the equations are then linear with
//! periodic coefficients.

mod continuum;
mod coupling;
mod flexibility;
mod history;
mod lumping;
mod mechanism;
mod parameters;
mod static_load;

pub use continuum::{Continuum, continuum_modes};
pub use coupling::{MeshGeometry, MeshLine};
pub use flexibility::{Influence, bending_influence, equivalent_torsional_stiffness};
pub use history::ShaftRow;
pub use lumping::LumpedShaft;
pub use mechanism::ShaftMechanism;
pub use parameters::{Mesh, RunOut, Segment, Shaft, ShaftStation, ShaftSystem, ShaftTorque, Station, Support};
