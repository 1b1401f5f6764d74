//! The command line as a user meets it: words, messages, folders, cache, runs that are taken up again.

mod cache;
mod command_line;
mod faults;
mod folders;
mod gearbox;
mod gearbox_loads;
mod gearbox_over_speed;
mod gearbox_pitch_errors;
mod gearbox_planets;
mod gearbox_resume;
mod messages;
mod mistakes;
mod resume;
mod rexs;
mod rolling_bearings;
#[path = "../util/mod.rs"]
mod util;
mod writers;
