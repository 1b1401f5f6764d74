//! All keys of an optimisation: type, range, default, meaning; and its raw, unchecked values.

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
        keys: texts(), "what may change, `KEY=FROM:TO`; default: tip reliefs of both gears, where they begin, lead crowning of the pinion. Keys with `+` between get the same value";
        start: texts(), "where the search begins, `KEY=VALUE`; default: what the scene says, else 0 or the middle";
        round: texts(), "what a value is a whole multiple of in the end, what a machine can be set to, `KEY=VALUE`; default: 1 for um, 0.1 for degrees, 0.01 for mm. 0: any value";
        goal: texts(), "numbers of the headline that shall be small, in place of the transmission error, such as `face_load_factor.0`";
        limit: texts(), "limits of numbers of the headline, `KEY=MOST`; with goal";
        measure: text(), "what of the transmission error shall be small: peak-to-peak, rms or harmonics; default: peak-to-peak. peak-to-peak: weighted mean over the torques; rms: of the error less its mean; harmonics: root mean square of some mesh harmonics";
        harmonics: wholes(), "which mesh harmonics; default: the first";
        torques_nm: numbers(), "torques at which it counts, N m, on the driven gear of a pair, or of the first `[[torque]]` of a gearbox with all others in proportion; default: the document's";
        weights: numbers(), "what each of them counts; default: 1 each";
        evaluations: whole(1, EVALUATIONS[1], EVALUATIONS[0]), "evaluations at the most; one solves all torques and samples with their derivatives";
        max_pressure_mpa: bare(PRESSURES[0], PRESSURES[1]), "limit of the contact pressure at all positions and torques, MPa";
        max_edge_pressure_mpa: bare(PRESSURES[0], PRESSURES[1]), "limit of it at end faces and tip edges, MPa: where a slice ends at an end face or a tip edge presses (places 2 to 4 of `max_pressure_place`)";
        front: whole(0, FRONT, 0), "points of the trade-off: optima below lower and lower limits of the pressure, down to that of the start, or by a tenth where that is no lower";
        quantile: bare(0.0, 0.999), "with tolerances and peak-to-peak: the mean of the samples that are worse than this share of them, in place of the mean of all";
        tolerances: texts(), "deviations that are drawn, `KEY~normal:0:5`. Each is added to what the design, or the scene, says of its key; each sample is a pair from the machine, and the goal is taken over all of them. `KEY=a.csv,b.csv`, such as topographies of measured gears: each file with each sample";
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
    OPTIMISATION.names()
}
