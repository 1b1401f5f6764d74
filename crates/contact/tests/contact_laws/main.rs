//! Laws of the crate `contact`.

mod complementarity;
mod dense;
mod loaded_line;
mod local;
mod search;
mod slice_search;
