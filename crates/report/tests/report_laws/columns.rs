//! Tables of columns against their names, their units and the document.

use std::{collections::BTreeSet, fs, path::Path};

use report::columns::{ENERGY, LUMPED_HISTORY, MOTION_HISTORY, Rows, STATIC_HISTORY, Table};

/// How a unit ends a name; nothing for a plain number.
fn ending(unit: &str) -> &'static str {
    match unit {
        "" => "",
        "s" => "_s",
        "deg" => "_deg",
        "um" => "_um",
        "mm" => "_mm",
        "N" => "_n",
        "N mm" => "_nmm",
        "N/um" => "_n_per_um",
        "MPa" => "_mpa",
        "W" => "_w",
        "1/min" => "_rpm",
        "um/s" => "_um_per_s",
        "urad" => "_urad",
        "urad/s" => "_urad_per_s",
        "N m" => "_nm",
        "mJ" => "_mj",
        "%" => "_percent",
        other => panic!("the unit {other} has no ending for names"),
    }
}

fn holds<R: Rows>(table: &Table<R>, what: &str) {
    let mut names = BTreeSet::new();
    for column in table.columns() {
        assert!(names.insert(column.name), "{what}: two columns `{}`", column.name);
        assert!(column.name.ends_with(ending(column.unit)), "{what}: `{}` is in {}", column.name, column.unit);
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/outputs.md");
    let page = fs::read_to_string(&file).unwrap();
    let lines: BTreeSet<&str> = page.lines().collect();
    let missing: Vec<String> = table.documented().into_iter().filter(|row| !lines.contains(row.as_str())).collect();
    assert!(
        missing.is_empty(),
        "{what}: docs/outputs.md lacks these rows, as the table has them:\n{}",
        missing.join("\n")
    );
}

/// A column's name ends in its unit, no two columns share a name, and the document says word for word what the table
/// says.
#[test]
fn columns_are_named_by_their_units_and_documented() {
    holds(&STATIC_HISTORY, "history.csv at rest");
    holds(&MOTION_HISTORY, "history.csv of a motion");
    holds(&LUMPED_HISTORY, "history.csv of a cheaper model");
    holds(&ENERGY, "energy.csv");
}
