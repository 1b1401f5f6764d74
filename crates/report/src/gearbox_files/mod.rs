//! Files of a gearbox at rest: positions, shaft lines, line loads, headline numbers, page, closing table.

mod page;
mod rows;
mod space;
mod summary;
mod table;

use analysis::gearbox_at_rest::GearboxResult;
use scene::gearbox::Gearbox;

use crate::{ReportError, ResultFiles};

pub use page::gearbox_page;
pub use summary::gearbox_summary;
pub use table::gearbox_table;

/// Writes the files of rows: `positions.csv`, `shafts.csv`, `line_load.csv`.
///
/// # Errors
/// When the system refuses.
pub fn write_gearbox_rows(file: &Gearbox, result: &GearboxResult, files: &dyn ResultFiles) -> Result<(), ReportError> {
    files.write("positions.csv", rows::positions(file, result).as_bytes())?;
    files.write("shafts.csv", rows::shafts(file, result).as_bytes())?;
    files.write("line_load.csv", rows::line_loads(result).as_bytes())
}
