//! Laws of the lumped models, and the cases that they are held against.

mod common;
mod dimensionless;
mod gearbox;
mod impact;
mod impact_random;
mod impact_slices;
mod iso;
mod iso_pairs;
mod iso_root;
mod ladder;
mod lumped12;
mod lumped8;
mod mill;
mod on_a_map;
mod plane_of_action;
mod recording;
mod shaft18;
mod shaft18_backlash;
