//! Charts: a picture that prints and needs no script, and beside it the numbers for the script of the page.

mod campbell;
mod contour_map;
mod curve;
mod curves;
mod field_map;
mod heat_map;
mod log_panel;
mod overlay;
mod picture;
mod plot_data;
mod transverse_section;

pub use campbell::campbell_chart;
pub use contour_map::{GridValues, MapWords, coloured_dots, contour_map};
pub use curve::Curve;
pub use curves::{
    LineChart, banded_chart, dot_chart, dot_picture, figure, line_chart, line_picture, stick_chart, stills,
};
pub use field_map::{FieldMap, Side, share};
pub use heat_map::{contact_pattern_figure, contact_pattern_maps, contact_pattern_svg};
pub use log_panel::{Captions, Failure, Labelled, legend, log_panel, log_panels};
pub use overlay::{LevelLine, Mark, Overlay, Room, words};
pub(crate) use picture::write_picture;
pub use plot_data::{Plot, embedded};
pub use transverse_section::TransverseSection;
