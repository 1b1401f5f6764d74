//! Laws of the crate `geometry`.

mod iso21771;
mod modification;
mod nonsense;
mod sheet;
