//! All keys of a study file: type, range, default, meaning; and the raw, unchecked values of a file.

use super::file::Take;

/// Mesh cycles of a figure at the most.
const CYCLES: u32 = 100_000_000;

table! {
    /// The whole file.
    STUDY, RawStudy: "a study: scenes side by side, and what is drawn of all of them", needed ["case"]; {
        name: text(), "title; default: the file's name";
        parameter: text(), "what the cases differ in, with its unit: the axis of figures over it; default: value";
        case: list(CASE: RawCase);
        quantity: list(QUANTITY: RawQuantity);
        over_time: list(OVER_TIME: RawOverTime);
        follow: list(FOLLOW: RawFollow);
        full: table(FULL: RawFull);
    }
}

table! {
    /// `[[case]]`
    CASE, RawCase: "a scene of the study", needed ["scene", "value"]; {
        scene: document(SCENE), "path of the scene, relative to this file; or its tables, as `[case.scene.pinion]` and so on";
        set: texts(), "keys of the scene that this case has otherwise, as after `--set`; so one scene serves many cases";
        label: text(), "name in tables and legends, no two alike; default: the scene's name";
        value: must(-1e300, 1e300), "the case's place on the axis of the parameter";
    }
}

table! {
    /// `[[quantity]]`
    QUANTITY, RawQuantity: "a number of every case: a column of the table and of study.csv, and a chart over the parameter", needed ["column"]; {
        column: text(), "column of history.csv";
        take: word(Take), "what is taken of all rows written";
    }
}

table! {
    /// `[[over_time]]`
    OVER_TIME, RawOverTime: "a chart over time, a curve a case, each from the beginning of its cycles shown", needed ["column"]; {
        column: text(), "column of history.csv";
        cycles: bare_whole(1, CYCLES), "the last so many mesh cycles, at the most those that are written; default: all";
    }
}

table! {
    /// `[[follow]]`
    FOLLOW, RawFollow: "a column of one case beside others that it may follow: charts over mesh cycles and of one against the other, and the correlation of every case", needed ["column", "beside"]; {
        case: text(), "label of the case that is drawn; default: the first";
        column: text(), "column of history.csv";
        beside: texts(), "columns that it may follow";
        cycles: bare_whole(1, CYCLES), "the last so many mesh cycles, at the most those that are written; default: all";
    }
}

table! {
    /// `[full]`
    FULL, RawFull: "what every degree of freedom would cost: one case is run at rest with the model full, after the others and alone, on the same meshes and from cold"; {
        case: text(), "label of the case, a scene of the model reduced with slices; default: the first";
        positions: whole(0, 100_000, 1), "positions of the cycle that are run, at the most (a divisor of `positions_per_cycle`); 0 leaves it out";
    }
}

/// Every table with its keys, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    STUDY.names()
}
