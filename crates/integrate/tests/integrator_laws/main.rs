//! Laws of the integrators, without a gear.

mod course;
mod motion;
mod schemes;
