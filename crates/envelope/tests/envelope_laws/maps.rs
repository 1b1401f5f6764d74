//! Maps have no cell that is wrong without a word.

use envelope::{MAPS, Outcome};

/// Named by `ENVELOPE_MAPS`, as `c` or `a,d`; else the one that takes seconds.
#[test]
fn no_cell_is_wrong_without_a_word() {
    let asked = std::env::var("ENVELOPE_MAPS").unwrap_or_else(|_| "d".to_owned());
    for map in MAPS.iter().filter(|m| asked.split(',').any(|k| k == m.key)) {
        let start = std::time::Instant::now();
        let drawn = map.draw(&|| ());
        println!("({}) {}: {} cells, {:.0} s", map.key, map.name, map.count(), start.elapsed().as_secs_f64());
        for (layer, name) in drawn.layers.iter().zip(map.layers) {
            println!("  {name}");
            for (row, value) in layer.iter().zip(map.rows.1) {
                let of = |c: &envelope::Cell| match c.outcome {
                    Outcome::Solved => format!("  {:7.1}", c.off_percent.unwrap_or(f64::NAN)),
                    other => format!("{:>2}{:7.1}", &format!("{other:?}")[..1], c.off_percent.unwrap_or(f64::NAN)),
                };
                println!("    {value:>10} {}", row.iter().map(of).collect::<String>());
            }
        }
        let mut said: Vec<&String> = drawn.cells().filter_map(|c| c.said.as_ref()).collect();
        said.sort();
        said.dedup_by_key(|s| s.chars().take(60).collect::<String>());
        said.iter().take(8).for_each(|s| println!("    said: {}", &s.chars().take(200).collect::<String>()));
        for cell in drawn.cells().filter(|c| c.outcome == Outcome::Wrong) {
            println!("    WRONG {:?} off {:?} %", cell.settings, cell.off_percent);
        }
        assert_eq!(drawn.wrong(), 0, "map {}: cells that are wrong without a word", map.key);
    }
}
