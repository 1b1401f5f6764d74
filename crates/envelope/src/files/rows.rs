//! Rows of the envelope: a row a figure, and a row a cell.

use crate::{Cell, FailureMode, Figure};
use answer::Table;

use super::{
    EnvelopeResult,
    words::{outcome, shown},
};

/// A row a figure of a failure mode; a mode that could not be examined has one row with the reason.
pub(super) fn modes(of: &EnvelopeResult) -> Table {
    type Row<'a> = (&'a FailureMode, f64, Result<&'a Figure, String>);
    let rows: Vec<Row<'_>> = of
        .modes
        .iter()
        .flat_map(|(mode, found)| match &found.figures {
            Err(error) => vec![(mode, found.seconds, Err(error.to_string()))],
            Ok(figures) => figures.iter().map(|figure| (mode, found.seconds, Ok(figure))).collect(),
        })
        .collect();
    let text = |of: fn(&FailureMode) -> String| rows.iter().map(move |row| of(row.0));
    let figure = |of: fn(&Figure) -> (String, String)| {
        rows.iter().map(move |row| row.2.as_ref().map_or_else(|_| Default::default(), |figure| of(figure)))
    };
    let naive = |figure: &Figure| figure.naive.as_ref().map(shown).unwrap_or_default();
    let robust = |figure: &Figure| shown(&figure.robust);
    let what = rows.iter().map(|row| row.2.as_ref().map_or_else(Clone::clone, |figure| figure.what.clone()));
    let passes = rows.iter().map(|row| row.2.as_ref().is_ok_and(|figure| figure.holds()).to_string());
    Table::new("envelope")
        .texts("case", "label of the failure mode, as `F7`", text(FailureMode::label))
        .texts("name", "failure mode in a few words", text(|mode| mode.name.to_owned()))
        .texts("scene", "file of the scene", text(|mode| format!("{}.toml", mode.file)))
        .texts("what_fails", "sentence: what fails with a naive method", text(|mode| mode.fails.to_owned()))
        .texts("what_the_program_does", "sentence: what this program does instead", text(|mode| mode.does.to_owned()))
        .texts("figure", "measured figure, with its unit", what)
        .texts("naive", "figure of the naive method; empty where there is none", figure(naive).map(|of| of.0))
        .texts("naive_has_to_be", "condition of the naive figure, which must fail", figure(naive).map(|of| of.1))
        .texts("robust", "figure of this program", figure(robust).map(|of| of.0))
        .texts(
            "robust_has_to_be",
            "condition of the figure of this program, which must hold",
            figure(robust).map(|of| of.1),
        )
        .texts("passes", "`true` where both figures are as they have to be", passes)
        .numbers("seconds", "wall time of the failure mode in s", rows.iter().map(|row| row.1))
}

/// A row a cell of a map.
pub(super) fn maps(of: &EnvelopeResult) -> Table {
    let mut rows: Vec<([&str; 4], &Cell)> = Vec::new();
    for (map, drawn, _) in &of.maps {
        for (layer, cells) in map.layers.iter().zip(&drawn.layers) {
            for (row, cells) in map.rows.1.iter().zip(cells) {
                rows.extend(
                    map.columns.1.iter().zip(cells).map(|(column, cell)| ([map.key, layer, row, column], cell)),
                );
            }
        }
    }
    let place = |k: usize| rows.iter().map(move |row| row.0[k]);
    let number = |of: fn(&Cell) -> Option<f64>| rows.iter().map(move |row| of(row.1).unwrap_or(f64::NAN));
    Table::new("maps")
        .texts("map", "letter of the map", place(0))
        .texts("layer", "layer of the map", place(1))
        .texts("row", "place of the cell: its row", place(2))
        .texts("column", "place of the cell: its column", place(3))
        .texts(
            "outcome",
            "outcome of the cell: `solved`, `warned`, `refused`, `failed`, `none` (no such pair), `wrong` (without a remark: a defect)",
            rows.iter().map(|r| outcome(r.1)),
        )
        .numbers("off_percent", "difference from the finer answer", number(|cell| cell.off_percent))
        .numbers("bound_percent", "bound of the difference, by which the cell is judged", number(|cell| cell.bound_percent))
        .texts("said", "first remark, or reason of a refusal", rows.iter().map(|row| row.1.said.clone().unwrap_or_default()))
        .texts("settings", "settings that make the scene of the cell", rows.iter().map(|row| row.1.settings.join(" ")))
}
