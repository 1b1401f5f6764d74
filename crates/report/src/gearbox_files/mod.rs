//! Files of a gearbox: positions, shaft lines, line loads, rows in time, headline numbers, closing table.

mod motion;
mod rows;
mod summary;
mod table;

use analysis::gearbox_at_rest::GearboxResult;
use scene::gearbox::Gearbox;

use crate::{ReportError, ResultFiles};

pub use summary::gearbox_summary;
pub use table::gearbox_table;

/// Writes the files of rows: `positions.csv`, `shafts.csv`, `line_load.csv`, and `motion.csv` of one in motion.
///
/// # Errors
/// When the system refuses.
pub fn write_gearbox_rows(file: &Gearbox, result: &GearboxResult, files: &dyn ResultFiles) -> Result<(), ReportError> {
    files.write("positions.csv", rows::positions(file, result).as_bytes())?;
    files.write("shafts.csv", rows::shafts(file, result).as_bytes())?;
    files.write("line_load.csv", rows::line_loads(result).as_bytes())?;
    match &result.motion {
        Some(own) => files.write("motion.csv", motion::motion(file, own).as_bytes()),
        None => Ok(()),
    }
}
