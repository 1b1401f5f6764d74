//! Contact of points of the flank mesh with the smooth surface of the other flank.

mod closest_point;
mod least_gap;

pub use closest_point::{ContactRow, LinePoints, Scene, Support, closest_points, contact_row, line_points};
pub(crate) use closest_point::{levers, row_at, row_between, support_at};
pub use least_gap::least_gap;
