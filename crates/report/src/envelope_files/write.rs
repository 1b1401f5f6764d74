//! All files of the envelope.

use std::path::Path;

use envelope::Outcome;
use minijinja::{context, value::Serde};
use serde_json::{Value, json};

use super::{
    EnvelopeResult, envelope_csv, maps_csv, maps_markdown, modes_markdown,
    words::{outcome, short, shown},
};
use crate::{MarkedPlace, ReportError, ResultFiles, page::Rendered};

/// Names of the places of both tables in a document.
const MODES: &str = "failure modes";
const MAPS: &str = "maps";

/// `envelope.csv`, `maps.csv` where maps were drawn, and `report.html`.
///
/// # Errors
/// When the system refuses, or the template cannot be filled.
pub fn write_envelope(of: &EnvelopeResult, command: &str, results: &dyn ResultFiles) -> Result<(), ReportError> {
    if !of.modes.is_empty() {
        results.write("envelope.csv", envelope_csv(of).as_bytes())?;
    }
    if !of.maps.is_empty() {
        results.write("maps.csv", maps_csv(of).as_bytes())?;
    }
    let page = Rendered::new(
        "envelope.html",
        context! {
            name => "Envelope: where such solvers fail",
            version => env!("CARGO_PKG_VERSION"),
            warnings => of.missed().into_iter().map(|m| format!("does not hold: {m}")).collect::<Vec<_>>(),
            modes => Serde(of.modes.iter().map(mode).collect::<Vec<_>>()),
            maps => Serde(of.maps.iter().map(map).collect::<Vec<_>>()),
            command => command,
        },
    )?;
    page.write(results)
}

fn mode((mode, found): &(envelope::FailureMode, envelope::Examined)) -> Value {
    let figures = match &found.figures {
        Err(error) => vec![json!({ "what": error.to_string(), "naive": "", "robust": "", "asked": "", "holds": false })],
        Ok(figures) => figures
            .iter()
            .map(|figure| {
                let (robust, asked) = shown(&figure.robust);
                let naive = figure.naive.as_ref().map_or(String::new(), |n| shown(n).0);
                json!({ "what": figure.what, "naive": naive, "robust": robust, "asked": asked, "holds": figure.holds() })
            })
            .collect(),
    };
    json!({
        "label": mode.label(), "name": mode.name, "fails": mode.fails, "does": mode.does, "command": mode.command(),
        "naive_command": mode.naive_command(), "figures": figures, "seconds": format!("{:.1}", found.seconds),
        "holds": found.holds(),
    })
}

fn map((map, drawn, seconds): &(envelope::EnvelopeMap, envelope::DrawnMap, f64)) -> Value {
    let cell = |c: &envelope::Cell| {
        let off = c.off_percent.filter(|_| c.outcome != Outcome::Refused).map_or(String::new(), short);
        json!({ "outcome": outcome(c), "off": off, "said": c.said, "settings": c.settings.join(" ") })
    };
    let layer = |(name, rows): (&&str, &Vec<Vec<envelope::Cell>>)| {
        let rows: Vec<Value> = rows
            .iter()
            .zip(map.rows.1)
            .map(|(cells, value)| json!({ "value": value, "cells": cells.iter().map(cell).collect::<Vec<_>>() }))
            .collect();
        json!({ "name": name, "rows": rows })
    };
    json!({
        "key": map.key, "name": map.name, "judged": map.judged, "columns": map.columns.1, "columns_name": map.columns.0,
        "rows_name": map.rows.0, "layers": map.layers.iter().zip(&drawn.layers).map(layer).collect::<Vec<_>>(),
        "seconds": format!("{seconds:.0}"), "wrong": drawn.wrong(),
    })
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
