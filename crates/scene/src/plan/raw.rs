//! Every key of a plan once: type, range, default, meaning; and its words, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use crate::Word;

/// Samples where none are stated, and most of them.
pub(super) const SAMPLES: [u32; 2] = [100, 10_000_000];
/// Seed where none is stated.
pub(crate) const SEED: u32 = 1;

table! {
    /// `[vary]`
    VARY, RawVary: "what is varied, and which numbers of each case are wanted", needed ["keys", "output"]; {
        keys: texts(), "keys and their values, a word an axis: KEY=1,2,5, KEY=0:40:9, KEY~0:40, KEY~normal:0:5, KEY~iso1328:6";
        output: texts(), "numbers that are wanted: of the headline by their keys, of columns as mean(ste_um)";
        design: text(), "how samples are spread: latin-hypercube, sobol or random; default: latin-hypercube";
        samples: whole(1, SAMPLES[1], SAMPLES[0]), "how many samples of what is drawn";
        seed: whole(0, u32::MAX, SEED), "other samples for another seed";
    }
}

/// Every table with its keys, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    let file = ["name", "scene", "set", "vary"].to_vec();
    vec![(String::new(), file), ("vary".to_owned(), VARY.keys.iter().map(|key| key.name).collect())]
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
