//! `summary.json`: everything about a run but its rows.

use analysis::facts::Facts;
use scene::Scene;
use serde::Serialize;

use crate::{Cost, ReportError, ResultFiles, SUMMARY_SCHEMA, folder::ResultDirectory, write_parquet};

#[derive(Serialize)]
struct Summary<'a, H> {
    program: &'static str,
    version: &'static str,
    schema: u32,
    name: &'a str,
    inputs: &'a Scene,
    #[serde(flatten)]
    facts: &'a Facts,
    cost: &'a Cost,
    headline: &'a H,
    warnings: &'a [String],
    files: &'a [String],
}

/// The summary as JSON; numbers without a value (NaN) are `null`.
///
/// `files` are the other files of the result; the summary is written last, so where it is, they are.
pub fn write_summary<H: Serialize>(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    headline: &H,
    warnings: &[String],
    files: &[String],
) -> String {
    let summary = Summary {
        program: "ale-gear",
        version: env!("CARGO_PKG_VERSION"),
        schema: SUMMARY_SCHEMA,
        name: &scene.name,
        inputs: scene,
        facts,
        cost,
        headline,
        warnings,
        files,
    };
    // Strings and numbers only, all keys are strings: there is nothing that JSON could refuse.
    let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
    text.push('\n');
    text
}

/// What is made of a result's files, last of all: `history.parquet`, where the scene asks for it, and `summary.json`,
/// so that where it is everything is there.
///
/// # Errors
/// [`ReportError`] when a file cannot be read or written.
pub fn close_result<H: Serialize>(
    scene: &Scene,
    (facts, cost): (&Facts, &Cost),
    headline: &H,
    warnings: &[String],
    results: &ResultDirectory,
) -> Result<(), ReportError> {
    if scene.output.parquet {
        write_parquet(results.folder())?;
    }
    let summary = write_summary(scene, facts, cost, headline, warnings, &results.files()?);
    ResultFiles::write(results, "summary.json", summary.as_bytes())
}
