//! A result with the scene as it was solved.

use serde_json::Value as Json;

use super::Csv;

/// A result with the scene as it was solved.
pub struct Case<'a> {
    /// The scene with every default.
    pub inputs: &'a Json,
    /// Facts of the pair.
    pub summary: &'a Json,
    /// Rows, with columns.
    pub history: &'a Csv,
}

impl Case<'_> {
    /// Word of a key of the scene.
    pub fn word(&self, table: &str, key: &str) -> &str {
        self.inputs[table][key].as_str().unwrap_or_default()
    }

    /// Whether the pair stands still.
    pub fn is_static(&self) -> bool {
        self.word("analysis", "kind") == "static"
    }
}
