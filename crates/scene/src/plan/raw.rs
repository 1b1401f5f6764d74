//! Every key of a plan once: type, range, default, meaning; and its words, nothing checked yet.

/// Samples where none are stated, and most of them.
pub(super) const SAMPLES: [u32; 2] = [100, 10_000_000];
/// Seed where none is stated.
pub(crate) const SEED: u32 = 1;

table! {
    /// `[vary]`
    VARY, RawVary: "what is varied, and which numbers of each case are wanted", needed ["keys", "output"]; {
        keys: texts(), "keys and their values, a word an axis: `KEY=1,2,5`, `KEY=0:40:9`, `KEY~0:40`, `KEY~normal:0:5`, `KEY~iso1328:6`";
        output: texts(), "numbers that are wanted: of the headline by their keys, of columns as `mean(ste_um)`";
        design: text(), "how samples are spread: latin-hypercube, sobol or random; default: latin-hypercube. sobol: means fall nearly as the number of samples, 65,536 of them and 256 axes at the most; random: quantiles have the confidence intervals of the books";
        samples: whole(1, SAMPLES[1], SAMPLES[0]), "how many samples of what is drawn";
        seed: whole(0, u32::MAX, SEED), "other samples for another seed; the same for the same on every machine";
    }
}

table! {
    /// A file of its own, or the table of a document that it stands in.
    PLAN, RawPlan: "a plan: one document with some of its keys varied", needed ["scene"]; {
        name: text(), "title; default: the file's name";
        scene: text(), "path of the scene or the gearbox file, relative to this file";
        set: texts(), "keys that all cases have otherwise, as after `--set`";
        vary: always(VARY: RawVary);
    }
}

/// Every table with its keys, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    PLAN.names()
}
