//! All that a run answers.

use serde::Serialize;
use serde_json::{Map, Value};

use crate::{Checks, Cost, Remark, Table};

/// The answer to one question, whatever its kind.
#[derive(Debug, Clone, Default)]
pub struct Answer {
    /// Kind of question that it answers: `pair`, `gearbox`, `plan`, `study`, `optimum`, `chart`, `envelope`,
    /// `comparison`. Answers of one kind can be compared.
    pub kind: &'static str,
    /// Name of the document, for titles.
    pub name: String,
    /// The document with every default written out.
    pub inputs: Value,
    /// Rows.
    pub tables: Vec<Table>,
    /// The numbers that most people want, by key with unit.
    pub headline: Value,
    /// What was demanded, and what was found.
    pub checks: Checks,
    /// Remarks for the user.
    pub remarks: Vec<Remark>,
    /// Facts about the run, by key with unit.
    pub info: Map<String, Value>,
    /// Time and memory.
    pub cost: Cost,
}

impl Answer {
    /// The table of that name.
    pub fn table(&self, name: &str) -> Option<&Table> {
        self.tables.iter().find(|table| table.name == name)
    }
}

/// An object as its keys with their values.
pub fn keyed(of: &impl Serialize) -> Map<String, Value> {
    // Strings, numbers, lists and objects, all keys are strings: there is nothing that JSON could refuse.
    match serde_json::to_value(of) {
        Ok(Value::Object(map)) => map,
        _ => Map::new(),
    }
}
