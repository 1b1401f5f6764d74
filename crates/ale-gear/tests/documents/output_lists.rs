//! The lists of columns and keys in docs/outputs.md are those of the program.

use std::collections::BTreeSet;
use std::fs;

use analysis::certificate::{CHECKS, CheckKind};
use answer::{Column, Table, Values, unit_of};
use columns::{self, ENERGY, LUMPED_HISTORY, MOTION_HISTORY, Rows, STATIC_HISTORY};
use described::Key;
use report::{documented_objects, documented_tables};
use scene::{Scene, gearbox::Gearbox};

use crate::quantities::generalised;
use crate::util::repository;

/// Set to 1, the test writes the lists again.
const UPDATE: &str = "UPDATE_OUTPUTS";

/// A list between marks of its own: its mark, and its lines.
type Listed = (String, String);

/// Name of a file or an object in code font, and behind a comma what it is of where several have one name.
fn titled(what: &str, end: &str) -> String {
    let (name, of) = what.split_once(',').map_or((what, String::new()), |(name, of)| (name, format!(",{of}")));
    format!("`{name}{end}`{of}")
}

fn columns_of(what: &str, rows: &str) -> Listed {
    let head = format!("| column of {} | unit | meaning |\n|---|---|---|\n", titled(what, ".csv"));
    (format!("columns of {what}"), head + rows)
}

/// The columns of a kind of rows, each once: they are named by their units, and no two share a name.
fn histories() -> [Listed; 4] {
    fn listed<R: Rows>(table: &columns::Table<R>, what: &str) -> Listed {
        let mut names = BTreeSet::new();
        for column in table.columns() {
            assert!(names.insert(column.name), "{what}: two columns `{}`", column.name);
            assert_eq!(unit_of(column.name), column.unit, "{what}: `{}`", column.name);
        }
        columns_of(what, &table.documented().concat())
    }
    [
        listed(&STATIC_HISTORY, "history, a pair at rest"),
        listed(&MOTION_HISTORY, "history, a motion of reduced gears"),
        listed(&LUMPED_HISTORY, "history, a reduced-order model"),
        listed(&ENERGY, "energy"),
    ]
}

fn line(name: &str, unit: &str, meaning: &str) -> String {
    format!("| `{name}` | {unit} | {meaning} |\n").replace("|  |", "| |")
}

/// Numbers of meshes, orders and the like as `<k>`, `<n>`, `<h>`; both gears as `<gear>` where the columns of both have one meaning.
fn general(column: &Column, table: &Table) -> String {
    let general = generalised(&column.name);
    let Some(rest) = general.strip_prefix("<gear>_") else { return general };
    let gears =
        table.columns.iter().filter(|other| other.meaning == column.meaning && generalised(&other.name) == general);
    let first: BTreeSet<&str> = gears.filter_map(|other| other.name.split('_').next()).collect();
    if first.len() > 1 { general } else { format!("{}_{rest}", first.first().copied().unwrap_or_default()) }
}

/// The list of a table's columns; columns that differ in a number alone stand once.
fn columns_without_rows((what, table): (String, Table)) -> Listed {
    let mut seen = BTreeSet::new();
    let mut rows = String::new();
    for column in &table.columns {
        assert!(!column.meaning.is_empty(), "`{}` has no meaning", column.name);
        let name = general(column, &table);
        let unit = match column.values {
            Values::Texts(_) => "text".to_owned(),
            Values::Numbers(_) | Values::Kept(_) => column.unit(),
        };
        if seen.insert(name.clone()) {
            rows += &line(&name, &unit, &column.meaning);
        }
    }
    columns_of(&what, &rows)
}

/// The list of an object's keys.
fn keys_of((what, keys): (&'static str, Vec<Key>)) -> Listed {
    let head = match what.starts_with("the summary") || what == "every summary" || what == "a certificate" {
        true => "key of `summary.json`".to_owned(),
        false => format!("key of {}", titled(what, "")),
    };
    let written = keys.iter().filter(|key| key.is_written);
    let rows = written.map(|key| {
        assert!(key.meaning().len() > 1, "{what}: `{}` has no meaning", key.name);
        line(key.name, &unit_of(key.name), key.meaning())
    });
    (format!("keys of {what}"), format!("| {head} | unit | meaning |\n|---|---|---|\n{}", rows.collect::<String>()))
}

/// The list of all checks.
fn checks() -> Listed {
    let row =
        |check: &CheckKind| format!("| `{}` | {} | {} | {} |\n", check.name, check.bound, check.of, check.meaning);
    let rows: String = CHECKS.iter().map(row).collect();
    ("checks".to_owned(), format!("| check | bound | of | meaning |\n|---|---|---|---|\n{rows}"))
}

fn all() -> Vec<Listed> {
    let scene = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(100.0);
    let of_gearbox = |name: &str| Gearbox::read(&repository().join("scenes/gearbox").join(name)).unwrap();
    // Columns of rolling bearings and of planets: there are no rows.
    let planets = of_gearbox("planetary_stage.toml").planets;
    let mut gearbox = Gearbox { planets, ..of_gearbox("rolling_bearings.toml") };
    gearbox.meshes[0].scene.output.root_stress = true;
    let tables = documented_tables(&scene.build().unwrap(), &gearbox).unwrap();
    let (of_envelope, keys_of_envelope) = envelope::files::documented();
    let tables = tables.into_iter().chain(of_envelope.into_iter().map(|table| (table.name.to_string(), table)));
    let objects = documented_objects(&gearbox).into_iter().chain(keys_of_envelope);
    histories()
        .into_iter()
        .chain(tables.map(columns_without_rows))
        .chain(objects.map(keys_of))
        .chain([checks()])
        .collect()
}

/// The page has every list between marks of its own, to the letter, and no other.
#[test]
fn the_lists_of_columns_and_keys_are_up_to_date() {
    let file = repository().join("docs/outputs.md");
    let page = fs::read_to_string(&file).unwrap();
    let mut wanted = page.clone();
    let all = all();
    for (what, list) in &all {
        let begin = format!("<!-- {what} -->\n");
        let (above, rest) = wanted.split_once(&begin).unwrap_or_else(|| panic!("docs/outputs.md has no {begin}"));
        let (_, below) = rest.split_once("<!-- end -->").unwrap_or_else(|| panic!("{begin} has no end"));
        wanted = format!("{above}{begin}{list}<!-- end -->{below}");
    }
    assert_eq!(page.matches("<!-- end -->").count(), all.len(), "marks on the page and lists of the program");
    if std::env::var_os(UPDATE).is_some() {
        fs::write(&file, &wanted).unwrap();
    }
    let differ = page.lines().zip(wanted.lines()).find(|(old, new)| old != new);
    assert!(
        page == wanted,
        "docs/outputs.md is not up to date (written again with {UPDATE}=1, if that was set); first: {differ:?}"
    );
}

/// A reader needs no other line to understand a meaning, and no two objects have one name.
#[test]
fn every_meaning_stands_by_itself() {
    let all = all();
    let mut names = BTreeSet::new();
    let mut faults = Vec::new();
    for (what, list) in &all {
        assert!(names.insert(what), "two lists {what}");
        for row in list.lines().skip(2) {
            let meaning = row.trim_end_matches(" |").rsplit("| ").next().unwrap_or_default();
            let leans = ["the same", "its ", "of the ", "of all ", "as above", "likewise"];
            if leans.iter().any(|word| meaning.to_lowercase().starts_with(word)) || meaning.contains("as above") {
                faults.push(format!("{what}: {row}"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
