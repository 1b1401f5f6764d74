//! The point of CalculiX on the chart.

use super::util::{Scratch, chart_rows, five_teeth};

/// It is run on the same coarse meshes and computes the same gears, its faces as they are meshed: nothing is off by a
/// unit, a sign or a factor.
pub fn point_on_the_chart(_: ()) {
    let scratch = Scratch::new().file("a.toml", five_teeth());
    let run = scratch.ale_gear(["chart", "a.toml", "--out", "o", "--quick", "--limit-s", "1e9"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let rows = chart_rows(&scratch.read("o/chart.csv"));
    let theirs: Vec<_> = rows.iter().filter(|row| row["way"] == "CalculiX").collect();
    assert_eq!(theirs.len(), 2, "the two coarsest meshes: {rows:?}");
    for row in theirs {
        let ste = row["mean_ste_um"].parse::<f64>().unwrap_or(f64::NAN);
        assert!((5.0..20.0).contains(&ste), "{ste} um: {row:?}");
    }
}
