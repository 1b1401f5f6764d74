//! Numbers and texts as fields of a file with commas.

use std::fmt::Write;

/// One line of numbers with commas between them.
pub fn push_row(csv: &mut String, row: impl IntoIterator<Item = f64>) {
    for (k, value) in row.into_iter().enumerate() {
        if k > 0 {
            csv.push(',');
        }
        push_number(csv, value);
    }
    csv.push('\n');
}

/// A text as one field of a file with commas: in quotes where it has to be.
pub fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) { always_quoted(text) } else { text.to_owned() }
}

/// A text as one field of a file with commas, in quotes.
pub fn always_quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// The shortest text that reads back to the same number.
pub fn push_number(text: &mut String, value: f64) {
    let plain = value == 0.0 || !value.is_finite() || (1e-4..1e12).contains(&value.abs());
    // Writing to a String cannot fail.
    let _ = if plain { write!(text, "{value}") } else { write!(text, "{value:e}") };
}
