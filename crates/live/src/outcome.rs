//! What is shown of a solved document.

use export::view::View;
use report::charts::{FieldMap, Plot};
use serde::Serialize;

/// What is shown of a solved document.
#[derive(Debug, Serialize)]
pub(crate) struct Outcome<'a> {
    pub name: &'a str,
    pub solve_ms: f64,
    pub headline: serde_json::Value,
    /// Some of it in words.
    pub glance: Vec<[String; 2]>,
    pub charts: Vec<Plot>,
    pub maps: Vec<FieldMap<'static>>,
    /// The gears in space, of a pair.
    pub view: Option<View>,
    pub remarks: Vec<String>,
}
