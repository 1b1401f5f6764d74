//! Laws of the crate `analysis`.

mod accuracy;
mod basins;
mod continuation;
mod exchanged;
mod face_load;
mod gearbox;
mod gearbox_accuracy;
mod gearbox_of_pairs;
mod held_pair;
mod interest;
mod jammed;
mod kept_at_once;
mod ledgers;
mod lumped_course;
mod mapped;
mod motion_accuracy;
mod motion_in_memory;
mod moving_pairs;
mod nominal_load;
mod overhung;
mod rating;
mod remarks;
mod scale_at_rest;
mod scale_in_motion;
mod scaled;
mod solved;
