//! `envelope.csv`, a row a figure, and `maps.csv`, a row a cell.

use super::{
    EnvelopeResult,
    words::{outcome, shown},
};
use crate::csv::quoted;

/// A row a figure of a failure mode; a mode that could not be examined has one row with the reason.
pub fn envelope_csv(of: &EnvelopeResult) -> String {
    let header = "case,name,scene,what_fails,what_the_program_does,figure,naive,naive_has_to_be,robust,robust_has_to_be,passes,seconds";
    let mut rows = vec![header.to_owned()];
    for (mode, found) in &of.modes {
        let mut row = |what: &str, naive: (String, String), robust: (String, String), passes: bool| {
            let texts = [
                mode.label(),
                mode.name.to_owned(),
                format!("{}.toml", mode.file),
                mode.fails.to_owned(),
                mode.does.to_owned(),
                what.to_owned(),
                naive.0,
                naive.1,
                robust.0,
                robust.1,
                passes.to_string(),
            ];
            let fields: Vec<String> = texts.iter().map(|t| quoted(t)).collect();
            rows.push(format!("{},{:.2}", fields.join(","), found.seconds));
        };
        match &found.figures {
            Err(error) => row(&error.to_string(), Default::default(), Default::default(), false),
            Ok(figures) => figures.iter().for_each(|figure| {
                let naive = figure.naive.as_ref().map(shown).unwrap_or_default();
                row(&figure.what, naive, shown(&figure.robust), figure.holds());
            }),
        }
    }
    rows.push(String::new());
    rows.join("\n")
}

/// A row a cell.
pub fn maps_csv(of: &EnvelopeResult) -> String {
    let mut rows = vec!["map,layer,row,column,outcome,off_percent,bound_percent,said,settings".to_owned()];
    for (map, drawn, _) in &of.maps {
        for (layer, cells) in map.layers.iter().zip(&drawn.layers) {
            for (row, cells) in map.rows.1.iter().zip(cells) {
                for (column, cell) in map.columns.1.iter().zip(cells) {
                    let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.4}"));
                    let said = cell.said.clone().unwrap_or_default();
                    let texts = [map.key, layer, row, column, outcome(cell)].map(quoted).join(",");
                    let [off, bound] = [cell.off_percent, cell.bound_percent].map(number);
                    let settings = cell.settings.join(" ");
                    rows.push(format!("{texts},{off},{bound},{},{}", quoted(&said), quoted(&settings)));
                }
            }
        }
    }
    rows.push(String::new());
    rows.join("\n")
}
