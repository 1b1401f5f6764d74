//! Laws of the crate `report`.

mod vtu;
