//! Tables of columns against their names, their units and the document.

use std::{collections::BTreeSet, fs, path::Path};

use answer::{Column, Table, Values};
use columns::{self, ENERGY, LUMPED_HISTORY, MOTION_HISTORY, Rows, STATIC_HISTORY};
use report::pair_files::tables_without_rows;

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

/// What a list in the document is of, and the list.
type Listed = (String, String);

/// The columns of a kind of rows, each once: they are named by their units, and no two share a name.
fn histories() -> Vec<Listed> {
    fn listed<R: Rows>(table: &columns::Table<R>, what: &str) -> Listed {
        let mut names = BTreeSet::new();
        for column in table.columns() {
            assert!(names.insert(column.name), "{what}: two columns `{}`", column.name);
            assert!(column.name.ends_with(ending(column.unit)), "{what}: `{}` is in {}", column.name, column.unit);
        }
        let file = what.split(',').next().unwrap_or(what);
        (what.to_owned(), format!("{}{}", head(file), table.documented().concat()))
    }
    vec![
        listed(&STATIC_HISTORY, "history, a pair at rest"),
        listed(&MOTION_HISTORY, "history, a motion of reduced gears"),
        listed(&LUMPED_HISTORY, "history, a reduced-order model"),
        listed(&ENERGY, "energy"),
    ]
}

fn head(file: &str) -> String {
    format!("| column of `{file}.csv` | unit | meaning |\n|---|---|---|\n")
}

/// Set to 1, the test writes the lists again.
const UPDATE: &str = "UPDATE_OUTPUTS";

/// Numbers of harmonics as `<h>`, of orders as `<n>`.
fn general(name: &str) -> String {
    let mut words: Vec<&str> = name.split('_').collect();
    for k in 1..words.len() {
        if words[k].parse::<u32>().is_ok() {
            words[k] = if words[k - 1] == "harmonic" { "<h>" } else { "<n>" };
        }
    }
    words.join("_")
}

/// The list of a table's columns; columns that differ in a number alone stand once.
fn list(table: &Table) -> String {
    let row = |column: &Column| {
        let unit = match column.values {
            Values::Texts(_) => "text".to_owned(),
            Values::Numbers(_) => column.unit(),
        };
        format!("| `{}` | {unit} | {} |\n", general(&column.name), column.meaning).replace("|  |", "| |")
    };
    let mut rows: Vec<String> = table.columns.iter().map(row).collect();
    rows.dedup();
    format!("{}{}", head(&table.name), rows.concat())
}

/// Every kind of rows is listed column by column, as the program has it.
#[test]
fn the_lists_of_columns_are_up_to_date() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/outputs.md");
    let page = fs::read_to_string(&file).unwrap();
    let mut wanted = page.clone();
    let tables = tables_without_rows();
    for column in tables.iter().flat_map(|table| &table.columns) {
        assert!(!column.meaning.is_empty(), "`{}` has no meaning", column.name);
    }
    let others = tables.iter().map(|table| (table.name.to_string(), list(table)));
    for (what, list) in histories().into_iter().chain(others) {
        let begin = format!("<!-- columns of {what} -->\n");
        let (above, rest) = wanted.split_once(&begin).unwrap_or_else(|| panic!("docs/outputs.md has no {begin}"));
        let (_, below) = rest.split_once("<!-- end -->").unwrap_or_else(|| panic!("{begin} has no end"));
        wanted = format!("{above}{begin}{list}<!-- end -->{below}");
    }
    if std::env::var_os(UPDATE).is_some() {
        fs::write(&file, &wanted).unwrap();
    }
    let differ = page.lines().zip(wanted.lines()).find(|(old, new)| old != new);
    assert!(
        page == wanted,
        "docs/outputs.md is not up to date (written again with {UPDATE}=1, if that was set); first: {differ:?}"
    );
}
