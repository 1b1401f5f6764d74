//! Backlash over load: rattle.

use super::{
    EnvelopeMap, judge,
    speed_damping_steps::{FILE, FINER, OSCILLATOR, TOLERANCE},
};

pub(super) const MAP: EnvelopeMap = EnvelopeMap {
    key: "f",
    name: "backlash over load, rattle",
    file: FILE,
    judged: "Peak to peak of the dynamic transmission error under a load that shakes by 20 N m, against steps of 1/256 mesh cycle: solved within 10 %.",
    columns: ("mean load, N m", &["0.5", "5", "15", "30", "100"]),
    rows: ("half backlash, um", &["0", "2", "10", "50", "200"]),
    layers: &[""],
    cell: |_, backlash, load| {
        let settings = [
            format!("operation.torque_nm={load}"),
            format!("mesh.half_backlash_um={backlash}"),
            "load.amplitude_nm=20".to_owned(),
            // Half the mesh frequency: the motion repeats itself after two mesh cycles.
            "load.frequency_hz=750".to_owned(),
        ];
        judge::in_motion(FILE, OSCILLATOR, &settings, &FINER, TOLERANCE)
    },
};
