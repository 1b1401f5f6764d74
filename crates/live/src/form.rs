//! All keys of a scene at rest as a form, from the schema.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;

/// Tables of motions and of cheaper models, which a page of a pair at rest has nothing to show of. In the text of a
/// scene they may stand.
const NOT_AT_REST: [&str; 14] = [
    "body", "bearing", "shaft", "drive", "load", "modes", "motion", "mesh", "lumped8", "lumped12", "impact", "shaft18",
    "vary", "optimise",
];

/// A table of the scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct FormTable {
    /// With dots; empty for the scene itself.
    pub path: String,
    pub about: String,
    pub rows: Vec<FormRow>,
    pub tables: Vec<FormTable>,
}

/// A key of a table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct FormRow {
    /// With dots.
    pub key: String,
    pub name: String,
    pub about: String,
    /// `number`, `text`, `list`, or `choice`.
    pub kind: &'static str,
    /// Words of a choice.
    pub choices: Vec<String>,
    /// What holds where nothing is written, if that is one number or word.
    pub default: String,
    pub needed: bool,
}

/// The form of the whole scene.
pub(crate) fn form() -> FormTable {
    let order: BTreeMap<String, usize> = scene::all_keys().into_iter().zip(0..).collect();
    table("", &scene::json_schema()["$defs"]["pair"], &order)
}

/// Whether a key holds a text, so that digits in it are no number.
pub(crate) fn is_text(schema: &Value, key: &str) -> bool {
    let found = key.split('.').try_fold(schema, |at, part| at.get("properties")?.get(part));
    found.is_some_and(|property| property["type"] == "string")
}

fn table(path: &str, schema: &Value, order: &BTreeMap<String, usize>) -> FormTable {
    let needed: Vec<&str> = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    let (mut rows, mut tables) = (Vec::new(), Vec::new());
    for (name, property) in schema["properties"].as_object().into_iter().flatten() {
        let key = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        // A mesh file of a gear is a key, the mesh of a cheaper model a table.
        let is_table = property["type"] == "object";
        if is_table && !NOT_AT_REST.contains(&name.as_str()) {
            tables.push(table(&key, property, order));
        } else if let (false, Some(kind)) = (is_table, kind(property)) {
            let words = if property["type"] == "boolean" {
                vec!["true".to_owned(), "false".to_owned()]
            } else {
                property["enum"].as_array().into_iter().flatten().filter_map(Value::as_str).map(str::to_owned).collect()
            };
            rows.push(FormRow {
                needed: needed.contains(&name.as_str()),
                name: name.clone(),
                about: string(&property["description"]),
                kind: if words.is_empty() { kind } else { "choice" },
                choices: words,
                default: string(&property["default"]),
                key,
            });
        }
    }
    rows.sort_by_key(|row| order.get(&row.key).copied().unwrap_or(usize::MAX));
    let first = |table: &FormTable| {
        let within = order.iter().filter(|(key, _)| key.starts_with(&format!("{}.", table.path)));
        within.map(|(_, at)| *at).min().unwrap_or(usize::MAX)
    };
    tables.sort_by_key(first);
    FormTable { path: path.to_owned(), about: string(&schema["description"]), rows, tables }
}

/// What a property is in the form; lists of tables stand in the text alone.
fn kind(property: &Value) -> Option<&'static str> {
    match property["type"].as_str()? {
        "number" | "integer" => Some("number"),
        "string" => Some("text"),
        "boolean" => Some("choice"),
        "array" => (property["items"]["type"] != "object").then_some("list"),
        _ => None,
    }
}

fn string(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Null => String::new(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(table: &FormTable) -> Vec<String> {
        let own = table.rows.iter().map(|row| row.key.clone());
        own.chain(table.tables.iter().flat_map(keys)).collect()
    }

    /// Every key of the schema is in the form but those of motions and of cheaper models, and no others.
    #[test]
    fn the_form_has_the_keys_of_a_scene_at_rest() {
        let form = form();
        let at_rest = |key: &&String| {
            let tables = &key.split('.').rev().skip(1).collect::<Vec<_>>()[..];
            !tables.iter().any(|part| NOT_AT_REST.contains(part))
        };
        let mut wanted: Vec<String> = scene::all_keys().iter().filter(at_rest).cloned().collect();
        let mut found = keys(&form);
        wanted.sort();
        found.sort();
        assert_eq!(found, wanted);
        assert!(found.len() > 100, "{} keys", found.len());
    }

    #[test]
    fn keys_come_in_the_order_of_the_documents() {
        let form = form();
        let names: Vec<&str> = form.tables.iter().map(|t| t.path.as_str()).collect();
        assert_eq!(
            names,
            ["pinion", "wheel", "pair", "material", "operation", "contact", "analysis", "accuracy", "rating", "output"]
        );
        assert_eq!(form.tables[0].rows[0].key, "pinion.teeth");
        assert!(form.tables[0].rows[0].needed && form.tables[0].rows[0].kind == "number");
        let schema = scene::json_schema()["$defs"]["pair"].clone();
        assert!(is_text(&schema, "name") && is_text(&schema, "pinion.mesh") && !is_text(&schema, "pinion.teeth"));
        assert!(!is_text(&schema, "no.such.key"));
    }
}
