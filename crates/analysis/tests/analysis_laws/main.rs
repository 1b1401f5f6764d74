//! Laws of the crate `analysis`.

mod accuracy;
mod basins;
mod continuation;
mod exchanged;
mod gearbox;
mod gearbox_of_pairs;
mod held_pair;
mod interest;
mod jammed;
mod kept_at_once;
mod lumped_course;
mod mapped;
mod motion_accuracy;
mod motion_in_memory;
mod nominal_load;
mod overhung;
mod remarks;
mod solved;
