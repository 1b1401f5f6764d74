//! Laws of the crate `analysis`.

mod motion_in_memory;
