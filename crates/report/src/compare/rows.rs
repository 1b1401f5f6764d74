//! Runs side by side as tables: numbers with differences, and the curves.

use answer::Table;

use super::{NumberRow, Overlay};

/// Numbers of all runs: key, value of each run, difference and per cent of each but the first. NaN without a value.
pub(super) fn numbers(runs: usize, rows: &[NumberRow]) -> Table {
    let known = |of: &dyn Fn(&NumberRow) -> Option<f64>| -> Vec<f64> {
        rows.iter().map(|row| of(row).unwrap_or(f64::NAN)).collect()
    };
    let mut table =
        Table::new("compare").texts("key", "key of the headline, with unit", rows.iter().map(|r| r.key.clone()));
    for i in 0..runs {
        table.push_numbers(letter(i), "value of this run", known(&|row| row.values[i]));
    }
    for i in 1..runs {
        let difference = |row: &NumberRow| row.differences[i - 1];
        let name = format!("{}_minus_A", letter(i));
        let absolute = known(&|row| difference(row).map(|d| d.absolute));
        let per_cent = known(&|row| difference(row).and_then(|d| d.per_cent));
        table.push_numbers(name.clone(), "this run's less that of run A", absolute);
        table.push_numbers(format!("{name}_per_cent"), "the same over that of run A, per cent", per_cent);
    }
    table
}

/// The curves, a row a point.
pub(super) fn curves(overlays: &[Overlay]) -> Table {
    let all = || overlays.iter().flat_map(|o| o.traces.iter().map(move |t| (o, t)));
    let points = || all().flat_map(|(o, t)| t.points.iter().map(move |p| (o, t, p)));
    Table::new("compare_curves")
        .texts("table", "table of the runs", points().map(|(o, ..)| o.table.clone()))
        .texts("quantity", "column of the table", points().map(|(o, ..)| o.name.clone()))
        .texts("over", "column that it is drawn over", points().map(|(o, ..)| o.over.clone()))
        .texts("run", "folder, and what tells its rows apart", points().map(|(_, t, _)| t.label.clone()))
        .numbers("x", "abscissa", points().map(|(.., p)| p.0))
        .numbers("value", "value", points().map(|(.., p)| p.1))
}

/// A, B, C, ... and numbers for those who compare more runs than letters.
pub(super) fn letter(run: usize) -> String {
    u8::try_from(run).ok().filter(|i| *i < 26).map_or_else(|| run.to_string(), |i| char::from(b'A' + i).to_string())
}
