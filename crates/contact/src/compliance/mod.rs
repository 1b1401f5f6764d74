//! Deformation of both gears by contact rows: from condensed matrices, from tables of them, with all degrees of
//! freedom, or with additional normal modes.

mod bulk_grid;
mod bulk_table;
mod condensed;
mod full;
mod modal;

pub(crate) use bulk_table::Keeper;
pub(crate) use bulk_table::{BulkBody, PointRate, RateWork, Reading, TablePoint, parts};
pub use bulk_table::{BulkTable, TableWork};
pub use condensed::{Condensed, opening};
pub(crate) use condensed::{boundary_forces, load_columns};
pub(crate) use full::FullContact;
pub(crate) use modal::ModalRows;
pub use modal::{ModalFlanks, ModalForces};
