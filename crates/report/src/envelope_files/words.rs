//! Figures in words, and the closing table.

use envelope::{Asked, Cell, Outcome, Shown, Value};

use super::EnvelopeResult;

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

/// The table at the end: a line a mode, a line a map.
pub fn envelope_table(of: &EnvelopeResult) -> String {
    let mut lines = Vec::new();
    for (mode, found) in &of.modes {
        let verdict = if found.holds() { "passes" } else { "FAILS" };
        lines.push(format!("  {:<4} {:<44} {verdict:<7} {:>7.1} s", mode.label(), mode.name, found.seconds));
        match &found.figures {
            Err(error) => lines.push(format!("       {error}")),
            Ok(figures) => lines.extend(figures.iter().filter(|f| !f.holds()).map(|figure| {
                let (value, asked) = shown(&figure.robust);
                let naive = figure.naive.as_ref().filter(|n| !n.holds()).map(shown);
                let naive = naive.map_or(String::new(), |(v, a)| format!("; naive {v}, has to be {a}"));
                format!("       {}: {value}, has to be {asked}{naive}", figure.what)
            })),
        }
    }
    for (map, drawn, seconds) in &of.maps {
        let count = |which: Outcome| drawn.cells().filter(|c| c.outcome == which).count();
        lines.push(format!(
            "  ({}) {}: {} solved, {} warned, {} refused, {} failed, {} wrong without a word, {seconds:.0} s",
            map.key,
            map.name,
            count(Outcome::Solved),
            count(Outcome::Warned),
            count(Outcome::Refused),
            count(Outcome::Failed),
            drawn.wrong()
        ));
    }
    lines.push(String::new());
    lines.join("\n")
}
