//! The answer of every run of a pair: headline numbers, rows, charts, page, closing table.
//!
//! | module | what it does |
//! |---|---|
//! | `parts` | what all pages of a pair have |
//! | `rows`, `key_rows` | rows beside the histories as tables |
//! | [`tables_without_rows`] | their columns, for `docs/outputs.md` |
//! | `at_rest` | positions at rest |
//! | `motion` | a motion of reduced gears, and steady states over speed |
//! | `in_time` | any of those that follow |
//! | `lumped` | a motion of a reduced-order model |
//! | `key_sweep`, `branch`, `basins` | many motions |

mod at_rest;
mod basins;
mod branch;
mod documented;
mod in_time;
mod key_rows;
mod key_sweep;
mod lumped;
mod motion;
mod parts;
mod rows;

pub use at_rest::{static_charts, write_static_result, write_static_rows};
pub use documented::tables_without_rows;
pub use in_time::write_in_time;
pub use key_sweep::write_key_sweep_result;
