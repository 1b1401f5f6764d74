//! What is made of a result's files, last of all: `history.parquet`, where the scene asks for it, and `summary.json`.

use report::write_parquet;
use serde::Serialize;

use super::{ResultDirectory, write_summary};
use crate::{
    error::CommandError,
    facts::{Cost, Facts},
    scene::Scene,
};

/// Writes `history.parquet` beside `history.csv` of a result, where the scene asks for it.
///
/// # Errors
/// Exit status 1 when a file cannot be read or written.
pub(crate) fn write_columnar(scene: &Scene, results: &ResultDirectory) -> Result<(), CommandError> {
    if scene.output.parquet {
        write_parquet(results.folder())?;
    }
    Ok(())
}

/// Closes a result; the summary comes last, so that where it is everything is there.
///
/// # Errors
/// Exit status 1 when a file cannot be read or written.
pub(crate) fn close<H: Serialize>(
    scene: &Scene,
    (facts, cost): (&Facts, &Cost),
    headline: &H,
    warnings: &[String],
    results: &ResultDirectory,
) -> Result<(), CommandError> {
    write_columnar(scene, results)?;
    let summary = write_summary(scene, facts, cost, headline, warnings, &results.files()?);
    Ok(results.write("summary.json", summary.as_bytes())?)
}
