//! Files of a cheaper model beside its rows: frequencies over speed, points of a sweep.

mod campbell;
mod sweep;

pub use campbell::lumped_campbell_csv;
pub use sweep::{BIFURCATION_FILE, SWEEP_FILE, SweepPage, bifurcation_csv, sweep_csv};

/// One row a mesh cycle.
pub const SECTION_FILE: &str = "section.csv";
