//! Laws of the crate `report`.

mod columns;
