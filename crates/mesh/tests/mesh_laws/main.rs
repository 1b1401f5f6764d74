//! Laws of the crate `mesh`.

mod common;
mod conformity;
mod damaged;
mod gmsh_files;
mod gmsh_meshes;
mod measure;
mod parts;
mod round_trip;
mod sector;
mod structured;
