//! Values of a document within their ranges: numbers, whole numbers and words, and errors for values outside.

use std::fmt::Display;

use toml::Spanned;

use super::{
    error::SceneError,
    hints, keys,
    source::Source,
    spanned::{Number, Switch, Whole, Word, Words},
    table::{Choice, Table},
};

impl Source<'_> {
    /// The number of `key`, or `default`, within `low..=high`.
    pub fn number(&self, key: &str, value: &Number, default: f64, low: f64, high: f64) -> Result<f64, SceneError> {
        self.within(key, value, default, [low, high], || (self.meaning)(key))
    }

    /// The number of a key, or `default`, within `low..=high`; `about` says what the key means, to a complaint alone.
    fn within<'a>(
        &self,
        key: &str,
        value: &Number,
        default: f64,
        [low, high]: [f64; 2],
        about: impl FnOnce() -> Option<&'a str>,
    ) -> Result<f64, SceneError> {
        let Some(value) = value else { return Ok(default) };
        let number = *value.get_ref();
        if (low..=high).contains(&number) {
            return Ok(number);
        }
        let advice = hints::of_number(key, number, [low, high]);
        Err(self.out_of_range(key, value, (format!("{low} .. {high}"), advice), about()))
    }

    /// The whole number of `key`, or `default`, within `low..=high`.
    pub fn whole(&self, key: &str, value: &Whole, default: u32, low: u32, high: u32) -> Result<u32, SceneError> {
        self.whole_within(key, value, default, [low, high], || (self.meaning)(key))
    }

    /// The whole number of a key, or `default`, within `low..=high`; `about` says what the key means, to a complaint alone.
    fn whole_within<'a>(
        &self,
        key: &str,
        value: &Whole,
        default: u32,
        [low, high]: [u32; 2],
        about: impl FnOnce() -> Option<&'a str>,
    ) -> Result<u32, SceneError> {
        let Some(value) = value else { return Ok(default) };
        match u32::try_from(*value.get_ref()) {
            Ok(number) if (low..=high).contains(&number) => Ok(number),
            _ => {
                let advice = hints::of_number(key, *value.get_ref() as f64, [low, high].map(f64::from));
                Err(self.out_of_range(key, value, (format!("{low} .. {high}"), advice), about()))
            }
        }
    }

    /// The number of a key, within the range of its table, or the table's default; 0 where it has none.
    pub(crate) fn number_of(&self, table: &Table, key: &str, value: &Number) -> Result<f64, SceneError> {
        self.number_up_to(table, key, value, f64::INFINITY)
    }

    /// The number of a key within a range whose infinite ends are `end`, which depends on the rest of the scene.
    pub(crate) fn number_up_to(&self, table: &Table, key: &str, value: &Number, end: f64) -> Result<f64, SceneError> {
        let (low, high, default) = table.number(key);
        let finite = |x: f64| if x.is_finite() { x } else { end.copysign(x) };
        let about = || table.about(key).or_else(|| (self.meaning)(key));
        self.within(key, value, default.unwrap_or(0.0), [finite(low), finite(high)], about)
    }

    /// The number of a key where it is written, else nothing.
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
        let about = || table.about(key).or_else(|| (self.meaning)(key));
        self.whole_within(key, value, default.unwrap_or(low), [low, high], about)
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
            allowed: names.iter().map(|n| format!("\"{n}\"")).collect::<Vec<_>>().join(" or ").into(),
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
            allowed: allowed.into(),
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
