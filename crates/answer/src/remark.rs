//! What a user should hear of a result: a code with values, and the words that are made of them.

use std::fmt;

use described::Key;
use serde::{Deserialize, Serialize, Serializer, ser::SerializeMap};
use serde_json::Value;

/// A number or a text of a remark.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum RemarkValue {
    /// A number, in the unit that its name ends with.
    Number(f64),
    /// A name, a file, or the words of somebody else.
    Text(String),
}

/// Letters of a number that a user may have written.
const SHORT: usize = 7;

/// A number as it is where that is short, with [`digits`] else, where the sentence asks for no other.
impl fmt::Display for RemarkValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) if f.precision().is_some() => number.fmt(f),
            Self::Number(number) => {
                let written = number.to_string();
                let is_short = written.len() <= SHORT && (1e-3..1e7).contains(&number.abs());
                f.write_str(&if is_short { written } else { digits(*number) })
            }
            Self::Text(text) => f.write_str(text),
        }
    }
}

impl fmt::LowerExp for RemarkValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => fmt::LowerExp::fmt(number, f),
            Self::Text(text) => f.write_str(text),
        }
    }
}

/// Three digits, all of a whole number below ten million, without an exponent where that is short.
pub fn digits(value: f64) -> String {
    let decimals = (2.0 - value.abs().max(1e-300).log10().floor()).clamp(0.0, 5.0) as usize;
    if value != 0.0 && !(1e-3..1e7).contains(&value.abs()) {
        format!("{value:.2e}")
    } else {
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    }
}

macro_rules! from_numbers {
    ($($number:ty),*) => {
        $(impl From<$number> for RemarkValue {
            fn from(number: $number) -> Self {
                Self::Number(number as f64)
            }
        })*
    };
}

from_numbers!(f64, u32, u64, usize, i64);

impl From<&str> for RemarkValue {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for RemarkValue {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

/// One kind of remark: a row of a table that [`remarks!`](crate::remarks) makes.
#[derive(Debug)]
pub struct RemarkKind {
    /// Stable name for programs.
    pub code: &'static str,
    /// Names of its values, with their units, in their order.
    pub values: &'static [&'static str],
    /// The sentence, values in braces.
    pub text: &'static str,
    /// What to do, values in braces; empty where there is nothing to do.
    pub hint: &'static str,
    /// Sentence and hint with these values.
    #[doc(hidden)]
    pub fill: fn(&[RemarkValue]) -> [String; 2],
}

/// What a user should hear of a result.
#[derive(Debug, Clone)]
pub struct Remark {
    kind: &'static RemarkKind,
    values: Vec<RemarkValue>,
    about: Option<String>,
}

impl Remark {
    /// Keys of a remark in a summary.
    pub const KEYS: &'static [Key] = &[
        Key::new("code", "String", "code of the remark: [all codes](remarks.md)"),
        Key::new("about", "String", "mesh or case that the remark is about; missing where there is only one"),
        Key::new("text", "String", "the sentence"),
        Key::new("hint", "String", "action to take; missing where there is none"),
        Key::new("values", "BTreeMap<String, RemarkValue>", "values by name with unit"),
    ];

    /// A remark of a kind; [`remarks!`](crate::remarks) makes a function for each that takes its values.
    #[doc(hidden)]
    pub fn new(kind: &'static RemarkKind, values: Vec<RemarkValue>) -> Self {
        Self { kind, values, about: None }
    }

    /// The remark that an entry of `remarks` in a summary is of, among `kinds`; `None` where it is none of them.
    pub fn read(entry: &Value, kinds: &[&'static RemarkKind]) -> Option<Self> {
        let kind = kinds.iter().find(|kind| entry["code"] == kind.code)?;
        let value = |name: &&str| RemarkValue::deserialize(&entry["values"][*name]).ok();
        let values = kind.values.iter().map(value).collect::<Option<_>>()?;
        Some(Self { kind, values, about: entry["about"].as_str().map(str::to_owned) })
    }

    /// This remark about one of several meshes or cases, whose name then stands before the sentence.
    #[must_use]
    pub fn about(self, name: &str) -> Self {
        Self { about: Some(name.to_owned()), ..self }
    }

    /// Stable name for programs.
    pub fn code(&self) -> &'static str {
        self.kind.code
    }

    /// Values by their names.
    pub fn values(&self) -> impl Iterator<Item = (&'static str, &RemarkValue)> {
        self.kind.values.iter().copied().zip(&self.values)
    }

    /// The sentence, without what to do.
    pub fn text(&self) -> String {
        let [text, _] = (self.kind.fill)(&self.values);
        self.about.as_ref().map_or_else(|| text.clone(), |name| format!("{name}: {text}"))
    }

    /// What to do; `None` where there is nothing to do.
    pub fn hint(&self) -> Option<String> {
        let [_, hint] = (self.kind.fill)(&self.values);
        Some(hint).filter(|hint| !hint.is_empty())
    }
}

/// The sentence, and what to do behind a semicolon.
impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text())?;
        self.hint().map_or(Ok(()), |hint| write!(f, "; {hint}"))
    }
}

/// Equal where they say the same.
impl PartialEq for Remark {
    fn eq(&self, other: &Self) -> bool {
        self.code() == other.code() && self.values == other.values && self.about == other.about
    }
}

/// `code`, `text`, `hint` and `about` where there is one, `values` by name.
impl Serialize for Remark {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("code", self.code())?;
        if let Some(about) = &self.about {
            map.serialize_entry("about", about)?;
        }
        map.serialize_entry("text", &self.text())?;
        if let Some(hint) = self.hint() {
            map.serialize_entry("hint", &hint)?;
        }
        let values: std::collections::BTreeMap<_, _> = self.values().collect();
        map.serialize_entry("values", &values)?;
        map.end()
    }
}

/// A table of kinds of remarks: a function for each, named as its code, that takes its values, and `ALL` of them in their
/// order. Sentence and hint are format strings with the names of values.
#[macro_export]
macro_rules! remarks {
    ($($code:ident($($value:ident),* $(,)?) $text:literal, $hint:literal;)*) => {
        #[allow(non_upper_case_globals)]
        mod kinds {
            $(
                pub(super) static $code: $crate::RemarkKind = $crate::RemarkKind {
                    code: stringify!($code),
                    values: &[$(stringify!($value)),*],
                    text: $text,
                    hint: $hint,
                    fill: |values| {
                        #[allow(unused_variables)]
                        let [$($value),*] = values else { return Default::default() };
                        [format!($text), format!($hint)]
                    },
                };
            )*
        }

        /// All kinds of this table.
        pub static ALL: &[&$crate::RemarkKind] = &[$(&kinds::$code),*];

        $(
            #[doc = concat!("The remark `", stringify!($code), "`.")]
            #[allow(clippy::too_many_arguments)]
            pub fn $code($($value: impl Into<$crate::RemarkValue>),*) -> $crate::Remark {
                $crate::Remark::new(&kinds::$code, vec![$($value.into()),*])
            }
        )*
    };
}

#[cfg(test)]
mod tests {
    use super::Remark;

    remarks! {
        off_limit(gear, share_percent) "the {gear} is {share_percent:.1} % off", "take fewer than {share_percent:.0}";
        nothing_to_do() "that is so", "";
    }

    /// Programs get code and values, people sentence and hint with the digits that they can use.
    #[test]
    fn words_are_made_of_values() {
        let said = off_limit("wheel", 12.345);
        assert_eq!(said.to_string(), "the wheel is 12.3 % off; take fewer than 12");
        let json = serde_json::to_value(said.clone().about("mesh 1")).unwrap();
        let expected = serde_json::json!({
            "code": "off_limit", "about": "mesh 1", "text": "mesh 1: the wheel is 12.3 % off",
            "hint": "take fewer than 12", "values": { "gear": "wheel", "share_percent": 12.345 },
        });
        assert_eq!(json, expected);
        let about = said.clone().about("mesh 1");
        assert_eq!(Remark::read(&json, ALL), Some(about), "it is read as it was written");
        assert_eq!(Remark::read(&serde_json::json!({ "code": "off_limit", "values": {} }), ALL), None);
        assert_ne!(said, off_limit("wheel", 12.346));
        assert_eq!((nothing_to_do().to_string(), nothing_to_do().hint()), ("that is so".to_owned(), None));
        assert_eq!(ALL.iter().map(|kind| kind.code).collect::<Vec<_>>(), ["off_limit", "nothing_to_do"]);
    }
}
