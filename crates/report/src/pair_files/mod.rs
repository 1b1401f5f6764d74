//! The answer of every run of a pair: headline numbers, rows, charts, page, closing table.
//!
//! | module | what it does |
//! |---|---|
//! | `common` | what all pages of a pair have |
//! | `rows`, `key_rows` | rows beside the histories as tables |
//! | `at_rest` | positions at rest |
//! | `rating` | whether the pair will hold |
//! | `motion` | a motion of reduced gears, and steady states over speed |
//! | `in_time` | any of those that follow |
//! | `lumped` | a motion of a reduced-order model |
//! | `key_sweep`, `branch`, `basins` | many motions |

mod at_rest;
mod basins;
mod branch;
mod common;
mod in_time;
pub(crate) mod key_rows;
mod key_sweep;
mod lumped;
mod motion;
pub(crate) mod rating;
pub(crate) mod rows;

pub use at_rest::{static_charts, write_static_result, write_static_rows};
pub use in_time::write_in_time;
pub use key_sweep::write_key_sweep_result;
