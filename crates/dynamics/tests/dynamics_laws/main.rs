//! Laws of the pair in motion: quasi-static and linear limits, jumps, tooth changes, integrators, modes, maps of the contact.

mod both_free;
mod fields;
mod internal_motion;
mod modes_in_motion;
mod motion_cells;
mod motion_jump;
mod motion_linear;
mod motion_order;
mod motion_tooth_change;
mod one_energy;
mod pair_course;
mod pair_motion;
