//! Laws of periodic motions.

mod clearance;
mod condensed;
mod free_turn;
mod linear;
mod oscillator;
