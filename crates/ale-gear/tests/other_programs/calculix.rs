//! The point of CalculiX on the chart.

use super::util::{Scratch, chart_rows, five_teeth};

/// On the same mesh it computes the same gears, but for how forces are laid on the nodes.
pub fn point_on_the_chart(_: ()) {
    let scratch = Scratch::new().file("a.toml", five_teeth());
    let run = scratch.ale_gear(["chart", "a.toml", "--out", "o", "--quick", "--limit-s", "1e9"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let rows = chart_rows(&scratch.read("o/chart.csv"));
    let of = |way: &str| -> Vec<(String, f64)> {
        let own = rows.iter().filter(|r| r["way"] == way);
        own.map(|r| (r["density"].clone(), r["mean_ste_um"].parse().unwrap_or_else(|_| panic!("{r:?}")))).collect()
    };
    let (theirs, ours) = (of("CalculiX"), of("full"));
    assert!(!theirs.is_empty(), "{rows:?}");
    for (density, ste) in theirs {
        let (_, own) = ours.iter().find(|(d, _)| *d == density).unwrap_or_else(|| panic!("no `full` of {density}"));
        println!("density {density}: CalculiX {ste} um, full {own} um");
        assert!((ste / own - 1.0).abs() < 0.02, "density {density}: CalculiX {ste} um, full {own} um");
    }
}
