//! All files of a run at rest but the fields for ParaView, which are written as positions come; the table at their end.

use analysis::{Derivatives, facts::Facts, results::static_headline};
use ltca::StaticHistory;
use scene::Scene;

use crate::{
    Cost, ReportError, close_result, columns::write_history, contact_files::write_contact, folder::ResultDirectory,
    page::write_report, tables::closing_table, view::View,
};

/// Rows, contact lines and contact pattern; what comes back is the pattern as a part of the page, where there is one.
///
/// # Errors
/// When the system refuses.
pub fn write_static_rows(
    scene: &Scene,
    history: &StaticHistory,
    derivatives: Option<&Derivatives>,
    results: &ResultDirectory,
) -> Result<Option<String>, ReportError> {
    results.write("history.csv", write_history(scene, history, derivatives).as_bytes())?;
    write_contact(scene, history, results)
}

/// The page and the summary; `pattern` is what [`write_static_rows`] gave, `view` the gears in space.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_static_result(
    scene: &Scene,
    history: &StaticHistory,
    (facts, cost): (&Facts, &Cost),
    (pattern, view): (Option<&str>, Option<&View>),
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    let headline = static_headline(scene, history)?;
    write_report(scene, history, facts, cost, &headline, pattern, view)?.write(results)?;
    close_result(scene, (facts, cost), &headline, &history.warnings, results)?;
    Ok(closing_table(scene, facts, cost, &headline, &history.warnings))
}
