//! Laws of the crate `fem`.

mod assembly;
mod beam;
mod common;
mod eigen;
mod elements;
mod factor;
mod parted;
mod stress;
mod surface_stress;
