//! The answer about the envelope, and its tables in a document.

use std::path::Path;

use answer::{Answer, Check, Checks, Cost, Table};
use described::Key;
use serde::Serialize;
use serde_json::json;

use super::{EnvelopeResult, maps_markdown, modes_markdown, page, rows};
use report::{MarkedPlace, ReportError, Written, write_result};
use store::folder::ResultDirectory;

/// Names of the places of both tables in a document.
const MODES: &str = "failure modes";
const MAPS: &str = "maps";

described::described! {
    /// Headline of an envelope.
    #[derive(Serialize)]
    struct EnvelopeHeadline {
        /// failure modes that were examined
        failure_modes: usize,
        /// failure modes that do not come out as they have to
        failure_modes_missed: usize,
        /// maps that were drawn
        maps: usize,
        /// cells that are wrong without a remark
        cells_wrong: usize,
    }
}

/// Tables without rows, and objects of the summary with their keys, for `docs/outputs.md`.
pub fn documented() -> (Vec<Table>, Vec<(&'static str, Vec<Key>)>) {
    let none = EnvelopeResult { modes: Vec::new(), maps: Vec::new() };
    (vec![rows::modes(&none), rows::maps(&none)], vec![("headline, an envelope", EnvelopeHeadline::KEYS.to_vec())])
}

/// The answer: `envelope` and, where maps were drawn, `maps`.
pub fn envelope_answer(of: &EnvelopeResult, cost: Cost) -> Answer {
    let missed = of.modes.iter().filter(|(_, found)| !found.holds()).count();
    let wrong: usize = of.maps.iter().map(|(_, drawn, _)| drawn.wrong()).sum();
    let mut tables = Vec::new();
    if !of.modes.is_empty() {
        tables.push(rows::modes(of));
    }
    if !of.maps.is_empty() {
        tables.push(rows::maps(of));
    }
    let hint = "the table says why";
    Answer {
        kind: "envelope",
        name: "Envelope: where such solvers fail".to_owned(),
        inputs: json!({
            "modes": of.modes.iter().map(|(mode, _)| mode.label()).collect::<Vec<_>>(),
            "maps": of.maps.iter().map(|(map, ..)| map.key).collect::<Vec<_>>(),
        }),
        tables,
        headline: json!(EnvelopeHeadline {
            failure_modes: of.modes.len(),
            failure_modes_missed: missed,
            maps: of.maps.len(),
            cells_wrong: wrong,
        }),
        checks: Checks::new([
            Check::new("failure_modes_missed", missed as f64, 0.0, hint),
            Check::new("cells_wrong_without_a_word", wrong as f64, 0.0, hint),
        ]),
        cost,
        ..Answer::default()
    }
}

/// Writes the answer; what comes back is the closing table.
///
/// # Errors
/// When the system refuses, or the page cannot be filled.
pub fn write_envelope(
    of: &EnvelopeResult,
    command: &str,
    cost: Cost,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let answer = envelope_answer(of, cost);
    let page = page::page(of, &answer, command);
    write_result(answer, &page, false, results)
}

/// Whether a file has the places of the tables that [`replace_envelope_tables`] will replace: told before any work.
///
/// # Errors
/// [`ReportError`] where a mark is missing, or the file cannot be read.
pub fn find_envelope_tables([modes, maps]: [bool; 2], file: &Path) -> Result<(), ReportError> {
    for (wanted, name) in [(modes, MODES), (maps, MAPS)] {
        if wanted {
            MarkedPlace::find(file, name)?;
        }
    }
    Ok(())
}

/// Replaces the tables of a document between `<!-- chart failure modes -->` or `<!-- chart maps -->` and `<!-- end -->`
/// by those that were found.
///
/// # Errors
/// When the file or its marks are not there, or the system refuses.
pub fn replace_envelope_tables(of: &EnvelopeResult, file: &Path) -> Result<(), ReportError> {
    if !of.modes.is_empty() {
        MarkedPlace::find(file, MODES)?.replace(&modes_markdown(of))?;
    }
    if !of.maps.is_empty() {
        MarkedPlace::find(file, MAPS)?.replace(&maps_markdown(of))?;
    }
    Ok(())
}
