//! The words of an optimisation file, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use crate::{Number, Whole, Word, plan::RawVary};

/// Every table with its keys.
const TABLES: &[(&str, &[&str])] = &[
    (
        "",
        &[
            "name",
            "scene",
            "set",
            "measure",
            "harmonics",
            "torques_nm",
            "weights",
            "evaluations",
            "max_pressure_mpa",
            "max_edge_pressure_mpa",
            "front",
            "quantile",
            "design",
            "samples",
            "seed",
            "parameter",
            "tolerance",
        ],
    ),
    ("[parameter]", &["key", "also", "from", "to", "start", "round"]),
    (
        "[tolerance]",
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
];

/// The same, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    TABLES.iter().map(|(name, keys)| ((*name).to_owned(), keys.to_vec())).collect()
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawOptimisation {
    pub name: Option<String>,
    pub scene: Word,
    #[serde(default)]
    pub set: Vec<Spanned<String>>,
    pub measure: Word,
    pub harmonics: Option<Spanned<Vec<u32>>>,
    pub torques_nm: Option<Spanned<Vec<f64>>>,
    pub weights: Option<Spanned<Vec<f64>>>,
    pub evaluations: Whole,
    pub max_pressure_mpa: Number,
    pub max_edge_pressure_mpa: Number,
    pub front: Whole,
    pub quantile: Number,
    pub design: Word,
    pub samples: Whole,
    pub seed: Whole,
    #[serde(default)]
    pub parameter: Vec<Spanned<RawParameter>>,
    #[serde(default)]
    pub tolerance: Vec<Spanned<RawVary>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawParameter {
    pub key: Word,
    #[serde(default)]
    pub also: Vec<Spanned<String>>,
    pub from: Number,
    pub to: Number,
    pub start: Number,
    pub round: Number,
}
