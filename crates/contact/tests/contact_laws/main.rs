//! Laws of the crate `contact`.

mod complementarity;
mod dense;
mod half_section;
mod hertz;
mod loaded_line;
mod local;
mod local_approach;
mod plane;
mod plane_gear;
mod search;
mod slice_search;
