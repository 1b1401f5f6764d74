//! How do shafts, bearings and gears stand and swing together?
//!
//! The files in the order of the model:
//!
//! 1. [`Structure`] and its parts: what the user says;
//! 2. [`Supports`]: bearings in series with the housing;
//! 3. [`Assembly`]: matrices of all nodes;
//! 4. [`Rotors`], [`WhirlModes`], [`ModalEnergy`]: natural frequencies and whirl modes over speed.
//!
//! Axes of shafts are along +z; units mm, N, MPa, t, s, rad; common axes. Results are the same bits for any number of
//! threads.

mod assembly;
mod campbell;
mod error;
mod modal_energy;
mod structure;
mod supports;
mod whirl;

pub use assembly::Assembly;
pub use error::GearboxError;
pub use modal_energy::{Component, EnergyShare, ModalEnergy};
pub use structure::{Bearing, Disc, MeshSpring, Shaft, Structure};
pub use supports::Supports;
pub use whirl::{Rotors, WhirlMode, WhirlModes};
