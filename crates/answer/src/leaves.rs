//! The values of a tree of JSON, each with its path.

use serde_json::Value;

/// Bytes of a path that is shown: those of this program are far shorter, and a table has a column as wide as the longest.
const LONGEST: usize = 200;

/// Visits every leaf of a JSON value with its path: `a.b`, `a[1]`; what lies at a path longer than 200 bytes is left out.
pub fn leaves(path: &str, value: &Value, visit: &mut impl FnMut(&str, &Value)) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                if path.len() + key.len() < LONGEST {
                    let inner = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                    leaves(&inner, value, visit);
                }
            }
        }
        Value::Array(list) => {
            for (i, value) in list.iter().enumerate() {
                leaves(&format!("{path}[{i}]"), value, visit);
            }
        }
        leaf => visit(path, leaf),
    }
}
