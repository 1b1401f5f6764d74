//! Contact lines and contact pattern.

mod flank_orders;
mod lines;
mod pattern_csv;
mod write;

pub use flank_orders::{PINION_WAVE, WHEEL_WAVE, flank_orders};
pub use lines::contact_lines;
pub(crate) use pattern_csv::of_places;
pub use pattern_csv::pattern_table;
pub use write::{pattern_figure, write_patterns};
