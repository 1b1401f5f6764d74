//! Keys that are set in addition to a file: `--set key=value`, and studies that vary a key.

use toml::de::{DeTable, DeValue};

use super::{SceneError, tree::Node};

/// A key of a scene or a gearbox file with a value that replaces that of the file.
///
/// The key is a dotted path from the top of the file (`operation.torque_nm`, `pinion.modification.tip_relief_um`). A
/// number in the path is the index of a list entry from 0 (`pinion.shaft.supports.1.stiffness_x_n_per_mm`,
/// `gear.0.position_mm`); another word is the `name` of an entry (`bearing.left.position_mm`). After
/// `mesh.WHICH.scene.` comes a key of that pair's scene. The value is TOML; other text is taken as a string
/// (`contact.method=slice`).
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    label: String,
    key: String,
    /// The parts of the key.
    path: Vec<String>,
    /// The value as TOML.
    written: String,
    /// What that says; places are those in it.
    value: Node,
}

impl Setting {
    /// Parses `key=value` as a user writes it; messages name it `--set KEY`.
    ///
    /// # Errors
    /// [`SceneError::Setting`] if there is no key, or if the value is neither TOML nor a bare word.
    pub fn parse(written: &str) -> Result<Self, SceneError> {
        let Some((key, value)) = written.split_once('=') else {
            return Err(complaint(&format!("--set {written}"), "has no `=`"));
        };
        let key = key.trim();
        if key.is_empty() {
            return Err(complaint(&format!("--set {written}"), "has no key before `=`"));
        }
        if value.trim().is_empty() {
            return Err(complaint(&format!("--set {key}"), "has no value after `=`"));
        }
        Self::labelled(format!("--set {key}"), key, value.trim())
    }

    /// A numeric value of a key, for studies that vary it.
    ///
    /// # Errors
    /// [`SceneError::Setting`] if `key` is not a key.
    pub fn number(key: &str, value: f64) -> Result<Self, SceneError> {
        // Whole numbers without a point serve keys of both kinds.
        let whole = value.fract() == 0.0 && value.abs() < 1e15;
        let written = if whole { format!("{value:.0}") } else { format!("{value:?}").replace("NaN", "nan") };
        Self::labelled(format!("--set {key}"), key, &written)
    }

    /// A key with its value; messages name the key.
    ///
    /// # Errors
    /// [`SceneError::NoKey`] if `key` is not a key.
    pub fn of(key: &str, value: &toml::Value) -> Result<Self, SceneError> {
        let no_key = || SceneError::NoKey { key: key.to_owned() };
        let path = path(key).ok_or_else(no_key)?;
        let written = value.to_string();
        let value = Node::of_value(&written).map_err(|fault| complaint(key, &fault.message))?;
        Ok(Self { label: key.to_owned(), key: key.to_owned(), path, written, value })
    }

    /// This setting with another name in messages, such as `--torque-nm`.
    pub fn called(self, label: &str) -> Self {
        Self { label: label.to_owned(), ..self }
    }

    fn labelled(label: String, key: &str, value: &str) -> Result<Self, SceneError> {
        let Some(path) = path(key) else {
            let quotes = if key.contains([' ', ',']) {
                "; a name with blanks or commas stands in quotes, as `bearing.\"fast, loose\".position_mm`, or is given by \
                 its number, as `bearing.1.position_mm`"
            } else {
                ""
            };
            return Err(complaint(&label, &format!("unknown key `{key}`{quotes}")));
        };
        let read = toml_value(value).and_then(|written| Some((Node::of_value(&written).ok()?, written)));
        match read {
            Some((value, written)) => Ok(Self { label, key: key.to_owned(), path, written, value }),
            None => Err(complaint(&label, &format!("`{value}` is neither a TOML value nor a bare word"))),
        }
    }

    /// The key.
    pub fn key(&self) -> &str {
        &self.key
    }

    /// What messages call it.
    pub(super) fn label(&self) -> &str {
        &self.label
    }

    /// This setting of what stands below the first `parts` of its key.
    pub(crate) fn below(&self, parts: usize) -> Self {
        let path = self.path[parts..].to_vec();
        Self { key: path.join("."), path, ..self.clone() }
    }

    /// The parts of the key.
    pub(crate) fn path(&self) -> &[String] {
        &self.path
    }

    /// The value; places are those in [`Setting::written`].
    pub(crate) fn value(&self) -> &Node {
        &self.value
    }

    /// The value as TOML.
    pub(super) fn written(&self) -> &str {
        &self.written
    }

    /// The word of a command line that makes this setting, quoted for a shell.
    pub fn word(&self) -> String {
        format!("--set '{}={}'", self.key, self.written.replace('\'', "'\\''"))
    }

    /// The line of TOML that says it.
    pub(super) fn line(&self) -> String {
        format!("{} = {}", self.key, self.written)
    }
}

fn complaint(label: &str, what: &str) -> SceneError {
    SceneError::Setting { label: label.to_owned(), what: what.to_owned() }
}

/// Parts of a dotted key; `None` where it is none.
pub(crate) fn path(key: &str) -> Option<Vec<String>> {
    let line = format!("{key} = 0");
    // A second key in it, or a comment, would say something else.
    if key.contains(['=', '\n', '\r', '#', '[']) {
        return None;
    }
    let mut table = DeTable::parse(&line).ok()?.into_inner();
    let mut parts = Vec::new();
    loop {
        let (key, value) = table.into_iter().next()?;
        parts.push(key.into_inner().into_owned());
        match value.into_inner() {
            DeValue::Table(inner) => table = inner,
            _ => return Some(parts),
        }
    }
}

/// The value as TOML: as it is written, or as a text where it is a bare word.
fn toml_value(written: &str) -> Option<String> {
    let one_line = !written.contains(['\n', '\r']);
    if one_line && DeValue::parse(written).is_ok() {
        return Some(written.to_owned());
    }
    let bare = |c: char| !c.is_control() && !matches!(c, '"' | '\'' | '[' | ']' | '{' | '}' | '=' | '#' | ',');
    (one_line && !written.is_empty() && written.chars().all(bare))
        .then(|| format!("\"{}\"", written.replace('\\', "\\\\")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_numbers_and_lists_are_told_apart() {
        for (written, value) in [
            ("a.b=200", "200"),
            ("a.b = -1e-3", "-1e-3"),
            ("a=slice", "\"slice\""),
            ("a=../meshes/a b.msh", "\"../meshes/a b.msh\""),
            ("a=[1.0, 2.0]", "[1.0, 2.0]"),
            ("a=true", "true"),
            ("a=\"=\"", "\"=\""),
        ] {
            assert_eq!(Setting::parse(written).unwrap().written, value, "{written}");
        }
        for wrong in ["a", "=3", "a b=3", "a=", "a=[1", "a=1\nb=2", "a#=3", "[a]b=3", "a..b=3"] {
            assert!(Setting::parse(wrong).is_err(), "`{wrong}` is taken");
        }
    }

    #[test]
    fn numbers_of_studies_read_back_to_the_last_bit() {
        for number in [0.1 + 0.2, 1e300, -3.0, 5e-324, 1e16] {
            let value = Setting::number("a", number).unwrap().written;
            assert_eq!(value.parse::<f64>().unwrap().to_bits(), number.to_bits(), "{value}");
        }
    }
}
