//! Torque over misalignment.

use super::{EnvelopeMap, judge};

pub(super) const PAIR: &str = include_str!("../../../../scenes/envelope/map-pair.toml");
pub(super) const FILE: &str = "map-pair";
/// Settings that make the pair three times as exact.
pub(super) const FINER: [&str; 2] = ["accuracy.mean_ste=1 %", "analysis.positions_per_cycle=16"];

pub(super) const MAP: EnvelopeMap = EnvelopeMap {
    key: "a",
    name: "torque over misalignment",
    file: FILE,
    judged: "Mean static transmission error at 5 %, against the same at 1 %: solved where both bounds meet.",
    columns: ("torque, N m", &["0.1", "3", "30", "300", "1000", "3000", "20000"]),
    rows: ("misalignment in the plane of action, um over the face width", &["-100", "-20", "0", "5", "20", "100"]),
    layers: &[""],
    cell: |_, misalignment, torque| {
        let settings = [
            format!("operation.torque_nm={torque}"),
            format!("pair.misalignment.in_plane_of_action_um={misalignment}"),
        ];
        judge::at_rest(FILE, PAIR, &settings, &FINER)
    },
};
