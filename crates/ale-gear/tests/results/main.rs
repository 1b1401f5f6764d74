//! What a run of one scene writes, at rest and in time.

mod certificates;
mod contact_pattern;
mod derivatives;
mod ledger;
mod many_rows;
mod modes;
mod motion;
mod motion_analyses;
mod over_speed;
mod results;
mod root_stress;
mod seed_000;
#[path = "../util/mod.rs"]
mod util;
mod window;
