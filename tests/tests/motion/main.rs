//! The pair in motion: quasi-static and linear limits, jumps, tooth changes, integrators, modes, cheaper models.

mod both_free;
mod fields;
mod ladder;
mod ledgers;
mod mapped;
mod modes_in_motion;
mod motion_cells;
mod motion_jump;
mod motion_linear;
mod motion_order;
mod motion_tooth_change;
mod pair_course;
mod pair_motion;
mod scale;
