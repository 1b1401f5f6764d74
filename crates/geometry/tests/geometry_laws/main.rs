//! Laws of the crate `geometry`.

mod faces;
mod internal;
mod iso21771;
mod modification;
mod nonsense;
mod sheet;
