//! The table at the end of a command: the parts of a page that fit on a terminal.

use std::fmt::Write;

use super::part::{Content, Grid, Page};
use crate::{Cost, tables::push_line};

/// Width of the first column of a grid, and the least of the others.
const FIRST: usize = 24;
const OTHER: usize = 9;
/// Width of a column at the most: longer labels stand out, and none of 65536 characters can be a width at all.
const WIDEST: usize = 200;

/// The closing table of a page: title, checks that do not hold, its closing parts, phases, remarks.
pub fn closing_text(page: &Page, cost: &Cost) -> String {
    let mut t = format!("{} ({})\n\n", page.name, page.subtitle);
    for words in &page.failed {
        push_line(&mut t, "CHECK FAILED", "", words);
    }
    for (i, part) in page.parts.iter().filter(|part| part.is_closing && !part.contents.is_empty()).enumerate() {
        if i > 0 && !part.title.is_empty() {
            t.push('\n');
        }
        for content in &part.contents {
            match content {
                Content::Lines(lines) => lines.iter().for_each(|l| push_line(&mut t, &l.label, &l.value, &l.unit)),
                Content::Grid(grid) => push_grid(&mut t, grid),
                Content::Items(items) => items.iter().for_each(|item| push_line(&mut t, item, "", "")),
                Content::Plain(text) | Content::Markdown(text) => t.push_str(text),
                Content::Figures(_) | Content::Html(_) => {}
            }
        }
    }
    if !cost.phases.is_empty() {
        t.push('\n');
        t += &phases(cost);
    }
    for warning in &page.remarks {
        // Writing to a String cannot fail.
        let _ = writeln!(t, "\nwarning: {warning}");
    }
    t
}

/// Time and memory of every phase.
fn phases(cost: &Cost) -> String {
    let mut t = String::new();
    let mb = |m: Option<f64>| m.map_or_else(|| "-".to_owned(), |m| format!("{m:.0}"));
    // Writing to a String cannot fail.
    let _ = writeln!(t, "  {:<14} {:>10} {:>14}", "phase", "wall s", "peak MB");
    for phase in &cost.phases {
        let _ = writeln!(t, "  {:<14} {:>10.2} {:>14}", phase.name, phase.wall_s, mb(phase.peak_memory_mb));
    }
    let _ = writeln!(t, "  {:<14} {:>10.2} {:>14}", "total", cost.wall_s, mb(cost.peak_memory_mb));
    t
}

/// Columns as wide as what stands in them, numbers on the right.
fn push_grid(t: &mut String, grid: &Grid) {
    let wide = |k: usize| {
        let cells = grid.rows.iter().filter_map(|row| row.get(k)).map(|cell| cell.text.chars().count());
        let least = if k == 0 { FIRST } else { OTHER };
        cells.chain([grid.head[k].chars().count(), least]).max().unwrap_or(least).min(WIDEST)
    };
    let widths: Vec<usize> = (0..grid.head.len()).map(wide).collect();
    let is_number = |k: usize| grid.rows.iter().any(|row| row.get(k).is_some_and(|cell| cell.is_number));
    let mut push = |cells: &mut dyn Iterator<Item = &str>| {
        let mut line = String::new();
        for (k, text) in cells.enumerate().take(widths.len()) {
            let width = widths[k];
            // Writing to a String cannot fail.
            let _ = if is_number(k) { write!(line, "  {text:>width$}") } else { write!(line, "  {text:<width$}") };
        }
        t.push_str(line.trim_end());
        t.push('\n');
    };
    push(&mut grid.head.iter().map(String::as_str));
    for row in &grid.rows {
        push(&mut row.iter().map(|cell| cell.text.as_str()));
    }
}
