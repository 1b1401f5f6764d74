//! Files of a gearbox: positions, shaft lines, line loads, vibration, rows in time, headline numbers, page, closing table.

mod modes;
mod motion;
mod motion_orders;
mod motion_page;
mod page;
mod response;
mod rows;
mod space;
mod summary;
mod swing_words;
mod table;
mod vibration_page;

use analysis::gearbox_at_rest::GearboxResult;
use scene::gearbox::Gearbox;

use crate::{ReportError, ResultFiles};

pub use page::gearbox_page;
pub use summary::gearbox_summary;
pub use table::gearbox_table;

/// Writes the files of rows: `positions.csv`, `shafts.csv`, `line_load.csv`; of a vibration `modes.csv`, `campbell.csv`,
/// `crossings.csv`, `response.csv`, `rms.csv`, `bearing_forces.csv` and `bearing_forces.uff`; of a motion `motion.csv`
/// and, where it is long enough to tell orders, `motion_orders.csv`.
///
/// # Errors
/// When the system refuses.
pub fn write_gearbox_rows(file: &Gearbox, result: &GearboxResult, files: &dyn ResultFiles) -> Result<(), ReportError> {
    files.write("positions.csv", rows::positions(file, result).as_bytes())?;
    files.write("shafts.csv", rows::shafts(file, result).as_bytes())?;
    files.write("line_load.csv", rows::line_loads(result).as_bytes())?;
    if let Some(swings) = &result.vibration {
        files.write("modes.csv", modes::modes(file, swings).as_bytes())?;
        files.write("campbell.csv", modes::campbell(swings).as_bytes())?;
        files.write("crossings.csv", modes::crossings(swings).as_bytes())?;
        files.write("response.csv", response::response(file, swings).as_bytes())?;
        files.write("rms.csv", response::rms(file, swings).as_bytes())?;
        files.write("bearing_forces.csv", response::bearing_forces(file, swings).as_bytes())?;
        files.write("bearing_forces.uff", response::universal(file, swings).as_bytes())?;
    }
    if let Some(own) = &result.motion {
        files.write("motion.csv", motion::motion(file, own).as_bytes())?;
        if !own.orders.is_empty() {
            files.write("motion_orders.csv", motion_orders::motion_orders(file, &own.orders).as_bytes())?;
        }
    }
    Ok(())
}
