//! The answer of every run of a pair: headline numbers, rows, charts, page, closing table.
//!
//! | module | what it does |
//! |---|---|
//! | `parts` | what all pages of a pair have |
//! | `rows` | rows beside the histories as tables |
//! | `at_rest` | positions at rest |
//! | `motion` | a motion of reduced gears, and steady states over speed |
//! | `lumped` | a motion of a reduced-order model |
//! | `key_sweep`, `branch`, `basins` | many motions |

mod at_rest;
mod basins;
mod branch;
mod key_sweep;
mod lumped;
mod motion;
mod parts;
mod rows;

pub use at_rest::{static_charts, write_static_result, write_static_rows};
pub use basins::write_basin_result;
pub use branch::write_continuation_result;
pub use key_sweep::write_key_sweep_result;
pub use lumped::write_lumped_result;
pub use motion::{write_motion_result, write_sweep_result};
