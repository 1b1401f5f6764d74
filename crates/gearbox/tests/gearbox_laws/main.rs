//! Laws of shafts, bearings and gears that stand and swing together.

mod overhung;
mod ross;
mod rotors;
mod whirl;
