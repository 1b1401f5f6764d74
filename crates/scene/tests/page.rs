//! The tables of `docs/scene.md` are those of the program, as it has them.

use std::{fs, path::Path};

use scene::key_tables;

/// Set to 1, the test writes the tables again.
const UPDATE: &str = "UPDATE_SCENE";

/// The page has every table of keys of every kind of document between marks of its own, to the letter, and no other.
#[test]
fn the_page_has_every_table_of_keys() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scene.md");
    let page = fs::read_to_string(&file).unwrap();
    let tables = key_tables();
    let mut wanted = page.clone();
    for table in &tables {
        let begin = format!("<!-- keys of {} -->\n", table.name);
        let (above, rest) = wanted.split_once(&begin).unwrap_or_else(|| panic!("docs/scene.md has no {begin}"));
        let (_, below) = rest.split_once("<!-- end -->").unwrap_or_else(|| panic!("{begin} has no end"));
        wanted = format!("{above}{begin}{}<!-- end -->{below}", table.markdown);
    }
    assert_eq!(page.matches("<!-- keys of ").count(), tables.len(), "marks on the page and tables of the program");
    if std::env::var_os(UPDATE).is_some() {
        fs::write(&file, &wanted).unwrap();
    }
    let differ = page.lines().zip(wanted.lines()).find(|(old, new)| old != new);
    assert!(
        page == wanted,
        "docs/scene.md is not up to date (written again with {UPDATE}=1, if that was set); first: {differ:?}"
    );
}

/// Every row has a meaning, and no two tables have one name.
#[test]
fn every_key_has_a_meaning() {
    let tables = key_tables();
    for (k, table) in tables.iter().enumerate() {
        assert!(tables[..k].iter().all(|other| other.name != table.name), "two tables {}", table.name);
        let rows: Vec<&str> =
            table.markdown.lines().filter(|line| line.starts_with("| `") || line.starts_with("| **")).collect();
        assert!(!rows.is_empty(), "{} has no keys", table.name);
        for row in rows {
            let meaning = row.trim_end_matches(" |").rsplit("| ").next().unwrap_or_default();
            assert!(row.matches('|').count() == 5 && meaning.len() > 3, "{}: {row}", table.name);
        }
    }
}
