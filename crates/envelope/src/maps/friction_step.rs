//! Friction over the step.

use super::{EnvelopeMap, judge, speed_damping_steps::TOLERANCE};

const TWELVE: &str = include_str!("../../../../scenes/envelope/map-friction.toml");
const FILE: &str = "map-friction";

pub(super) const MAP: EnvelopeMap = EnvelopeMap {
    key: "g",
    name: "friction over step",
    file: FILE,
    judged: "Peak to peak of the dynamic transmission error of twelve coordinates, against steps of 1/256 mesh cycle: solved within 10 %.",
    columns: ("coefficient of friction", &["0", "0.05", "0.1", "0.3", "0.6", "0.99"]),
    rows: ("rows a mesh cycle (each a step)", &["8", "16", "32", "64", "128"]),
    layers: &["energy", "generalised-alpha"],
    cell: |method, steps, friction| {
        let settings = [
            format!("contact.friction={friction}"),
            format!("motion.method={method}"),
            format!("motion.steps_per_mesh_cycle={steps}"),
            "motion.steps_per_resonance=0".to_owned(),
        ];
        let finer = ["motion.method=energy", "motion.steps_per_mesh_cycle=256"];
        judge::in_motion(FILE, TWELVE, &settings, &finer, TOLERANCE)
    },
};
