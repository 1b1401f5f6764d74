//! Laws of the integrators, without a gear.

mod motion;
mod schemes;
