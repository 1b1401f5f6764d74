//! Tables of keys as Markdown, for `docs/scene.md`.

use crate::{
    schema::DOCUMENTS,
    table::{Key, Table, ValueKind},
};

/// A table of keys in a kind of document.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyTable {
    /// Document and table: `pair`, `pair pair.misalignment`, `gearbox shaft.section`.
    pub name: String,
    /// Subject of the table, then one row per key: name, default, permitted values, meaning.
    pub markdown: String,
}

/// All tables of keys of every kind of document, each once. Tables with the same keys (`[pinion.mesher]`,
/// `[wheel.mesher]`) are merged; a table whose keys its parent table has as well becomes a row of the parent.
///
/// ```
/// let tables = scene::key_tables();
/// let pair = tables.iter().find(|table| table.name == "pair pair").unwrap();
/// assert!(pair.markdown.contains("| **`normal_module_mm`** | | 0.01 .. 200 | normal module, mm |"));
/// ```
pub fn key_tables() -> Vec<KeyTable> {
    DOCUMENTS.iter().flat_map(|(kind, _, file)| of_document(kind, file)).collect()
}

fn of_document(kind: &str, file: &'static Table) -> Vec<KeyTable> {
    let mut found: Vec<(Vec<String>, &'static Table)> = Vec::new();
    let mut rows_of_others: Vec<&'static Table> = Vec::new();
    file.walk("", &mut |path, table| {
        rows_of_others.extend(inner(table).filter(|of| has_all(table, of)));
        if rows_of_others.iter().any(|other| std::ptr::eq(*other, table)) {
            return;
        }
        match found.iter_mut().find(|(_, other)| has_all(other, table) && has_all(table, other)) {
            Some((paths, _)) => paths.push(path.to_owned()),
            None => found.push((vec![path.to_owned()], table)),
        }
    });
    let one = |(paths, table): (Vec<String>, &'static Table)| KeyTable {
        name: format!("{kind} {}", paths[0].trim_matches(['[', ']'])).trim_end().to_owned(),
        markdown: markdown(&paths, table),
    };
    found.into_iter().map(one).collect()
}

/// Tables that stand in a table, once each.
fn inner(table: &'static Table) -> impl Iterator<Item = &'static Table> {
    table.keys.iter().filter_map(|key| match key.kind {
        ValueKind::Table(of) => Some(of),
        _ => None,
    })
}

/// Whether a table has all keys of another one, with the same meanings.
fn has_all(table: &Table, other: &Table) -> bool {
    other.keys.iter().all(|key| table.keys.iter().any(|own| own.name == key.name && own.about == key.about))
}

fn markdown(paths: &[String], table: &'static Table) -> String {
    let names: Vec<String> = paths.iter().map(|path| format!("`[{path}]`")).collect();
    let whole = paths[0].is_empty();
    let head =
        if whole { "At the top of the file".to_owned() } else { format!("{}: {}", names.join(", "), table.about) };
    let rows: String = table.keys.iter().filter_map(|key| row(table, key)).collect();
    format!("{head}.\n\n| key | default | allowed | meaning |\n|---|---|---|---|\n{rows}").replace("|  |", "| |")
}

/// The row of a key; tables have rows of their own, but for those whose keys are the same.
fn row(table: &'static Table, key: &'static Key) -> Option<String> {
    let name = format!("`{}`", key.name);
    let name = if table.needed.contains(&key.name) { format!("**{name}**") } else { name };
    let (meaning, said) = key.meaning_and_default();
    let default = said.map_or_else(|| default(&key.kind), str::to_owned);
    let allowed = match &key.kind {
        ValueKind::Table(of) if !has_all(table, of) => return None,
        ValueKind::Tables(_) => return None,
        ValueKind::Table(_) => "table with these keys".to_owned(),
        kind => allowed(kind),
    };
    Some(format!("| {name} | {default} | {allowed} | {meaning} |\n").replace("|  |", "| |").replace("|  |", "| |"))
}

/// What holds where nothing is written, if that is one value.
fn default(kind: &ValueKind) -> String {
    match *kind {
        ValueKind::Number { default: Some(default), .. } => plain(default),
        ValueKind::Whole { default: Some(default), .. } => plain(f64::from(default)),
        ValueKind::Word { choices, first_is_default: true } => quoted(choices[0]),
        ValueKind::Switch { default } => format!("`{default}`"),
        _ => String::new(),
    }
}

/// What may stand behind a key.
fn allowed(kind: &ValueKind) -> String {
    let words = |choices: &[&str]| choices.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(", ");
    match kind {
        ValueKind::Number { low, high, .. } => range(*low, *high),
        ValueKind::Whole { low, high, .. } => {
            // The largest that the type can hold is no limit of its own.
            let high = if *high == u32::MAX { f64::INFINITY } else { f64::from(*high) };
            range(f64::from(*low), high)
        }
        ValueKind::SignedWhole { low, high } => {
            let [low, high] = [*low, *high].map(f64::from);
            format!("{} or {}", range(low, high), range(-high, -low))
        }
        ValueKind::Word { choices, .. } => words(choices),
        ValueKind::Words { choices } => format!("list of {}", words(choices)),
        ValueKind::Switch { .. } => "`true`, `false`".to_owned(),
        ValueKind::Text => "text".to_owned(),
        ValueKind::Texts => "list of texts".to_owned(),
        ValueKind::Numbers => "list of numbers".to_owned(),
        ValueKind::Wholes => "list of whole numbers".to_owned(),
        ValueKind::Rows { columns: 0 } => "rows of numbers".to_owned(),
        ValueKind::Rows { columns } => format!("rows of {columns} numbers"),
        ValueKind::Document(_) => "path in quotes, or tables".to_owned(),
        ValueKind::Table(_) | ValueKind::Tables(_) => String::new(),
    }
}

/// Both ends; an infinite one depends on the rest of the document, as the meaning says.
fn range(low: f64, high: f64) -> String {
    match (low.is_finite(), high.is_finite()) {
        (true, true) => format!("{} .. {}", plain(low), plain(high)),
        (true, false) => format!("from {}", plain(low)),
        _ => "number".to_owned(),
    }
}

fn quoted(word: &str) -> String {
    format!("`\"{word}\"`")
}

/// A number as a person writes it: 7850, 1e15, 2.06e5.
fn plain(x: f64) -> String {
    if x == 0.0 || (1e-3..1e5).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}
