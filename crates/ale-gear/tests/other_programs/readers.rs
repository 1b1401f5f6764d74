//! Files of ale-gear in the programs of others: Parquet in pyarrow, meshes in meshio and Gmsh, universal files in pyuff.

use std::process::Command;

use serde_json::Value;

use super::util::{ISO_SCENE, Scratch, repository};

/// What the script finds in a file.
fn read(scratch: &Scratch, words: [&str; 2]) -> Value {
    let script = repository().join("tests/scripts/other_readers.py");
    let read = Command::new("python3").arg(script).args(words).current_dir(scratch.path()).output().unwrap();
    assert!(read.status.success(), "{}", String::from_utf8_lossy(&read.stderr));
    serde_json::from_slice(&read.stdout).unwrap()
}

/// Names, numbers of rows and every bit.
pub fn pyarrow(_: ()) {
    let scratch = Scratch::new().file("a.toml", format!("{ISO_SCENE}[output]\nparquet = true\n"));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let found = read(&scratch, ["parquet", "o"]);
    assert_eq!((&found["same_names"], &found["different"]), (&Value::from(true), &Value::from(0)), "{found}");
    assert_eq!(found["rows"], serde_json::json!([32, 32]));
}

/// Both readers see the nodes, elements and names that the program tells, and Gmsh finds no element turned inside out.
pub fn gmsh_and_meshio(_: ()) {
    let mesher =
        "mesher = { order = 2, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";
    let scene = ISO_SCENE.replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}")).replace("model = \"iso\"\n", "");
    let scratch = Scratch::new().file("a.toml", scene);
    let made = scratch.ale_gear(["mesh", "generate", "a.toml", "--gear", "pinion", "-o", "p.msh"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let said: Vec<u64> = made.stdout.split(|c: char| !c.is_ascii_digit()).filter_map(|w| w.parse().ok()).collect();
    let found = read(&scratch, ["mesh", "p.msh"]);
    assert_eq!(found["nodes"], serde_json::json!([said[0], said[0]]), "{found}");
    assert_eq!(found["hexahedra"], serde_json::json!([said[1], said[1]]), "{found}");
    assert_eq!(found["same_names"], Value::from(true), "{found}");
    let names = found["names"].as_array().unwrap();
    assert!(names.contains(&"bore".into()) && names.contains(&"flank_left_29".into()), "{found}");
    assert!(found["least_det_j"].as_f64().unwrap() > 0.0, "{found}");
    assert!((found["half_width"].as_f64().unwrap() - 10.0).abs() < 1e-12, "{found}");
}

/// Every function of the universal file is a column of the table of bearing forces, to the digits of both.
pub fn pyuff(_: ()) {
    let scratch = Scratch::new();
    let file = repository().join("scenes/gearbox/two_stages.toml").display().to_string();
    let run = scratch.ale_gear(["run", file.as_str(), "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let found = read(&scratch, ["uff", "o"]);
    // Two meshes of three orders, six bearings of six components.
    assert_eq!(found["functions"], 2 * 3 * 6 * 6, "{found}");
    assert_eq!((&found["types"][0], &found["length_factor"]), (&Value::from(164), &Value::from(1000.0)), "{found}");
    // Spectra, complex and of double precision, even steps.
    assert_eq!(found["kind"], serde_json::json!([[12, 6, 1]]), "{found}");
    assert_eq!(found["units"], serde_json::json!([["Hz", "N"], ["Hz", "N mm"]]), "{found}");
    assert!(found["worst"].as_f64().unwrap() < 1e-11, "{found}");
    // First frequency and step have six digits.
    assert!(found["worst_hz"].as_f64().unwrap() < 1e-4, "{found}");
}
