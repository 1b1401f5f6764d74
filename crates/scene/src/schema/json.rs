//! Files of keys as JSON Schema, draft 2020-12: what editors complete and check TOML with.

use serde_json::{Map, Value, json};

use super::SCENE;
use crate::optimum::OPTIMISE;
use crate::plan::VARY;
use crate::table::{Key, Table, ValueKind};

/// The schema of the scene file.
///
/// ```
/// let schema = scene::json_schema();
/// assert_eq!(schema["properties"]["operation"]["properties"]["torque_nm"]["minimum"], 0.0);
/// ```
pub fn json_schema() -> Value {
    schema_of(&SCENE, "scene")
}

/// The schema of a kind of file by the table of all of it.
pub(crate) fn schema_of(file: &Table, kind: &str) -> Value {
    let mut schema = object(file);
    // What is asked of it beside a run.
    for (name, task) in [("vary", &VARY), ("optimise", &OPTIMISE)] {
        schema["properties"][name] = object(task);
    }
    if let Value::Object(map) = &mut schema {
        map.insert("$schema".into(), "https://json-schema.org/draft/2020-12/schema".into());
        map.insert("title".into(), format!("ale-gear {kind}, version {}", env!("CARGO_PKG_VERSION")).into());
    }
    schema
}

fn object(table: &Table) -> Value {
    let properties: Map<String, Value> = table.keys.iter().map(|key| (key.name.to_owned(), property(key))).collect();
    let mut object = json!({
        "type": "object",
        "description": table.about,
        "properties": properties,
        "additionalProperties": false,
    });
    if !table.needed.is_empty() {
        object["required"] = table.needed.into();
    }
    object
}

fn property(key: &Key) -> Value {
    let mut property = match &key.kind {
        ValueKind::Number { low, high, default } => {
            let end = |x: &f64| x.is_finite().then(|| Value::from(*x));
            ranged("number", end(low), end(high), default.map(Value::from))
        }
        ValueKind::Whole { low, high, default } => {
            // The largest that the type can hold is no limit of its own.
            let high = (*high < u32::MAX).then(|| Value::from(*high));
            ranged("integer", Some(Value::from(*low)), high, default.map(Value::from))
        }
        ValueKind::Word { choices, first_is_default } => {
            let mut word = json!({ "type": "string", "enum": choices });
            if *first_is_default {
                word["default"] = choices[0].into();
            }
            word
        }
        ValueKind::Words { choices } => json!({ "type": "array", "items": { "type": "string", "enum": choices } }),
        ValueKind::Switch { default } => json!({ "type": "boolean", "default": default }),
        ValueKind::Text => json!({ "type": "string" }),
        ValueKind::Texts => json!({ "type": "array", "items": { "type": "string" } }),
        ValueKind::Numbers => json!({ "type": "array", "items": { "type": "number" } }),
        ValueKind::Wholes => json!({ "type": "array", "items": { "type": "integer" } }),
        ValueKind::Rows { columns: 0 } => {
            json!({ "type": "array", "items": { "type": "array", "items": { "type": "number" } }, "minItems": 1 })
        }
        ValueKind::Rows { columns } => {
            let row =
                json!({ "type": "array", "items": { "type": "number" }, "minItems": columns, "maxItems": columns });
            json!({ "type": "array", "items": row, "minItems": 1 })
        }
        ValueKind::Table(table) => object(table),
        ValueKind::Tables(table) => json!({ "type": "array", "items": object(table) }),
    };
    property["description"] = key.about.into();
    property
}

fn ranged(kind: &str, low: Option<Value>, high: Option<Value>, default: Option<Value>) -> Value {
    let mut schema = json!({ "type": kind });
    for (name, value) in [("minimum", low), ("maximum", high), ("default", default)] {
        if let Some(value) = value {
            schema[name] = value;
        }
    }
    schema
}
