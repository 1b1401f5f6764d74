//! Laws of the crate `export`.

mod vtu;
