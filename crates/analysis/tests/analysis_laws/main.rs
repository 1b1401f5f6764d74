//! Laws of the crate `analysis`.

mod accuracy;
mod basins;
mod continuation;
mod mapped;
mod motion_accuracy;
mod motion_in_memory;
