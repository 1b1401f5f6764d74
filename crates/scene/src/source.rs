//! The text behind the words: lines, keys, and complaints that name them.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use toml::Spanned;

use super::excerpt::excerpt;
use super::hints;
use super::keys::{self, Tables};
use super::origin::Origin;
use super::setting::Setting;
use super::spanned::{Number, Switch, Whole, Word, Words};
use super::table::{Choice, Table};
use super::{Line, Place, error::SceneError};

/// The text of a scene, or of another file of tables, and the name that messages give it.
pub struct Source<'a> {
    /// As the user named it.
    pub file: &'a Path,
    /// The file's text, and a line for each setting below it.
    pub(crate) text: &'a str,
    /// What was set beside the file.
    pub(crate) settings: &'a [Setting],
    /// Where in the text.
    pub(crate) ranges: &'a [Range<usize>],
    tables: Tables,
    /// What a key means.
    meaning: fn(&str) -> Option<&'static str>,
    /// Where files that it names are looked for.
    pub(crate) origin: Origin,
    /// Names and texts of files beside it that are not written yet.
    pub(crate) beside: &'a [(String, String)],
    /// Texts of the data files that it names, as far as they were read.
    pub(crate) data_files: RefCell<BTreeMap<PathBuf, Arc<str>>>,
}

impl<'a> Source<'a> {
    /// The text of a file of these tables. Hints tell no meanings: a key of a scene that has its name means something else.
    pub fn of(file: &'a Path, text: &'a str, tables: Tables) -> Self {
        let (origin, beside): (_, &[_]) = (Origin::Disk, &[]);
        Self {
            file,
            text,
            settings: &[],
            ranges: &[],
            tables,
            meaning: |_| None,
            origin,
            beside,
            data_files: RefCell::default(),
        }
    }

    /// The same file with what its keys mean.
    pub(crate) fn with_meanings(self, meaning: fn(&str) -> Option<&'static str>) -> Self {
        Self { meaning, ..self }
    }

    /// The same file with what was set beside it: a line of the text each, at these ranges.
    pub(crate) fn with_settings(self, settings: &'a [Setting], ranges: &'a [Range<usize>]) -> Self {
        Self { settings, ranges, ..self }
    }

    /// The same file, those that it names being looked for there.
    pub(super) fn standing(self, origin: Origin) -> Self {
        Self { origin, ..self }
    }

    /// The same file with names and texts of files beside it that are not written yet.
    pub(crate) fn with_beside(self, beside: &'a [(String, String)]) -> Self {
        Self { beside, ..self }
    }
}

impl Source<'_> {
    /// File and line of a byte range, or the setting that it lies in.
    pub fn place(&self, span: &Range<usize>) -> Place {
        // Its end too, where something is missing.
        let within = |r: &Range<usize>| (r.start..=r.end).contains(&span.start);
        if let Some(setting) = self.ranges.iter().position(within).and_then(|i| self.settings.get(i)) {
            return Place::Setting { label: setting.label().into() };
        }
        let end = span.start.min(self.text.len());
        let number = 1 + self.text.as_bytes()[..end].iter().filter(|&&b| b == b'\n').count();
        let excerpt = excerpt(self.text, span, number);
        Place::Line(Arc::new(Line { file: self.file.to_owned(), number, excerpt }))
    }

    /// A complaint about words that each are right and do not go together.
    pub fn conflict(&self, span: &Range<usize>, what: impl Into<String>, advice: impl Into<String>) -> SceneError {
        SceneError::Conflict { place: self.place(span), what: what.into(), advice: advice.into() }
    }

    /// A message of the TOML reader in this program's words.
    pub fn explain(&self, message: &str, span: Option<Range<usize>>) -> SceneError {
        let span = span.unwrap_or(0..0);
        let place = self.place(&span);
        if let Some(rest) = message.strip_prefix("unknown field ") {
            let mut words = rest.split('`').skip(1).step_by(2);
            let key = words.next().unwrap_or_default().to_owned();
            let here: Vec<&str> = words.collect();
            let advice = keys::advice(self.tables, &key, &here);
            return SceneError::UnknownKey { place, key, advice };
        }
        let typed = message.strip_prefix("invalid type: ").or(message.strip_prefix("invalid value: "));
        if let Some((found, expected)) = typed.and_then(|rest| rest.rsplit_once(", expected ")) {
            let expected = match expected {
                "f64" => "a number".into(),
                "i64" => "a whole number".into(),
                "a boolean" => "true or false".into(),
                e if e.contains("string") => "a text in quotes".into(),
                e if e.starts_with("struct") || e.contains("map") => "a table".into(),
                e if e.contains("sequence") => "a list".into(),
                e => e.to_owned(),
            };
            let key = self.key_before(span.start);
            let found = hints::found(found);
            let advice = hints::of_type(&key, &expected, &found);
            return SceneError::WrongType { place, key, expected, found, advice };
        }
        // Only the first line: the reader's own excerpts are for its own layout.
        let mut message = message.lines().next().unwrap_or("not readable").to_owned();
        let advice = hints::of_syntax(self.text, &span, &message);
        if message == "duplicate key" {
            message = format!("`{}` is there twice", self.text.get(span).unwrap_or_default());
        }
        if hints::is_nesting(&message) {
            message = "tables, lists or the parts of a key are nested too deep".into();
        }
        SceneError::Syntax { place, message, advice }
    }

    /// The key whose value begins at `at`; for a list or a table the one it belongs to.
    fn key_before(&self, at: usize) -> String {
        let before = self.text.get(..at).unwrap_or(self.text);
        let line = before.rsplit('\n').next().unwrap_or_default();
        let Some((left, _)) = line.rsplit_once('=') else {
            // The value is a table of its own: `[pinion]` where a number was wanted.
            let whole = self.text.get(at..).unwrap_or_default().lines().next().unwrap_or_default();
            let name = format!("{line}{whole}");
            let name = name.split('=').next().unwrap_or_default();
            return name.trim().trim_matches(['[', ']']).to_owned();
        };
        let is_key = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.');
        left.trim_end().rsplit(|c| !is_key(c)).next().unwrap_or_default().to_owned()
    }

    /// The number of `key`, or `default`, within `low..=high`.
    pub fn number(&self, key: &str, value: &Number, default: f64, low: f64, high: f64) -> Result<f64, SceneError> {
        self.within(key, value, default, [low, high], (self.meaning)(key))
    }

    /// The same of a key that means `about`.
    fn within(
        &self,
        key: &str,
        value: &Number,
        default: f64,
        [low, high]: [f64; 2],
        about: Option<&str>,
    ) -> Result<f64, SceneError> {
        let Some(value) = value else { return Ok(default) };
        let number = *value.get_ref();
        if (low..=high).contains(&number) {
            return Ok(number);
        }
        let advice = hints::of_number(key, number, [low, high]);
        Err(self.out_of_range(key, value, (format!("{low} .. {high}"), advice), about))
    }

    /// The whole number of `key`, or `default`, within `low..=high`.
    pub fn whole(&self, key: &str, value: &Whole, default: u32, low: u32, high: u32) -> Result<u32, SceneError> {
        let Some(value) = value else { return Ok(default) };
        match u32::try_from(*value.get_ref()) {
            Ok(number) if (low..=high).contains(&number) => Ok(number),
            _ => {
                let advice = hints::of_number(key, *value.get_ref() as f64, [low, high].map(f64::from));
                Err(self.out_of_range(key, value, (format!("{low} .. {high}"), advice), (self.meaning)(key)))
            }
        }
    }

    /// The number of a key, within the range of its table, or the table's default; 0 where it has none.
    pub(crate) fn number_of(&self, table: &Table, key: &str, value: &Number) -> Result<f64, SceneError> {
        self.number_up_to(table, key, value, f64::INFINITY)
    }

    /// The same of a range whose infinite ends are `end`, which depends on the rest of the scene.
    pub(crate) fn number_up_to(&self, table: &Table, key: &str, value: &Number, end: f64) -> Result<f64, SceneError> {
        let (low, high, default) = table.number(key);
        let finite = |x: f64| if x.is_finite() { x } else { end.copysign(x) };
        let about = table.about(key).or((self.meaning)(key));
        self.within(key, value, default.unwrap_or(0.0), [finite(low), finite(high)], about)
    }

    /// The same where it is written, else nothing.
    pub(crate) fn optional_up_to(
        &self,
        table: &Table,
        key: &str,
        value: &Number,
        end: f64,
    ) -> Result<Option<f64>, SceneError> {
        value.as_ref().map(|_| self.number_up_to(table, key, value, end)).transpose()
    }

    /// The whole number of a key, within the range of its table, or the table's default.
    pub(crate) fn whole_of(&self, table: &Table, key: &str, value: &Whole) -> Result<u32, SceneError> {
        let (low, high, default) = table.whole(key);
        self.whole(key, value, default.unwrap_or(low), low, high)
    }

    /// The meaning of the word of `key`; the first of `choices` is the default.
    pub fn choice<T: Copy>(&self, key: &str, value: &Word, choices: &[(&str, T)]) -> Result<T, SceneError> {
        match value {
            None => Ok(choices[0].1),
            Some(word) => self.one_of(key, word, choices),
        }
    }

    /// The choice that the word of `key` stands for; the first one where none is written.
    pub(crate) fn choice_of<T: Choice>(&self, key: &str, value: &Word) -> Result<T, SceneError> {
        self.choice(key, value, T::CHOICES)
    }

    /// The choice that a word stands for.
    pub(crate) fn meaning_of<T: Choice>(&self, key: &str, word: &Spanned<String>) -> Result<T, SceneError> {
        self.one_of(key, word, T::CHOICES)
    }

    /// The choices of a list of words in the order of the list, each once.
    pub(crate) fn choices_of<T: Choice + PartialEq>(&self, key: &str, words: &Words) -> Result<Vec<T>, SceneError> {
        let mut all = Vec::new();
        for word in words.iter().flatten() {
            let choice = self.meaning_of(key, word)?;
            if !all.contains(&choice) {
                all.push(choice);
            }
        }
        Ok(all)
    }

    /// The meaning of a word.
    pub fn one_of<T: Copy>(&self, key: &str, word: &Spanned<String>, choices: &[(&str, T)]) -> Result<T, SceneError> {
        let written = word.get_ref().as_str();
        if let Some(&(_, meaning)) = choices.iter().find(|(name, _)| *name == written) {
            return Ok(meaning);
        }
        let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
        Err(SceneError::OutOfRange {
            place: self.place(&word.span()),
            key: key.to_owned(),
            value: format!("\"{written}\""),
            allowed: names.iter().map(|n| format!("\"{n}\"")).collect::<Vec<_>>().join(" or "),
            advice: match keys::nearest(written, &names) {
                Some(name) => Some(format!("did you mean \"{name}\"?")),
                None => (self.meaning)(key).map(|about| format!("`{key}` means: {about}")),
            },
        })
    }

    fn out_of_range<T: Display>(
        &self,
        key: &str,
        value: &Spanned<T>,
        (allowed, advice): (String, Option<String>),
        about: Option<&str>,
    ) -> SceneError {
        SceneError::OutOfRange {
            place: self.place(&value.span()),
            key: key.to_owned(),
            value: value.get_ref().to_string(),
            advice: Some(advice.unwrap_or_else(|| hints::of_range(key, &allowed, about))),
            allowed,
        }
    }
}

/// What is written behind a key that has a range and a default of its own.
pub(crate) trait Entry {
    /// What it is when it is checked.
    type Value;

    /// The value within the range of its row, or the row's default.
    fn value(&self, s: &Source<'_>, table: &Table, key: &str) -> Result<Self::Value, SceneError>;
}

impl Entry for Number {
    type Value = f64;

    fn value(&self, s: &Source<'_>, table: &Table, key: &str) -> Result<f64, SceneError> {
        s.number_of(table, key, self)
    }
}

impl Entry for Whole {
    type Value = u32;

    fn value(&self, s: &Source<'_>, table: &Table, key: &str) -> Result<u32, SceneError> {
        s.whole_of(table, key, self)
    }
}

impl Entry for Switch {
    type Value = bool;

    fn value(&self, _: &Source<'_>, table: &Table, key: &str) -> Result<bool, SceneError> {
        Ok(match self {
            Some(written) => *written.get_ref(),
            None => table.switch(key),
        })
    }
}
