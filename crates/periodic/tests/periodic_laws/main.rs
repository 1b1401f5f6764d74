//! Laws of periodic motions.

mod clearance;
mod free_turn;
mod linear;
mod oscillator;
