//! What a page and a closing table are made of: parts with lines, grids and figures, whatever was asked.

use answer::{Answer, Cost, shown_units};
use serde::{Deserialize, Serialize};

use crate::tables::fixed;

/// A page about an answer: what stands at its top, and its parts in their order.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Page {
    /// Title.
    pub name: String,
    /// One line below it.
    pub subtitle: String,
    /// Version of the program that made it.
    pub version: String,
    /// Checks that do not hold, in words.
    pub failed: Vec<String>,
    /// Remarks for the user.
    pub remarks: Vec<String>,
    /// The few numbers that people look for first: label and value with unit.
    pub glance: Vec<[String; 2]>,
    /// Parts.
    pub parts: Vec<Part>,
}

/// A part of a page.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Heading; none where the part goes on with the one before.
    pub title: String,
    /// One paragraph below it.
    pub words: String,
    /// Content of the part.
    pub contents: Vec<Content>,
    /// In small letters below all.
    pub note: String,
    /// Whether the closing table on the terminal has it.
    pub is_closing: bool,
}

/// One thing that a part shows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Content {
    /// Labels with values.
    Lines(Vec<Line>),
    /// Rows below a heading.
    Grid(Grid),
    /// Charts and maps, each a figure of a page.
    Figures(Vec<String>),
    /// A part of a page by its own template: gears in space, contact patterns.
    Html(String),
    /// A list.
    Items(Vec<String>),
    /// Text as it stands.
    Plain(String),
    /// Tables of a document.
    Markdown(String),
}

/// A label, its value and its unit.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// Label of the line.
    pub label: String,
    /// The number as it is shown.
    pub value: String,
    /// Unit, and what goes with it.
    pub unit: String,
}

impl Line {
    /// A value in words.
    pub fn text(label: impl Into<String>, value: impl ToString, unit: impl Into<String>) -> Self {
        let [label, value, unit] =
            [label.into(), value.to_string(), unit.into()].map(|text: String| shown_units(&text));
        Self { label, value, unit }
    }

    /// A number with so many decimals ([`fixed`]), `-` when there is none.
    pub fn number(
        label: impl Into<String>,
        value: impl Into<Option<f64>>,
        decimals: usize,
        unit: impl Into<String>,
    ) -> Self {
        Self::text(label, shown(value.into(), decimals), unit)
    }

    /// A small number as power of ten, `-` when there is none.
    pub fn science(label: impl Into<String>, value: impl Into<Option<f64>>, unit: impl Into<String>) -> Self {
        Self::text(label, science(value.into()), unit)
    }
}

/// A cell of a grid.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// What stands in it.
    pub text: String,
    /// Whether it is a number, which stands on the right.
    pub is_number: bool,
    /// Page that a click on it opens.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// How it is coloured: a class of `style.css`.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub tone: String,
    /// What a pointer on it says.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub told: String,
}

impl Cell {
    /// A cell in a colour: a class of `style.css`.
    #[must_use]
    pub fn toned(self, tone: &str) -> Self {
        Self { tone: tone.to_owned(), ..self }
    }

    /// A cell with words for a pointer.
    #[must_use]
    pub fn told(self, told: String) -> Self {
        Self { told, ..self }
    }

    /// Words.
    pub fn text(text: impl Into<String>) -> Self {
        Self { text: text.into(), ..Self::default() }
    }

    /// A number with so many decimals, `-` when there is none.
    pub fn number(value: impl Into<Option<f64>>, decimals: usize) -> Self {
        Self { text: shown(value.into(), decimals), is_number: true, ..Self::default() }
    }

    /// A number with four significant digits, whole numbers as they are, `-` when there is none.
    pub fn significant(value: impl Into<Option<f64>>) -> Self {
        let text = |v: f64| match v.round() {
            whole if (v - whole).abs() <= 1e-9 * v.abs() => format!("{whole:.0}"),
            _ if v.abs() < 1e-4 => format!("{v:.3e}"),
            _ => fixed(v, (3.0 - v.abs().log10().floor()).clamp(0.0, 8.0) as usize),
        };
        let text = value.into().filter(|v| v.is_finite()).map_or_else(|| "-".to_owned(), text);
        Self { text, is_number: true, ..Self::default() }
    }

    /// A small number as power of ten, `-` when there is none.
    pub fn science(value: impl Into<Option<f64>>) -> Self {
        Self { text: science(value.into()), is_number: true, ..Self::default() }
    }

    /// A whole number.
    pub fn count(value: impl ToString) -> Self {
        Self { text: value.to_string(), is_number: true, ..Self::default() }
    }
}

/// Rows below a heading, every row with a cell for each word of it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Headings.
    pub head: Vec<String>,
    /// Rows.
    pub rows: Vec<Vec<Cell>>,
    /// Whether a click on a heading sorts them.
    #[serde(default)]
    pub is_sortable: bool,
}

impl Grid {
    /// Without rows.
    pub fn new<S: Into<String>>(head: impl IntoIterator<Item = S>) -> Self {
        let words = head.into_iter().map(Into::into);
        Self { head: words.map(|word: String| shown_units(&word)).collect(), ..Self::default() }
    }

    /// With rows that a click on a heading sorts.
    #[must_use]
    pub fn sortable(self) -> Self {
        Self { is_sortable: true, ..self }
    }

    /// With these rows.
    #[must_use]
    pub fn rows(mut self, rows: impl IntoIterator<Item = Vec<Cell>>) -> Self {
        self.rows.extend(rows);
        self
    }
}

impl Part {
    /// With a heading.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// Without one.
    pub fn more() -> Self {
        Self::default()
    }

    /// In the closing table as well.
    #[must_use]
    pub fn closing(self) -> Self {
        Self { is_closing: true, ..self }
    }

    /// With a paragraph below its heading.
    #[must_use]
    pub fn words(self, words: impl Into<String>) -> Self {
        Self { words: shown_units(&words.into()), ..self }
    }

    /// With small letters at its end.
    #[must_use]
    pub fn note(self, note: impl Into<String>) -> Self {
        Self { note: shown_units(&note.into()), ..self }
    }

    /// With one more content; empty ones are left out.
    #[must_use]
    pub fn with(mut self, content: Content) -> Self {
        if !content.is_empty() {
            self.contents.push(content);
        }
        self
    }

    /// With labels and values.
    #[must_use]
    pub fn lines(self, lines: impl IntoIterator<Item = Line>) -> Self {
        self.with(Content::Lines(lines.into_iter().collect()))
    }

    /// With a grid.
    #[must_use]
    pub fn grid(self, grid: Grid) -> Self {
        self.with(Content::Grid(grid))
    }

    /// With figures.
    #[must_use]
    pub fn figures(self, figures: impl IntoIterator<Item = String>) -> Self {
        self.with(Content::Figures(figures.into_iter().collect()))
    }

    /// Whether it shows nothing.
    pub fn is_empty(&self) -> bool {
        self.contents.is_empty() && self.words.is_empty() && self.note.is_empty()
    }
}

impl Content {
    fn is_empty(&self) -> bool {
        match self {
            Self::Lines(all) => all.is_empty(),
            Self::Grid(grid) => grid.rows.is_empty(),
            Self::Figures(all) | Self::Items(all) => all.is_empty(),
            Self::Html(text) | Self::Plain(text) | Self::Markdown(text) => text.is_empty(),
        }
    }
}

impl Page {
    /// Title, checks that do not hold and remarks of an answer; parts come behind.
    pub fn of(answer: &Answer, subtitle: String) -> Self {
        Self {
            name: answer.name.clone(),
            subtitle: shown_units(&subtitle),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            failed: answer.checks.missed().map(answer::Check::words).collect(),
            remarks: answer.remarks.iter().map(|said| shown_units(&said.to_string())).collect(),
            ..Self::default()
        }
    }

    /// Every check of an answer with its bound.
    pub fn trust(answer: &Answer) -> Part {
        let words = match (answer.checks.word(), answer.remarks.len()) {
            ("failed", _) => "Not at all: see the top of this page.",
            (_, 0) => "No check of this run asks for a second look.",
            (_, 1) => "Mind the warning at the top of this page.",
            _ => "Mind the remarks at the top of this page.",
        };
        let rows = answer.checks.iter().map(|check| {
            vec![Cell::text(check.name.replace('_', " ")), Cell::science(check.value), Cell::science(check.bound)]
        });
        Part::new("How far to trust it").words(words).grid(Grid::new(["check", "value", "bound"]).rows(rows))
    }

    /// With one more part; empty ones are left out.
    pub fn push(&mut self, part: Part) {
        if !part.is_empty() {
            self.parts.push(part);
        }
    }
}

fn shown(value: Option<f64>, decimals: usize) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "-".to_owned(), |v| fixed(v, decimals))
}

fn science(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "-".to_owned(), |v| format!("{v:.1e}"))
}

/// So many of something: `1 case`, `5 cases`.
pub fn counted(count: usize, of_one: &str) -> String {
    format!("{count} {of_one}{}", if count == 1 { "" } else { "s" })
}

/// Time and memory of every phase.
pub fn cost_part(cost: &Cost) -> Part {
    let row =
        |name: &str, wall_s: f64, mb: Option<f64>| vec![Cell::text(name), Cell::number(wall_s, 2), Cell::number(mb, 0)];
    let phases = cost.phases.iter().map(|phase| row(&phase.name, phase.wall_s, phase.peak_memory_mb));
    let rows = phases.chain([row("total", cost.wall_s, cost.peak_memory_mb)]);
    let note = format!("{} threads.", cost.threads);
    Part::new("Cost").grid(Grid::new(["phase", "wall s", "peak MB"]).rows(rows)).note(note)
}

/// The command that reproduces a result.
pub fn again(command: &str) -> Part {
    Part::new("Command").with(Content::Plain(command.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four digits where a value has them, none where it is whole.
    #[test]
    fn numbers_have_four_significant_digits() {
        let text = |v: f64| Cell::significant(v).text;
        let shown = [-7.0, 0.0, 112.5, 0.150_94, 1105.06, -0.064_051, 13_750.0, f64::NAN].map(text);
        assert_eq!(shown, ["-7", "0", "112.5", "0.1509", "1105", "-0.06405", "13750", "-"]);
        assert_eq!(text(1e-7), "1.000e-7");
    }
}
