//! A picture as a file of its own.

use crate::ReportError;
use store::ResultFiles;

/// A drawn picture as `STEM.svg`; for pages it comes back. Pixels are made of it where it is looked at (`charts.js`).
///
/// # Errors
/// When the system refuses, or the picture was not drawn.
pub(crate) fn write_picture(
    stem: &'static str,
    drawn: Result<String, String>,
    results: &dyn ResultFiles,
) -> Result<String, ReportError> {
    let svg = drawn.map_err(|cause| ReportError::Page { file: stem, cause })?;
    results.write(&format!("{stem}.svg"), svg.as_bytes())?;
    Ok(svg)
}
