//! The words of a plan, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use crate::{Whole, Word};

/// Every table with its keys.
const TABLES: &[(&str, &[&str])] =
    &[("", &["name", "scene", "set", "vary"]), ("vary", &["keys", "output", "design", "samples", "seed"])];

/// The same, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    TABLES.iter().map(|(name, keys)| ((*name).to_owned(), keys.to_vec())).collect()
}

/// A file of its own, or the table of a document that it stands in.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawPlan {
    pub name: Option<String>,
    pub scene: Word,
    #[serde(default)]
    pub set: Vec<Spanned<String>>,
    #[serde(default)]
    pub vary: RawVary,
}

/// `[vary]`
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawVary {
    #[serde(default)]
    pub keys: Vec<Spanned<String>>,
    #[serde(default)]
    pub output: Vec<Spanned<String>>,
    pub design: Word,
    pub samples: Whole,
    pub seed: Whole,
}
