//! Every key of an optimisation once: type, range, default, meaning; and its words, nothing checked yet.

use crate::plan::SEED;

/// Evaluations where none are stated, and the most.
pub(super) const EVALUATIONS: [u32; 2] = [20, 10_000];
/// Limits of a pressure, MPa.
pub(super) const PRESSURES: [f64; 2] = [1.0, 1e6];
/// Points of the front at the most.
pub(super) const FRONT: u32 = 100;
/// Samples of the tolerances where none are stated, and the most.
pub(super) const SAMPLES: [u32; 2] = [20, 1_000_000];

table! {
    /// `[optimise]`
    OPTIMISE, RawOptimise: "what may change, and what shall be small"; {
        keys: texts(), "what may change, KEY=FROM:TO; default: tip reliefs, where they begin, lead crowning of the pinion";
        start: texts(), "where the search begins, KEY=VALUE; default: what the scene says, else 0 or the middle";
        round: texts(), "what a value is a whole multiple of in the end, KEY=VALUE; default: 1 for um, 0.1 for degrees, 0.01 for mm";
        goal: texts(), "numbers of the headline that shall be small, in place of the transmission error";
        limit: texts(), "limits of numbers of the headline, KEY=MOST; with goal";
        measure: text(), "what of the transmission error shall be small: peak-to-peak, rms or harmonics; default: peak-to-peak";
        harmonics: wholes(), "which mesh harmonics; default: the first";
        torques_nm: numbers(), "torques at which it counts, N m; default: the scene's";
        weights: numbers(), "what each of them counts; default: 1 each";
        evaluations: whole(1, EVALUATIONS[1], EVALUATIONS[0]), "evaluations at the most";
        max_pressure_mpa: bare(PRESSURES[0], PRESSURES[1]), "limit of the contact pressure, MPa";
        max_edge_pressure_mpa: bare(PRESSURES[0], PRESSURES[1]), "limit of it at end faces and tip edges, MPa";
        front: whole(0, FRONT, 0), "points of the trade-off against a lower pressure";
        quantile: bare(0.0, 0.999), "with tolerances: the mean of the samples that are worse than this share of them";
        tolerances: texts(), "deviations that are drawn, KEY~normal:0:5";
        design: text(), "how samples are spread: latin-hypercube, sobol or random; default: latin-hypercube";
        samples: whole(1, SAMPLES[1], SAMPLES[0]), "how many samples of the tolerances";
        seed: whole(0, u32::MAX, SEED), "other samples for another seed";
    }
}

table! {
    /// A file of its own, or the table of a document that it stands in.
    OPTIMISATION, RawOptimisation: "An optimisation of ale-gear: a pair or a gearbox whose best values are searched", needed ["scene", "optimise"]; {
        name: text(), "title; default: the file's name";
        scene: text(), "path of the document that is optimised; left out where [optimise] stands in it";
        set: texts(), "keys of it that are otherwise, as after --set";
        optimise: always(OPTIMISE: RawOptimise);
    }
}

/// Every table with its keys, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    OPTIMISATION.tables()
}
