//! `ale-gear schema`: the scene file for editors.

use crate::scene::json_schema;

/// JSON Schema of the scene file.
pub(super) fn execute() -> String {
    format!("{:#}\n", json_schema())
}
