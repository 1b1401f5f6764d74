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

use crate::{Cost, ReportError, ResultFiles, folder::ResultDirectory};

pub use table::gearbox_table;

/// Writes all files of a gearbox, `summary.json` last: where it is, everything is.
///
/// # Errors
/// When the system refuses, or the page cannot be filled.
pub fn write_gearbox(
    file: &Gearbox,
    result: &GearboxResult,
    cost: &Cost,
    results: &ResultDirectory,
) -> Result<(), ReportError> {
    write_gearbox_rows(file, result, results)?;
    let missed: Vec<String> = result.missed().into_iter().map(|own| own.what).collect();
    let failed = (!missed.is_empty()).then(|| missed.join("; "));
    page::gearbox_page(file, result, cost, failed.as_deref())?.write(results)?;
    let files = results.files()?;
    let summary = summary::gearbox_summary(file, result, cost, &files, &missed);
    results.write("summary.json", summary.as_bytes())
}

/// Writes the files of rows: `positions.csv`, `shafts.csv`, `line_load.csv`; of a vibration `modes.csv`, `campbell.csv`,
/// `crossings.csv`, `response.csv`, `rms.csv`, `bearing_forces.csv` and `bearing_forces.uff`; of a motion `motion.csv`
/// and, where it is long enough to tell orders, `motion_orders.csv`.
///
/// # Errors
/// When the system refuses.
fn write_gearbox_rows(file: &Gearbox, result: &GearboxResult, files: &dyn ResultFiles) -> Result<(), ReportError> {
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
