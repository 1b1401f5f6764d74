//! The words of a study file, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use crate::{Number, Whole, Word};

/// Every table with its keys.
const TABLES: &[(&str, &[&str])] = &[
    ("", &["name", "parameter", "case", "quantity", "over_time", "follow", "full"]),
    ("[case]", &["scene", "set", "label", "value"]),
    ("[quantity]", &["column", "take"]),
    ("[over_time]", &["column", "cycles"]),
    ("[follow]", &["case", "column", "beside", "cycles"]),
    ("full", &["case", "positions"]),
];

/// The same, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    TABLES.iter().map(|(name, keys)| ((*name).to_owned(), keys.to_vec())).collect()
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawStudy {
    pub name: Option<String>,
    pub parameter: Option<String>,
    #[serde(default)]
    pub case: Vec<Spanned<RawCase>>,
    #[serde(default)]
    pub quantity: Vec<Spanned<RawQuantity>>,
    #[serde(default)]
    pub over_time: Vec<Spanned<RawOverTime>>,
    #[serde(default)]
    pub follow: Vec<Spanned<RawFollow>>,
    pub full: Option<Spanned<RawFull>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCase {
    pub scene: Word,
    #[serde(default)]
    pub set: Vec<Spanned<String>>,
    pub label: Option<String>,
    pub value: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawQuantity {
    pub column: Word,
    pub take: Word,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawOverTime {
    pub column: Word,
    pub cycles: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawFollow {
    pub case: Word,
    pub column: Word,
    pub beside: Option<Vec<Spanned<String>>>,
    pub cycles: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawFull {
    pub case: Word,
    pub positions: Whole,
}
