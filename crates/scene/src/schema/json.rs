//! JSON Schema, draft 2020-12, of the files: editors use it to complete and check TOML.

use serde_json::{Map, Value, json};

use super::SCENE;
use crate::gearbox::GEARBOX;
use crate::optimum::{OPTIMISATION, OPTIMISE};
use crate::plan::{PLAN, VARY};
use crate::study::STUDY;
use crate::table::{Key, Table, ValueKind};

/// Documents by what stands at their top: name, the keys of which one at least is there, and the table of all of it. The
/// last one is what none of them is.
pub(crate) static DOCUMENTS: [(&str, &[&str], &Table); 5] = [
    ("gearbox", &["shaft", "gear", "bearing", "input"], &GEARBOX),
    ("study", &["case"], &STUDY),
    ("plan", &["vary"], &PLAN),
    ("optimisation", &["optimise"], &OPTIMISATION),
    ("pair", &[], &SCENE),
];

/// The schema of every document: a pair or a gearbox (which may contain what is varied or optimised), or a plan, an
/// optimisation, a study of other documents. Each is in `$defs` by its name.
///
/// ```
/// let schema = scene::json_schema();
/// let pair = &schema["$defs"]["pair"];
/// assert_eq!(pair["properties"]["operation"]["properties"]["torque_nm"]["minimum"], 0.0);
/// ```
pub fn json_schema() -> Value {
    let of = |(name, _, table): &(&str, &[&str], &Table)| ((*name).to_owned(), object(table));
    let mut all: Map<String, Value> = DOCUMENTS.iter().map(of).collect();
    for machine in ["pair", "gearbox"] {
        for (name, task) in [("vary", &VARY), ("optimise", &OPTIMISE)] {
            all[machine]["properties"][name] = object(task);
        }
    }
    // A pair with [vary] in it is no plan of another document.
    let own = |name: &str| json!({ "required": [name] });
    let chosen = DOCUMENTS.iter().rev().fold(Value::Null, |rest, (name, keys, _)| {
        let document = json!({ "$ref": format!("#/$defs/{name}") });
        match (keys, *name) {
            ([], _) => document,
            ([key], "plan" | "optimisation") => {
                json!({ "if": { "required": [key, "scene"] }, "then": document, "else": rest })
            }
            _ => {
                let any: Vec<Value> = keys.iter().map(|key| own(key)).collect();
                json!({ "if": { "anyOf": any }, "then": document, "else": rest })
            }
        }
    });
    let mut schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": format!("ale-gear document, version {}", env!("CARGO_PKG_VERSION")),
        "description": "What ale-gear runs: a pair of gears, a gearbox, a plan, an optimisation, a study",
        "type": "object",
        "$defs": all,
    });
    if let (Value::Object(schema), Value::Object(chosen)) = (&mut schema, chosen) {
        schema.extend(chosen);
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
        ValueKind::SignedWhole { low, high } => {
            let [low, high] = [*low, *high].map(i64::from);
            let ends = [[low, high], [-high, -low]].map(|[a, b]| json!({ "minimum": a, "maximum": b }));
            json!({ "type": "integer", "anyOf": ends })
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
        ValueKind::Document(of) => json!({ "anyOf": [{ "type": "string" }, object(of)] }),
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
