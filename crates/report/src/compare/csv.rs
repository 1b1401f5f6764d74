//! Runs side by side as CSV: `compare.csv`, numbers with differences, and `compare_curves.csv`, the curves.

use std::fmt::Write;

use super::{NumberRow, Overlay, ResultFolder, table::letter};
use crate::csv::push_number;

/// Numbers of all runs: key, value of each run, difference and per cent of each but the first. A field without a value
/// is empty.
pub fn write_compare_csv(runs: &[ResultFolder], rows: &[NumberRow]) -> String {
    let mut csv = String::from("key");
    for i in 0..runs.len() {
        // Writing to a String cannot fail.
        let _ = write!(csv, ",{}", letter(i));
    }
    for i in 1..runs.len() {
        let _ = write!(csv, ",{0}_minus_A,{0}_minus_A_per_cent", letter(i));
    }
    csv.push('\n');
    for row in rows {
        csv.push_str(&row.key);
        row.values.iter().for_each(|v| push_field(&mut csv, *v));
        for difference in &row.differences {
            push_field(&mut csv, difference.map(|d| d.absolute));
            push_field(&mut csv, difference.and_then(|d| d.per_cent));
        }
        csv.push('\n');
    }
    csv
}

/// The curves, one point a line: quantity, what it is over, run, abscissa, value.
pub fn write_curves_csv(overlays: &[Overlay]) -> String {
    let mut csv = String::from("quantity,over,run,x,value\n");
    for overlay in overlays {
        for trace in &overlay.traces {
            let label = trace.label.replace('"', "\"\"");
            for (x, y) in &trace.points {
                let _ = write!(csv, "{},{},\"{label}\"", overlay.name, overlay.over);
                push_field(&mut csv, Some(*x));
                push_field(&mut csv, Some(*y));
                csv.push('\n');
            }
        }
    }
    csv
}

fn push_field(csv: &mut String, value: Option<f64>) {
    csv.push(',');
    if let Some(value) = value {
        push_number(csv, value);
    }
}
