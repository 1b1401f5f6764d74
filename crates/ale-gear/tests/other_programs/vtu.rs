//! ParaView files as others read them: meshio and PyVista find what `history.csv` and `summary.json` say.

use std::process::Command;

use serde_json::Value;

use super::util::{ISO_SCENE, Scratch, repository};

/// Angles, transmission error and centre distance from the nodes of the files are those of the run, and both readers
/// see the same. The nodes of a whole gear mean its centre; doubles are written, so that what is left is round-off of
/// sums over some thousand nodes.
pub fn meshio_and_pyvista(_: ()) {
    let mesher =
        "mesher = { order = 2, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";
    let scene = ISO_SCENE
        .replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}"))
        .replace("model = \"iso\"\n", "positions_per_cycle = 3\n[output]\nvtu = true\n");
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let script = repository().join("tests/scripts/vtu_readers.py");
    let read = Command::new("python3").arg(script).arg(scratch.path().join("o")).output().unwrap();
    assert!(read.status.success(), "{}", String::from_utf8_lossy(&read.stderr));
    let found: Value = serde_json::from_slice(&read.stdout).unwrap();
    assert_eq!(found["positions"], 3);
    let fields: Vec<&str> = found["fields"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert_eq!(fields, ["contact_pressure_mpa", "displacement_mm", "max_principal_mpa", "stress_mpa", "von_mises_mpa"]);
    for (key, tolerance) in
        [("time_s", 1e-12), ("pinion_angle_deg", 1e-9), ("te_um", 1e-6), ("centre_distance_mm", 1e-9), ("readers", 0.0)]
    {
        let off = found["worst"][key].as_f64().unwrap();
        assert!(off <= tolerance, "{key} is off by {off:e}: {found}");
    }
}
