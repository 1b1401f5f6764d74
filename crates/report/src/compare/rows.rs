//! Runs side by side as tables: numbers with differences, and the curves.

use answer::Table;

use super::{NumberRow, Overlay};

/// Numbers of all runs: key, value of each run, difference and per cent of each but the first. NaN without a value.
pub(super) fn numbers(runs: usize, rows: &[NumberRow]) -> Table {
    let known = |of: &dyn Fn(&NumberRow) -> Option<f64>| -> Vec<f64> {
        rows.iter().map(|row| of(row).unwrap_or(f64::NAN)).collect()
    };
    let mut table = Table::new("compare").texts(
        "key",
        "key of the headline, `a.b` and `a[1]` where it lies deeper",
        rows.iter().map(|r| r.key.clone()),
    );
    for i in 0..runs {
        table.push_numbers(letter(i), "value of the run", known(&|row| row.values[i]));
    }
    for i in 1..runs {
        let difference = |row: &NumberRow| row.differences[i - 1];
        let name = format!("{}_minus_A", letter(i));
        let absolute = known(&|row| difference(row).map(|d| d.absolute));
        let per_cent = known(&|row| difference(row).and_then(|d| d.per_cent));
        table.push_numbers(name.clone(), "value of the run minus that of run A", absolute);
        table.push_numbers(
            format!("{name}_per_cent"),
            "difference over the value of run A, sign included: a number twice as large reads +100",
            per_cent,
        );
    }
    table
}

/// The curves, a row a point.
pub(super) fn curves(overlays: &[Overlay]) -> Table {
    let all = || overlays.iter().flat_map(|o| o.traces.iter().map(move |t| (o, t)));
    let points = || all().flat_map(|(o, t)| t.points.iter().map(move |p| (o, t, p)));
    Table::new("compare_curves")
        .texts(
            "table",
            "table of the runs; `rows` where the first tables have different names",
            points().map(|(o, ..)| o.table.clone()),
        )
        .texts(
            "quantity",
            "column of the table; `te_um` where a static transmission error is compared with a dynamic one",
            points().map(|(o, ..)| o.name.clone()),
        )
        .texts(
            "over",
            "abscissa: `mesh_phase`, `time_s`, `speed_rpm`, else the first column of numbers",
            points().map(|(o, ..)| o.over.clone()),
        )
        .texts(
            "run",
            "folder of the run, and the words that distinguish its rows",
            points().map(|(_, t, _)| t.label.clone()),
        )
        .numbers("x", "value of the abscissa", points().map(|(.., p)| p.0))
        .numbers("value", "value of the quantity", points().map(|(.., p)| p.1))
}

/// Tables of a comparison without rows, for `docs/outputs.md`.
pub(crate) fn documented() -> [Table; 2] {
    [numbers(2, &[]), curves(&[])]
}

/// A, B, C, ... and numbers for those who compare more runs than letters.
pub(super) fn letter(run: usize) -> String {
    u8::try_from(run).ok().filter(|i| *i < 26).map_or_else(|| run.to_string(), |i| char::from(b'A' + i).to_string())
}
