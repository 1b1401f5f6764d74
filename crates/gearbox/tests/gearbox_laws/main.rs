//! Laws of shafts, bearings and gears that stand and swing together.

mod elastic;
mod exact;
mod forced;
mod mapped_pair;
mod motion;
mod motion_bores;
mod motion_branch;
mod motion_branch_mapped;
mod motion_contact;
mod motion_course;
mod motion_flanks;
mod motion_loads;
mod motion_modes;
mod motion_pair;
mod overhung;
mod pairs;
mod planets;
mod rest;
mod rolling;
mod rolling_gearbox;
mod ross;
mod rotors;
mod swinging;
mod trains;
mod vibration;
mod whirl;
