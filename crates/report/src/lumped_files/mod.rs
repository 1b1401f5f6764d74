//! Files of a cheaper model, of sweeps over a key, of continuations and of basins: frequencies, points, charts, pages.

mod basins;
mod branch;
mod campbell;
mod report;
mod sweep;
mod sweep_report;
mod table;
mod write;

pub use basins::{ATTRACTORS_FILE, BASINS_FILE, attractors_csv, basins_csv, basins_table, write_basins};
pub use branch::{BRANCH_FILE, IN_TIME_FILE, TURNS_FILE, branch_csv, branch_table, write_branch};
pub use campbell::lumped_campbell_csv;
pub use report::{LumpedPictures, write_lumped_report};
pub use sweep::{BIFURCATION_FILE, SWEEP_FILE, SweepPage, bifurcation_csv, sweep_csv};
pub use sweep_report::{bifurcation_picture, lumped_sweep_table, write_lumped_sweep_report};
pub use table::lumped_table;
pub use write::{write_key_sweep, write_lumped};

/// One row a mesh cycle.
pub const SECTION_FILE: &str = "section.csv";
