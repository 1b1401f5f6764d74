//! The words of an optimisation, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use crate::{Number, Whole, Word};

/// Every table with its keys.
const TABLES: &[(&str, &[&str])] = &[
    ("", &["name", "scene", "set", "optimise"]),
    (
        "optimise",
        &[
            "keys",
            "start",
            "round",
            "goal",
            "limit",
            "measure",
            "harmonics",
            "torques_nm",
            "weights",
            "evaluations",
            "max_pressure_mpa",
            "max_edge_pressure_mpa",
            "front",
            "quantile",
            "tolerances",
            "design",
            "samples",
            "seed",
        ],
    ),
];

/// The same, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    TABLES.iter().map(|(name, keys)| ((*name).to_owned(), keys.to_vec())).collect()
}

/// A file of its own, or the table of a document that it stands in.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawOptimisation {
    pub name: Option<String>,
    pub scene: Word,
    #[serde(default)]
    pub set: Vec<Spanned<String>>,
    #[serde(default)]
    pub optimise: RawOptimise,
}

/// `[optimise]`
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawOptimise {
    #[serde(default)]
    pub keys: Vec<Spanned<String>>,
    #[serde(default)]
    pub start: Vec<Spanned<String>>,
    #[serde(default)]
    pub round: Vec<Spanned<String>>,
    #[serde(default)]
    pub goal: Vec<Spanned<String>>,
    #[serde(default)]
    pub limit: Vec<Spanned<String>>,
    pub measure: Word,
    pub harmonics: Option<Spanned<Vec<u32>>>,
    pub torques_nm: Option<Spanned<Vec<f64>>>,
    pub weights: Option<Spanned<Vec<f64>>>,
    pub evaluations: Whole,
    pub max_pressure_mpa: Number,
    pub max_edge_pressure_mpa: Number,
    pub front: Whole,
    pub quantile: Number,
    #[serde(default)]
    pub tolerances: Vec<Spanned<String>>,
    pub design: Word,
    pub samples: Whole,
    pub seed: Whole,
}
