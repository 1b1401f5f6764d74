//! Files and the closing table: what a user gets.

mod charts;
mod directory;
mod headline;
mod history;
mod pairs;
mod pvd;
mod report;
mod root_stress;
mod summary;
mod table;
mod vtu;

pub use directory::ResultDirectory;
pub use headline::{Headline, headline};
pub use history::write_history;
pub use pvd::{PvdEntry, write_pvd};
pub use report::write_report;
pub use root_stress::{GearRootStress, Place, RootStressHeadline};
pub use summary::write_summary;
pub use table::closing_table;
pub use vtu::{Encoding, Field, write_vtu};
