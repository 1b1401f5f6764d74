//! The words of a plan file, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use crate::{Number, Whole, Word};

/// Every table with its keys.
const TABLES: &[(&str, &[&str])] = &[
    ("", &["name", "scene", "set", "design", "samples", "seed", "vary", "output"]),
    (
        "[vary]",
        &[
            "key",
            "also",
            "values",
            "from",
            "to",
            "count",
            "scale",
            "mean",
            "deviation",
            "least",
            "largest",
            "iso_1328_class",
        ],
    ),
    ("[output]", &["headline", "column", "take", "order"]),
];

/// The same, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    TABLES.iter().map(|(name, keys)| ((*name).to_owned(), keys.to_vec())).collect()
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawPlan {
    pub name: Option<String>,
    pub scene: Word,
    #[serde(default)]
    pub set: Vec<Spanned<String>>,
    pub design: Word,
    pub samples: Whole,
    pub seed: Whole,
    #[serde(default)]
    pub vary: Vec<Spanned<RawVary>>,
    #[serde(default)]
    pub output: Vec<Spanned<RawOutput>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawVary {
    pub key: Word,
    #[serde(default)]
    pub also: Vec<Spanned<String>>,
    pub values: Option<Spanned<Vec<f64>>>,
    pub from: Number,
    pub to: Number,
    pub count: Whole,
    pub scale: Word,
    pub mean: Number,
    pub deviation: Number,
    pub least: Number,
    pub largest: Number,
    pub iso_1328_class: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawOutput {
    pub headline: Word,
    pub column: Word,
    pub take: Word,
    pub order: Whole,
}
