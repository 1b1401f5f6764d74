//! Runs side by side, as a table for a terminal.

use std::fmt::Write;

use super::{Difference, NumberRow, ResultFolder, WordRow};

/// Width of a column of numbers.
const WIDTH: usize = 13;
/// The same for differences.
const NARROW: usize = 10;

/// Numbers of all runs with their differences against the first, then the inputs that differ.
pub fn compare_table(runs: &[ResultFolder], numbers: &[NumberRow], inputs: &[WordRow]) -> String {
    let mut t = String::new();
    for (i, run) in runs.iter().enumerate() {
        // Writing to a String cannot fail.
        let _ = writeln!(t, "  {} {}", letter(i), run.label());
        for words in run.missed() {
            let _ = writeln!(t, "    DOES NOT HOLD: {words}");
        }
    }
    let label = numbers.iter().map(|r| r.key.len()).max().unwrap_or(0);
    let _ = write!(t, "\n  {:<label$} {:>WIDTH$}", "", letter(0));
    for i in 1..runs.len() {
        let against = format!("{} - {}", letter(i), letter(0));
        let _ = write!(t, " {:>WIDTH$} {against:>WIDTH$} {:>NARROW$}", letter(i), "%");
    }
    t.push('\n');
    for row in numbers {
        let _ = write!(t, "  {:<label$} {:>WIDTH$}", row.key, number(row.values[0]));
        for (value, difference) in row.values.iter().skip(1).zip(&row.differences) {
            let absolute = number(difference.map(|d| d.absolute));
            let _ = write!(t, " {:>WIDTH$} {absolute:>WIDTH$} {:>NARROW$}", number(*value), per_cent(*difference));
        }
        t.push('\n');
    }
    if !inputs.is_empty() {
        t.push_str("\n  inputs that differ\n");
    }
    for row in inputs {
        let values: Vec<&str> = row.values.iter().map(|v| v.as_deref().unwrap_or("-")).collect();
        let _ = writeln!(t, "  {}: {}", row.key, values.join(" | "));
    }
    t
}

/// A, B, C, ... and numbers for those who compare more runs than letters.
pub(super) fn letter(run: usize) -> String {
    u8::try_from(run).ok().filter(|i| *i < 26).map_or_else(|| run.to_string(), |i| char::from(b'A' + i).to_string())
}

/// Six digits; `-` where there is no number.
pub(super) fn number(value: Option<f64>) -> String {
    match value {
        None => "-".to_owned(),
        Some(v) if !v.is_finite() => "-".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(v) if v == v.trunc() && v.abs() < 1e9 => format!("{v:.0}"),
        Some(v) if (1e-3..1e7).contains(&v.abs()) => {
            let places = (5.0 - v.abs().log10().floor()).clamp(0.0, 8.0) as usize;
            format!("{v:.places$}")
        }
        Some(v) => format!("{v:.4e}"),
    }
}

/// Per cent with sign; `-` where there is none.
pub(super) fn per_cent(difference: Option<Difference>) -> String {
    match difference.and_then(|d| d.per_cent) {
        None => "-".to_owned(),
        Some(0.0) => "0".to_owned(),
        Some(p) if p.abs() < 1e-3 || p.abs() >= 1e6 => format!("{p:+.1e}"),
        Some(p) => format!("{p:+.3}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_six_digits_and_a_sign_where_it_matters() {
        let shown = [12.3456789, -0.00123456789, 1e-7, 86_000.0, 0.0, 1234.5678].map(|v| number(Some(v)));
        assert_eq!(shown, ["12.3457", "-0.00123457", "1.0000e-7", "86000", "0", "1234.57"]);
        assert_eq!((number(None), number(Some(f64::NAN))), ("-".into(), "-".into()));
        let d = |absolute, per_cent| per_cent_of(absolute, per_cent);
        assert_eq!([d(1.0, Some(5.0)), d(1.0, None), d(-1.0, Some(-2e-6))], ["+5.000", "-", "-2.0e-6"]);
        assert_eq!([letter(0), letter(25), letter(26)], ["A", "Z", "26"]);
    }

    fn per_cent_of(absolute: f64, per_cent_of_first: Option<f64>) -> String {
        per_cent(Some(Difference { absolute, per_cent: per_cent_of_first }))
    }
}
