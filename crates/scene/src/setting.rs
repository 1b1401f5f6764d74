//! Keys that are set beside a file: `--set key=value`, and studies that vary a key.

use std::ops::Range;

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::SceneError;

/// A key of a scene or a gearbox file with the value that takes the place of the file's.
///
/// The key is written with dots from the top of the file (`operation.torque_nm`, `pinion.modification.tip_relief_um`);
/// a number among its parts counts the entries of a list from 0 (`pinion.shaft.supports.1.stiffness_x_n_per_mm`,
/// `gear.0.position_mm`). The
/// value is TOML; what is no TOML is a text (`contact.method=slice`).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setting {
    label: String,
    key: String,
    value: String,
}

impl Setting {
    /// `key=value` as a user writes it; messages name it `--set KEY`.
    ///
    /// # Errors
    /// [`SceneError::Setting`] where there is no key or the value can be neither TOML nor a bare word.
    pub fn parse(written: &str) -> Result<Self, SceneError> {
        let Some((key, value)) = written.split_once('=') else {
            return Err(complaint(&format!("--set {written}"), "has no `=`"));
        };
        let key = key.trim();
        Self::labelled(format!("--set {key}"), key, value.trim())
    }

    /// The number of a key, for studies that vary it.
    ///
    /// # Errors
    /// [`SceneError::Setting`] where `key` is none.
    pub fn number(key: &str, value: f64) -> Result<Self, SceneError> {
        // Whole numbers without a point serve keys of both kinds.
        let whole = value.fract() == 0.0 && value.abs() < 1e15;
        let written = if whole { format!("{value:.0}") } else { format!("{value:?}").replace("NaN", "nan") };
        Self::labelled(format!("--set {key}"), key, &written)
    }

    /// A key with its value, named by the key in messages.
    ///
    /// # Errors
    /// [`SceneError::NoKey`] where `key` is none.
    pub fn of(key: &str, value: &toml::Value) -> Result<Self, SceneError> {
        match path(key) {
            None => Err(SceneError::NoKey { key: key.to_owned() }),
            Some(_) => Ok(Self { label: key.to_owned(), key: key.to_owned(), value: value.to_string() }),
        }
    }

    /// The same setting, named otherwise in messages: by a word of its own, as `--torque-nm`.
    pub fn called(self, label: &str) -> Self {
        Self { label: label.to_owned(), ..self }
    }

    fn labelled(label: String, key: &str, value: &str) -> Result<Self, SceneError> {
        if path(key).is_none() {
            return Err(complaint(&label, &format!("`{key}` is no key")));
        }
        let value = match toml_value(value) {
            Some(value) => value,
            None => return Err(complaint(&label, &format!("`{value}` is neither a TOML value nor a bare word"))),
        };
        Ok(Self { label, key: key.to_owned(), value })
    }

    /// The key.
    pub fn key(&self) -> &str {
        &self.key
    }

    /// What messages call it.
    pub(super) fn label(&self) -> &str {
        &self.label
    }

    /// The word of a command line that sets it, quoted for a shell.
    pub fn word(&self) -> String {
        format!("--set '{}={}'", self.key, self.value.replace('\'', "'\\''"))
    }

    /// The line of TOML that says it.
    pub(super) fn line(&self) -> String {
        format!("{} = {}", self.key, self.value)
    }
}

fn complaint(label: &str, what: &str) -> SceneError {
    SceneError::Setting { label: label.to_owned(), what: what.to_owned() }
}

/// Parts of a dotted key; `None` where it is none.
pub(super) fn path(key: &str) -> Option<Vec<String>> {
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

/// What the settings of a file take at the most, bytes: each is read as far from the beginning as its line is.
const MOST: usize = 256 << 20;

/// Refuses more settings than any file has keys, which would take memory without bound.
pub(crate) fn few_enough(text: &str, settings: &[Setting]) -> Result<(), SceneError> {
    let length = settings.iter().fold(text.len(), |sum, s| sum.saturating_add(s.key.len() + s.value.len() + 4));
    match settings.last() {
        Some(last) if length.saturating_mul(settings.len()) > MOST => {
            let what = format!("is the last of {} settings, which is more than can be taken in", settings.len());
            Err(complaint(&last.label, &what))
        }
        _ => Ok(()),
    }
}

/// The file's text, and below it a line for each setting, so that every place in either has an offset of its own.
pub(crate) fn below(text: &str, settings: &[Setting]) -> (String, Vec<Range<usize>>) {
    let mut all = text.to_owned();
    let mut ranges = Vec::with_capacity(settings.len());
    for setting in settings {
        all.push('\n');
        let start = all.len();
        all.push_str(&setting.line());
        ranges.push(start..all.len());
    }
    (all, ranges)
}

/// Puts the line at `range` of `text` into the tables of the file.
pub(super) fn put<'i>(root: &mut DeTable<'i>, padded: &'i str, key: &str) -> Result<(), toml::de::Error> {
    let mut table = DeTable::parse(padded)?.into_inner();
    let Some(parts) = path(key) else { return Ok(()) };
    insert(root, &mut table, &parts);
    Ok(())
}

/// Moves the value at `parts` of `from` to the same place of `into`, making tables on the way.
fn insert<'i>(into: &mut DeTable<'i>, from: &mut DeTable<'i>, parts: &[String]) {
    let Some((key, value)) = std::mem::take(from).into_iter().next() else { return };
    match into.get_mut(key.get_ref().as_ref()) {
        Some(there) => replace(there, value, parts.get(1..).unwrap_or_default()),
        None => {
            into.insert(key, value);
        }
    }
}

/// Puts `value`, which lies below `parts` of its own tables, into what is there.
fn replace<'i>(there: &mut Spanned<DeValue<'i>>, value: Spanned<DeValue<'i>>, parts: &[String]) {
    let Some(part) = parts.first() else {
        *there = value;
        return;
    };
    let span = value.span();
    match (there.get_mut(), value.into_inner()) {
        (DeValue::Table(inner), DeValue::Table(mut from)) => insert(inner, &mut from, parts),
        (DeValue::Array(list), DeValue::Table(from)) => {
            let entry = part.parse::<usize>().ok().and_then(|i| list.get_mut(i));
            match (entry, from.into_iter().next()) {
                (Some(entry), Some((_, value))) => replace(entry, value, parts.get(1..).unwrap_or_default()),
                (None, Some((key, value))) => {
                    // No such entry: the complaint about a table where a list is wanted names the setting.
                    let table = DeTable::from_iter([(key, value)]);
                    *there = Spanned::new(span, DeValue::Table(table));
                }
                (_, None) => {}
            }
        }
        (_, value) => *there = Spanned::new(span, value),
    }
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
            assert_eq!(Setting::parse(written).unwrap().value, value, "{written}");
        }
        for wrong in ["a", "=3", "a b=3", "a=", "a=[1", "a=1\nb=2", "a#=3", "[a]b=3", "a..b=3"] {
            assert!(Setting::parse(wrong).is_err(), "`{wrong}` is taken");
        }
    }

    #[test]
    fn settings_without_end_are_refused() {
        let many = vec![Setting::parse("operation.torque_nm=1").unwrap(); 20_000];
        let said = few_enough("", &many).unwrap_err().to_string();
        assert!(said.contains("the last of 20000 settings"), "{said}");
        assert!(few_enough("", &many[..1000]).is_ok());
    }

    #[test]
    fn numbers_of_studies_read_back_to_the_last_bit() {
        for number in [0.1 + 0.2, 1e300, -3.0, 5e-324, 1e16] {
            let value = Setting::number("a", number).unwrap().value;
            assert_eq!(value.parse::<f64>().unwrap().to_bits(), number.to_bits(), "{value}");
        }
    }
}
