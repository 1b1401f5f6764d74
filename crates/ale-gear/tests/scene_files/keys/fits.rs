//! As much of JSON Schema as the scene's schema uses; what else stands in it fails the test.

use serde_json::Value;

/// Words that say nothing about validity.
const NOTES: [&str; 4] = ["$schema", "title", "description", "default"];

/// Whether a value fits a schema, and where it does not.
pub fn fits(schema: &Value, value: &Value) -> Result<(), String> {
    at(&schema["$defs"], "", schema, value)
}

/// `defs`: schemas that others refer to.
fn at(defs: &Value, path: &str, schema: &Value, value: &Value) -> Result<(), String> {
    let rules = schema.as_object().ok_or("a schema is an object")?;
    for (rule, wanted) in rules {
        let broken = || Err(format!("{path}: {value} breaks {rule} {wanted}"));
        let fine = match rule.as_str() {
            note if NOTES.contains(&note) => true,
            "properties" | "additionalProperties" | "items" => {
                inner(defs, path, rule, wanted, rules, value)?;
                true
            }
            "$defs" | "then" | "else" => true,
            "$ref" => {
                let name = wanted.as_str().and_then(|name| name.strip_prefix("#/$defs/"));
                at(defs, path, &defs[name.ok_or("a reference goes to $defs")?], value)?;
                true
            }
            "if" => {
                let held = at(defs, path, wanted, value).is_ok();
                let rest = schema.get(if held { "then" } else { "else" });
                rest.map_or(Ok(()), |rest| at(defs, path, rest, value))?;
                true
            }
            "anyOf" => {
                let all: Vec<_> = wanted.as_array().into_iter().flatten().map(|s| at(defs, path, s, value)).collect();
                if all.iter().all(Result::is_err) {
                    return all.into_iter().next_back().unwrap_or(Ok(()));
                }
                true
            }
            "type" => is_of(value, wanted.as_str().unwrap_or_default()),
            "enum" => wanted.as_array().is_some_and(|all| all.contains(value)),
            // A value of another type is told of by `type`.
            "minimum" => !value.is_number() || value.as_f64() >= wanted.as_f64(),
            "maximum" => !value.is_number() || value.as_f64() <= wanted.as_f64(),
            "minItems" => value.as_array().map(|a| a.len() as u64) >= wanted.as_u64(),
            "maxItems" => value.as_array().map(|a| a.len() as u64) <= wanted.as_u64(),
            "required" => wanted
                .as_array()
                .is_some_and(|all| all.iter().all(|k| !value[k.as_str().unwrap_or_default()].is_null())),
            other => return Err(format!("{path}: the test knows no rule `{other}`")),
        };
        if !fine {
            return broken();
        }
    }
    Ok(())
}

fn inner(
    defs: &Value,
    path: &str,
    rule: &str,
    wanted: &Value,
    rules: &serde_json::Map<String, Value>,
    value: &Value,
) -> Result<(), String> {
    match (rule, value) {
        ("properties", Value::Object(map)) => map
            .iter()
            .filter(|(k, _)| !wanted[k.as_str()].is_null())
            .try_for_each(|(k, v)| at(defs, &format!("{path}.{k}"), &wanted[k.as_str()], v)),
        ("additionalProperties", Value::Object(map)) if *wanted == false => {
            match map.keys().find(|k| rules["properties"][k.as_str()].is_null()) {
                Some(unknown) => Err(format!("{path}: `{unknown}` is no property")),
                None => Ok(()),
            }
        }
        ("items", Value::Array(list)) => {
            list.iter().enumerate().try_for_each(|(i, v)| at(defs, &format!("{path}[{i}]"), wanted, v))
        }
        _ => Ok(()),
    }
}

fn is_of(value: &Value, kind: &str) -> bool {
    match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        _ => false,
    }
}
