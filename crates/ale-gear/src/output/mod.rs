//! Files and the closing table: what a user gets.

mod charts;
mod contact_files;
mod contact_lines;
mod directory;
mod headline;
mod heat_map;
mod history;
mod pairs;
mod pattern_csv;
mod pattern_vtu;
mod pvd;
mod report;
mod root_stress;
mod summary;
mod table;
mod vtu;

pub use contact_files::write_contact;
pub use contact_lines::write_contact_lines;
pub use directory::ResultDirectory;
pub use headline::{Headline, headline};
pub use heat_map::contact_pattern_svg;
pub use history::write_history;
pub(crate) use pairs::in_cycle as pair_in_cycle;
pub use pattern_csv::write_contact_pattern;
pub use pattern_vtu::write_pattern_vtu;
pub use pvd::{PvdEntry, write_pvd};
pub use report::write_report;
pub use root_stress::{GearRootStress, Place, RootStressHeadline};
pub use summary::write_summary;
pub use table::closing_table;
pub use vtu::{Encoding, Field, write_surface, write_vtu};
