//! The contact line: its ends and its pressure.

pub mod hertz;
mod line_length;
mod loaded_line;
mod pair;
mod pressure;

pub use line_length::{contact_intervals, covered};
pub use loaded_line::{LineStation, loaded_intervals};
pub use pair::{NeighbourPairs, line_pressure, line_station, nodal_contact_line, rigid_gap, slice_line};
pub use pressure::nodal_pressures;
