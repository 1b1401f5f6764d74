//! Laws of the crate `study`.

mod calculix;
#[path = "../calculix_pair/mod.rs"]
mod calculix_pair;
mod laws;
mod nonlinear;
mod spectrum;
