//! Figures in words.

use crate::{Asked, Cell, Outcome, Shown, Value};

/// A number as short as it says something.
pub(super) fn short(x: f64) -> String {
    if x == 0.0 || (1e-3..1e5).contains(&x.abs()) {
        let places = (2.0 - x.abs().max(1e-3).log10().floor()).clamp(0.0, 4.0) as usize;
        let text = format!("{x:.places$}");
        return if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text };
    }
    format!("{x:.1e}")
}

/// What was found, and what it has to be.
pub(super) fn shown(shown: &Shown) -> (String, String) {
    let value = match &shown.value {
        Value::Number(x) => short(*x),
        Value::Words(said) => format!("\"{said}\""),
    };
    let asked = match shown.asked {
        Asked::AtLeast(x) => format!(">= {}", short(x)),
        Asked::AtMost(x) => format!("<= {}", short(x)),
        Asked::Says(words) => format!("says \"{words}\""),
    };
    (value, asked)
}

/// One word for a cell.
pub(super) fn outcome(cell: &Cell) -> &'static str {
    match cell.outcome {
        Outcome::Solved => "solved",
        Outcome::Warned => "warned",
        Outcome::Refused => "refused",
        Outcome::Failed => "failed",
        Outcome::None => "none",
        Outcome::Wrong => "wrong",
    }
}
