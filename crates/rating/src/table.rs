//! Tables of named rows in TOML: materials, lubricants.

use serde::de::DeserializeOwned;

use crate::RatingError;

/// Rows of `[[KEY]]` of a TOML text, each with a name of its own.
pub(crate) fn rows<T: DeserializeOwned>(
    text: &str,
    key: &'static str,
    name: impl Fn(&T) -> &str,
) -> Result<Vec<T>, RatingError> {
    let refused = |line: usize, what: String| RatingError::Table { line, what };
    let mut table: toml::Table = toml::from_str(text).map_err(|e| {
        let line = e.span().map_or(0, |span| 1 + text[..span.start.min(text.len())].matches('\n').count());
        refused(line, e.message().to_owned())
    })?;
    if let Some(other) = table.keys().find(|other| *other != key) {
        return Err(refused(0, format!("unknown key `{other}`, the file holds `[[{key}]]` tables")));
    }
    let Some(toml::Value::Array(list)) = table.remove(key) else {
        return Err(refused(0, format!("the file has no `[[{key}]]` table")));
    };
    let mut all: Vec<T> = Vec::with_capacity(list.len());
    for (k, value) in list.into_iter().enumerate() {
        let row: T = value
            .try_into()
            .map_err(|e: toml::de::Error| refused(0, format!("`[[{key}]]` number {}: {}", k + 1, e.message())))?;
        if all.iter().any(|known| name(known) == name(&row)) {
            return Err(refused(0, format!("`[[{key}]]` \"{}\" stands twice", name(&row))));
        }
        all.push(row);
    }
    Ok(all)
}
