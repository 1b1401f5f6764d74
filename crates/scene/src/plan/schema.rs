//! All keys of a plan: type, range, default, meaning; and its raw, unchecked values.

use super::{SectionEvery, Start};
use crate::SweepWay;

/// Samples where none are stated, and most of them.
pub(super) const SAMPLES: [u32; 2] = [100, 10_000_000];
/// Seed where none is stated.
pub(crate) const SEED: u32 = 1;

table! {
    /// `[vary]`
    VARY, RawVary: "what is varied, and which numbers of each case are wanted", needed ["keys"]; {
        keys: texts(), "keys and their values, a word an axis: `KEY=1,2,5`, `KEY=0:40:9`, `KEY~0:40`, `KEY~normal:0:5`, `KEY~iso1328:6`";
        output: texts(), "numbers that are wanted: of the headline by their keys, of columns as `mean(ste_um)`; left out unless each value starts alone";
        start: word(Start), "how the next value starts: alone, from the state of the last one, on a branch, from a plane of states";
        design: text(), "how samples are spread: latin-hypercube, sobol or random; default: latin-hypercube. sobol: means fall nearly as the number of samples, 65,536 of them and 256 axes at the most; random: quantiles have the confidence intervals of the books";
        samples: whole(1, SAMPLES[1], SAMPLES[0]), "how many samples of what is drawn";
        seed: whole(0, u32::MAX, SEED), "other samples for another seed; the same for the same on every machine";
        of: text(), "with carry: column whose section is taken; default: dte_um";
        ways: words(SweepWay), "with carry: which way values are gone through; default: up and down";
        once: word(SectionEvery), "with carry: how often a section has a point";
        cycles: bare_whole(1, 100_000), "with carry: points of a section; default: 64";
        settle: bare_whole(0, 100_000_000), "with carry: mesh cycles before it at the most; default: warm_up_cycles, or 400";
        lyapunov: bare_whole(0, 100_000_000), "with carry: mesh cycles over which the largest Lyapunov exponent is found; default: 200, impact: 0";
    }
}

table! {
    /// A file of its own, or the table of a document that it stands in.
    PLAN, RawPlan: "A plan of ale-gear: a pair or a gearbox of which keys are varied", needed ["scene", "vary"]; {
        name: text(), "title; default: the file's name";
        scene: text(), "path of the document that is varied; left out where [vary] stands in it";
        set: texts(), "keys of it that are otherwise in all cases, as after --set";
        vary: always(VARY: RawVary);
    }
}

/// Every table with its keys, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    PLAN.names()
}
