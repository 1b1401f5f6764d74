//! Tables of keys: type, range, default and meaning of each key; and enums whose values are words of a file.

use geometry::{Driver, Sense, modification::ReliefShape};
use serde::{Serialize, ser::SerializeMap};

/// An end of a range that depends on the rest of the scene.
pub(crate) const INF: f64 = f64::INFINITY;

/// An enum of which each value is a word of the scene file.
pub(crate) trait Choice: Copy + 'static {
    /// Words alone, in the same order.
    const WORDS: &'static [&'static str];
    /// Words and values; the first one is the default.
    const CHOICES: &'static [(&'static str, Self)];
}

impl Choice for Driver {
    const WORDS: &'static [&'static str] = &["pinion", "wheel"];
    const CHOICES: &'static [(&'static str, Self)] = &[("pinion", Self::Pinion), ("wheel", Self::Wheel)];
}

impl Choice for Sense {
    const WORDS: &'static [&'static str] = &["ccw", "cw"];
    const CHOICES: &'static [(&'static str, Self)] = &[("ccw", Self::Ccw), ("cw", Self::Cw)];
}

impl Choice for ReliefShape {
    const WORDS: &'static [&'static str] = &["linear", "parabolic"];
    const CHOICES: &'static [(&'static str, Self)] = &[("linear", Self::Linear), ("parabolic", Self::Parabolic)];
}

/// A field of a checked table.
pub(crate) trait Field {
    /// Whether the written scene leaves it out.
    fn is_absent(&self) -> bool {
        false
    }
}

fields! { f64, u32, i64, bool, String, Driver, Sense, [f64; 3], Vec<[f64; 3]>; Vec<f64>: is_empty, Vec<String>: is_empty }

impl<T: Choice> Field for Vec<T> {}
impl<T> Field for Option<T> {
    fn is_absent(&self) -> bool {
        self.is_none()
    }
}

/// A row of a written table, unless it is left out.
pub(crate) fn write_field<M: SerializeMap>(
    map: &mut M,
    name: &'static str,
    value: &(impl Field + Serialize),
) -> Result<(), M::Error> {
    if value.is_absent() { Ok(()) } else { map.serialize_entry(plain(name), value) }
}

/// A table of the scene file.
#[derive(Debug)]
pub(crate) struct Table {
    /// Meaning of the table.
    pub about: &'static str,
    /// What may stand in it.
    pub keys: &'static [Key],
    /// Keys without a default.
    pub needed: &'static [&'static str],
}

/// A key of a table.
#[derive(Debug)]
pub(crate) struct Key {
    /// As in the file, with its unit.
    pub name: &'static str,
    /// What may stand behind it.
    pub kind: ValueKind,
    /// What it says: its meaning in short, `; default: ` and what holds where none is written if that is no value of its
    /// own, then whole sentences with all else.
    pub about: &'static str,
}

impl Key {
    /// The first sentence, for messages.
    fn brief(&self) -> &'static str {
        self.about.split_once(". ").map_or(self.about, |(brief, _)| brief)
    }

    /// The meaning without the default stated in it, and that default.
    pub fn meaning_and_default(&self) -> (String, Option<&'static str>) {
        let Some((before, rest)) = self.about.split_once("; default: ") else { return (self.about.to_owned(), None) };
        match rest.split_once(". ") {
            Some((default, more)) => (format!("{before}. {more}"), Some(default)),
            None => (before.to_owned(), Some(rest)),
        }
    }
}

/// What may stand behind a key.
#[derive(Debug)]
pub(crate) enum ValueKind {
    /// A number within a range; an infinite end depends on the rest of the scene. No default: it follows from other
    /// keys, or there is none.
    Number { low: f64, high: f64, default: Option<f64> },
    /// A whole number.
    Whole { low: u32, high: u32, default: Option<u32> },
    /// A whole number of either sign; the range is that of its magnitude.
    SignedWhole { low: u32, high: u32 },
    /// One of some words; the first is what holds where none is written, unless that depends on other keys.
    Word { choices: &'static [&'static str], first_is_default: bool },
    /// Some of some words.
    Words { choices: &'static [&'static str] },
    /// On or off.
    Switch { default: bool },
    /// Any text: a name, a path.
    Text,
    /// A list of texts.
    Texts,
    /// A list of numbers.
    Numbers,
    /// A list of whole numbers.
    Wholes,
    /// Rows of so many numbers; 0: of as many as other keys ask for.
    Rows { columns: usize },
    /// The path of a document, or its tables, which stand there.
    Document(&'static Table),
    /// A table of its own.
    Table(&'static Table),
    /// Tables of one kind, as many as one likes.
    Tables(&'static Table),
}

pub(crate) const fn key(name: &'static str, kind: ValueKind, about: &'static str) -> Key {
    Key { name: plain(name), kind, about }
}

/// The name of a field without the mark of those that are words of Rust, too: `type` of `r#type`.
const fn plain(name: &'static str) -> &'static str {
    match name.as_bytes() {
        [b'r', b'#', ..] => name.split_at(2).1,
        _ => name,
    }
}

/// A number with a default.
pub(crate) const fn number(name: &'static str, low: f64, high: f64, default: f64, about: &'static str) -> Key {
    key(name, ValueKind::Number { low, high, default: Some(default) }, about)
}

/// A number that must be there.
pub(crate) const fn must(name: &'static str, low: f64, high: f64, about: &'static str) -> Key {
    bare(name, low, high, about)
}

/// A number without.
pub(crate) const fn bare(name: &'static str, low: f64, high: f64, about: &'static str) -> Key {
    key(name, ValueKind::Number { low, high, default: None }, about)
}

pub(crate) const fn whole(name: &'static str, low: u32, high: u32, default: u32, about: &'static str) -> Key {
    key(name, ValueKind::Whole { low, high, default: Some(default) }, about)
}

pub(crate) const fn bare_whole(name: &'static str, low: u32, high: u32, about: &'static str) -> Key {
    key(name, ValueKind::Whole { low, high, default: None }, about)
}

/// A whole number of either sign, its magnitude within a range.
pub(crate) const fn signed_whole(name: &'static str, low: u32, high: u32, about: &'static str) -> Key {
    key(name, ValueKind::SignedWhole { low, high }, about)
}

pub(crate) const fn word(name: &'static str, choices: &'static [&'static str], about: &'static str) -> Key {
    key(name, ValueKind::Word { choices, first_is_default: true }, about)
}

/// A word whose default depends on other keys.
pub(crate) const fn bare_word(name: &'static str, choices: &'static [&'static str], about: &'static str) -> Key {
    key(name, ValueKind::Word { choices, first_is_default: false }, about)
}

pub(crate) const fn words(name: &'static str, choices: &'static [&'static str], about: &'static str) -> Key {
    key(name, ValueKind::Words { choices }, about)
}

pub(crate) const fn switch(name: &'static str, default: bool, about: &'static str) -> Key {
    key(name, ValueKind::Switch { default }, about)
}

pub(crate) const fn text(name: &'static str, about: &'static str) -> Key {
    key(name, ValueKind::Text, about)
}

pub(crate) const fn texts(name: &'static str, about: &'static str) -> Key {
    key(name, ValueKind::Texts, about)
}

pub(crate) const fn numbers(name: &'static str, about: &'static str) -> Key {
    key(name, ValueKind::Numbers, about)
}

pub(crate) const fn wholes(name: &'static str, about: &'static str) -> Key {
    key(name, ValueKind::Wholes, about)
}

pub(crate) const fn rows(name: &'static str, columns: usize, about: &'static str) -> Key {
    key(name, ValueKind::Rows { columns }, about)
}

/// A document by its path, or by its tables.
pub(crate) const fn document(name: &'static str, of: &'static Table, about: &'static str) -> Key {
    key(name, ValueKind::Document(of), about)
}

pub(crate) const fn table(name: &'static str, of: &'static Table) -> Key {
    key(name, ValueKind::Table(of), of.about)
}

pub(crate) const fn list(name: &'static str, of: &'static Table) -> Key {
    key(name, ValueKind::Tables(of), of.about)
}

impl Table {
    /// Range and default of a number. `value!` only names keys that have a row.
    pub fn number(&self, name: &str) -> (f64, f64, Option<f64>) {
        match self.keys.iter().find(|k| k.name == name).map(|k| &k.kind) {
            Some(&ValueKind::Number { low, high, default }) => (low, high, default),
            _ => (f64::NEG_INFINITY, f64::INFINITY, None),
        }
    }

    /// Whether a switch is on by default.
    pub fn switch(&self, name: &str) -> bool {
        self.keys.iter().any(|k| k.name == name && matches!(k.kind, ValueKind::Switch { default: true }))
    }

    /// Short description of a key; `None` for a key that is a table of its own.
    pub fn about(&self, name: &str) -> Option<&'static str> {
        self.keys.iter().find(|k| k.name == name).map(Key::brief)
    }

    /// Range and default of a whole number.
    pub fn whole(&self, name: &str) -> (u32, u32, Option<u32>) {
        match self.keys.iter().find(|k| k.name == name).map(|k| &k.kind) {
            Some(&ValueKind::Whole { low, high, default }) => (low, high, default),
            Some(&ValueKind::SignedWhole { low, high }) => (low, high, None),
            _ => (0, u32::MAX, None),
        }
    }

    /// The names of its keys, and of those of every table in it, by table.
    pub fn names(&'static self) -> Vec<(String, Vec<&'static str>)> {
        let mut all = Vec::new();
        self.walk("", &mut |path, table| all.push((path.to_owned(), table.keys.iter().map(|k| k.name).collect())));
        all
    }

    /// Visits the table and those in it, with their names; the name of a list of tables is in brackets.
    pub fn walk(&'static self, path: &str, visit: &mut impl FnMut(&str, &'static Self)) {
        visit(path, self);
        let own = path.trim_matches(['[', ']']);
        let inner = |key: &Key| if own.is_empty() { key.name.to_owned() } else { format!("{own}.{}", key.name) };
        for key in self.keys {
            match key.kind {
                ValueKind::Table(of) => of.walk(&inner(key), visit),
                ValueKind::Tables(of) => of.walk(&format!("[{}]", inner(key)), visit),
                _ => {}
            }
        }
    }
}
