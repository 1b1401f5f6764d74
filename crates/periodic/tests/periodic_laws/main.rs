//! Laws of periodic motions.

mod clearance;
mod linear;
mod oscillator;
