//! Every key of a study once: type, range, default, meaning; and its words, nothing checked yet.

/// Mesh cycles of a figure at the most.
pub(super) const CYCLES: u32 = 100_000_000;

table! {
    /// The whole file.
    STUDY, RawStudy: "A study of ale-gear: several scenes with the same figures", needed ["case"]; {
        name: text(), "title; default: the file's name";
        parameter: text(), "what the cases differ in, with its unit: the axis of the figures; default: value";
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
        scene: document(SCENE), "path of the scene, or its tables: [case.scene.pinion] and so on";
        set: texts(), "keys of it that are otherwise here, as after --set";
        label: text(), "what figures call it; default: the name of the scene";
        value: must(-1e300, 1e300), "its place on the axis of the parameter";
    }
}

table! {
    /// `[[quantity]]`
    QUANTITY, RawQuantity: "a number of each case over the parameter", needed ["column"]; {
        column: text(), "column of history.csv";
        take: text(), "what is taken of it: mean, peak_to_peak, least or largest; default: mean";
    }
}

table! {
    /// `[[over_time]]`
    OVER_TIME, RawOverTime: "a column of all cases over time", needed ["column"]; {
        column: text(), "column of history.csv";
        cycles: bare_whole(1, CYCLES), "mesh cycles at the end that are drawn; default: all";
    }
}

table! {
    /// `[[follow]]`
    FOLLOW, RawFollow: "columns of one case over time", needed ["column", "beside"]; {
        case: text(), "label of the case; default: the first one";
        column: text(), "column of history.csv";
        beside: texts(), "columns that it may follow";
        cycles: bare_whole(1, CYCLES), "mesh cycles at the end that are drawn; default: all";
    }
}

table! {
    /// `[full]`
    FULL, RawFull: "a case beside the model that is not reduced, alone on the machine and from cold"; {
        case: text(), "label of the case; default: the first one";
        positions: whole(0, 100_000, 1), "positions of the cycle that are run, at the most; 0: none";
    }
}

/// Every table with its keys, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    STUDY.tables()
}
