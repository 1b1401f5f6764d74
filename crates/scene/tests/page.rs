//! The tables of `docs/scene.md` against the table of keys: which keys a table has, their defaults, ranges and words.

use std::path::Path;

use scene::json_schema;
use serde_json::Value;

/// The schema of a table by its name with dots.
fn table(schema: &Value, name: &str) -> Value {
    name.split('.').fold(schema.clone(), |at, part| {
        let inner = at["properties"][part].clone();
        if inner["items"].is_object() { inner["items"].clone() } else { inner }
    })
}

/// Texts between backticks.
fn code(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

/// Tables that a heading or the beginning of a paragraph names: `[pinion.body]`.
fn tables_named(line: &str) -> Option<Vec<String>> {
    let heading = line.starts_with('#');
    let head = if heading { line } else { line.strip_prefix("`[").map(|_| line.split(':').next().unwrap_or(line))? };
    Some(code(head).filter(|c| c.starts_with('[')).map(|c| c.trim_matches(['[', ']']).to_owned()).collect())
}

fn cells(line: &str) -> Vec<&str> {
    line.trim().trim_matches('|').split('|').map(str::trim).collect()
}

/// The number that a text begins with.
fn number(text: &str) -> Option<f64> {
    text.split([' ', ',', ';']).next()?.parse().ok()
}

/// What is wrong with the default that the page gives; a key without a fixed one has no number there.
fn default_fault(property: &Value, cell: &str) -> Option<String> {
    let plain = cell.trim_matches('`');
    let agrees = match &property["default"] {
        Value::Null => plain.parse::<f64>().is_err(),
        Value::Number(wanted) => number(plain) == wanted.as_f64(),
        Value::Bool(wanted) => plain.starts_with(&wanted.to_string()),
        Value::String(wanted) => code(cell).next() == Some(&format!("\"{wanted}\"")),
        _ => false,
    };
    (!agrees).then(|| format!("default `{cell}`, the table of keys has {}", property["default"]))
}

/// What is wrong with the range or the words that the page allows.
fn range_fault(property: &Value, cell: &str) -> Option<String> {
    let ends: Vec<Option<f64>> = cell.split(" .. ").map(|end| end.parse().ok()).collect();
    if let [Some(low), Some(high)] = ends[..] {
        let known = [property["minimum"].as_f64(), property["maximum"].as_f64()];
        return (known != [Some(low), Some(high)]).then(|| format!("range {cell}, the table of keys has {known:?}"));
    }
    let words: Vec<&str> = code(cell).filter_map(|c| c.strip_prefix('"')?.strip_suffix('"')).collect();
    let known: Vec<&str> = property["enum"].as_array()?.iter().filter_map(Value::as_str).collect();
    let agrees = words.is_empty() || (words.len() == known.len() && words.iter().all(|w| known.contains(w)));
    (!agrees).then(|| format!("words {words:?}, the table of keys has {known:?}"))
}

/// A key that stands in a table of the page stands in that table of the scene, with the same default, range and words.
#[test]
fn the_page_has_the_defaults_and_ranges_of_the_table_of_keys() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
    let page = std::fs::read_to_string(top.join("docs/scene.md")).unwrap();
    let scene_part = page.split("\n# The study file").next().unwrap();
    let schema = json_schema()["$defs"]["pair"].take();
    let (mut tables, mut columns, mut faults, mut seen) = (Vec::new(), Vec::new(), Vec::new(), 0);
    for (i, line) in scene_part.lines().enumerate() {
        tables = tables_named(line).unwrap_or(tables);
        if !line.starts_with('|') {
            columns.clear();
        } else if columns.is_empty() {
            columns = cells(line).into_iter().map(str::to_owned).collect();
        } else if columns[0] == "key" && !tables.is_empty() && !line.starts_with("|---") {
            let row = cells(line);
            let of = |name: &str| columns.iter().position(|c| c == name).and_then(|c| row.get(c)).copied();
            // Lists of tables have a row of their own that names no key.
            let keys: Vec<&str> = code(row[0]).filter(|c| !c.starts_with('[')).collect();
            // Several keys in one row have one default and one range, or one each.
            let own = |cell: Option<&str>, k: usize| -> Option<String> {
                let parts: Vec<&str> = cell?.split(", ").collect();
                Some(if parts.len() == keys.len() { parts[k] } else { cell? }.to_owned())
            };
            for (k, key) in keys.iter().enumerate() {
                // Where a heading names several tables, keys bear the name of theirs.
                let (whose, key) = key.rsplit_once('.').map_or((None, *key), |(table, key)| (Some(table), key));
                let named = tables.iter().map(String::as_str).filter(|t| whose.is_none_or(|whose| whose == *t));
                let found = named.map(|t| table(&schema, t)["properties"][key].clone()).find(|p| !p.is_null());
                let Some(property) = found else {
                    faults.push(format!("docs/scene.md:{}: `{key}` is no key of {tables:?}", i + 1));
                    continue;
                };
                let default = own(of("default"), k).and_then(|d| default_fault(&property, &d));
                let range = own(of("allowed").or(of("range")), k).and_then(|r| range_fault(&property, &r));
                faults
                    .extend(default.into_iter().chain(range).map(|f| format!("docs/scene.md:{}: `{key}`: {f}", i + 1)));
                seen += 1;
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(seen >= 140, "only {seen} keys in the tables of docs/scene.md");
}
