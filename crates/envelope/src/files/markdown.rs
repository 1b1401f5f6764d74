//! Outcomes of the failure modes as tables of a document.

use std::fmt::Write;

use crate::{Cell, Outcome};

use super::{
    EnvelopeResult,
    words::{short, shown},
};

/// Longest message in a cell of a table; the csv file has it whole.
const LONGEST: usize = 90;

fn cut(text: String) -> String {
    let text = text.replace('|', "\\|");
    if text.chars().count() <= LONGEST { text } else { text.chars().take(LONGEST).chain("...".chars()).collect() }
}

/// A table a row a figure, and what fails and what is done above it.
pub fn modes_markdown(of: &EnvelopeResult) -> String {
    let mut text = String::from("| case | figure | naive | robust | has to be | |\n|---|---|---|---|---|---|\n");
    for (mode, found) in &of.modes {
        let case = format!("[{}](#{}) {}", mode.label(), mode.label().to_lowercase(), mode.name);
        match &found.figures {
            Err(error) => {
                let _ = writeln!(text, "| {case} | {} | | | | FAILS |", cut(error.to_string()));
            }
            Ok(figures) => {
                for (i, figure) in figures.iter().enumerate() {
                    let (robust, asked) = shown(&figure.robust);
                    let naive = figure.naive.as_ref().map(shown);
                    let (naive, naive_asked) =
                        naive.map_or((String::new(), String::new()), |(v, a)| (v, format!("; naive {a}")));
                    let case = if i == 0 { case.as_str() } else { "" };
                    let verdict = if figure.holds() { "passes" } else { "FAILS" };
                    let _ = writeln!(
                        text,
                        "| {case} | {} | {} | {} | {asked}{naive_asked} | {verdict} |",
                        figure.what.replace('|', "\\|"),
                        cut(naive),
                        cut(robust)
                    );
                }
            }
        }
    }
    text.push('\n');
    for (mode, found) in &of.modes {
        let _ = writeln!(
            text,
            "#### {}\n\n**{}.** {}\n\n*Here:* {} ({:.1} s)\n\n```sh\n{}",
            mode.label(),
            mode.name,
            mode.fails,
            mode.does,
            found.seconds,
            mode.command()
        );
        if let Some(naive) = mode.naive_command() {
            let _ = writeln!(text, "{naive}   # the naive way");
        }
        text.push_str("```\n\n");
    }
    text
}

fn cell(cell: &Cell) -> String {
    let off = cell.off_percent.map_or(String::new(), |x| format!(" {}", short(x)));
    match cell.outcome {
        Outcome::Solved => format!("ok{off}"),
        Outcome::Warned => format!("warned{off}"),
        Outcome::Refused => "refused".to_owned(),
        Outcome::Failed => format!("failed{off}"),
        Outcome::None => String::new(),
        Outcome::Wrong => format!("**WRONG**{off}"),
    }
}

/// A table a layer of a map: outcome, and difference from the finer answer in percent.
pub fn maps_markdown(of: &EnvelopeResult) -> String {
    let mut text = String::new();
    for (map, drawn, _) in &of.maps {
        let _ = writeln!(text, "### ({}) {}\n\n{}\n", map.key, map.name, map.judged);
        if !map.file.is_empty() {
            let _ = writeln!(
                text,
                "Scene: `scenes/envelope/{}.toml`; the keys of each cell are in `maps.csv`.\n",
                map.file
            );
        }
        for (layer, rows) in map.layers.iter().zip(&drawn.layers) {
            let name = if layer.is_empty() { String::new() } else { format!("{layer}: ") };
            let _ = writeln!(text, "| {name}{}, over {} | {} |", map.rows.0, map.columns.0, map.columns.1.join(" | "));
            let _ = writeln!(text, "|---|{}", "---|".repeat(map.columns.1.len()));
            for (value, row) in map.rows.1.iter().zip(rows) {
                let cells: Vec<String> = row.iter().map(cell).collect();
                let _ = writeln!(text, "| {value} | {} |", cells.join(" | "));
            }
            text.push('\n');
        }
        let mut reasons: Vec<String> = drawn.cells().filter_map(|c| c.said.as_ref()).map(|s| kind_of(s)).collect();
        reasons.sort();
        reasons.dedup();
        for reason in &reasons {
            let _ = writeln!(text, "* said: {}", cut(reason.clone()));
        }
        text.push('\n');
    }
    text
}

/// A message without its numbers: cells that say the same say it once.
fn kind_of(said: &str) -> String {
    let mut out = String::new();
    for c in said.chars() {
        match c.is_ascii_digit() {
            true if !out.ends_with('#') => out.push('#'),
            true => {}
            false => out.push(c),
        }
    }
    out.replace("#.#", "#").replace("#e-#", "#").replace("#e#", "#")
}
