//! Speed, damping and steps for every method of integration.

use super::{Cell, EnvelopeMap, judge};

pub(super) const OSCILLATOR: &str = include_str!("../../../../scenes/envelope/map-oscillator.toml");
pub(super) const FILE: &str = "map-oscillator";
/// Small steps of the method that keeps energy.
pub(super) const FINER: [&str; 3] =
    ["motion.method=energy", "motion.steps_per_mesh_cycle=256", "motion.steps_per_resonance=64"];
/// Peak to peak off by more than this is wrong, %.
pub(super) const TOLERANCE: f64 = 10.0;

pub(super) const MAP: EnvelopeMap = EnvelopeMap {
    key: "c",
    name: "speed, damping and steps of every method of integration",
    file: FILE,
    judged: "Peak to peak of the dynamic transmission error of eight coordinates, against steps of 1/256 mesh cycle: solved within 10 %.",
    columns: ("speed, 1/min", &["500", "1500", "3000", "4500", "6000", "9000"]),
    rows: (
        "rows a mesh cycle (each a step), damping ratio",
        &["8, 0.02", "8, 0.1", "16, 0.02", "16, 0.1", "64, 0.02", "64, 0.1"],
    ),
    layers: &["energy", "generalised-alpha", "newmark", "rk4", "dormand-prince"],
    cell,
};

fn cell(method: &str, row: &str, speed: &str) -> Cell {
    let (steps, damping) = row.split_once(", ").unwrap_or((row, "0.05"));
    let settings = [
        format!("motion.method={method}"),
        format!("motion.steps_per_mesh_cycle={steps}"),
        "motion.steps_per_resonance=0".to_owned(),
        format!("motion.mesh_damping_ratio={damping}"),
        format!("operation.speed_rpm={speed}"),
    ];
    judge::in_motion(FILE, OSCILLATOR, &settings, &FINER, TOLERANCE)
}
