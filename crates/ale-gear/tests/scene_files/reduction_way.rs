//! `[analysis] reduction`: which way gears go by themselves, that all ways end in the same results, and who may not
//! ask.

use crate::util::{ISO_SCENE, Scratch};

/// The default pair on small meshes, three positions.
fn scene(analysis: &str, output: &str) -> String {
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 3, elements_rim = 1 }\n";
    ISO_SCENE
        .replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}"))
        .replace("model = \"iso\"", &format!("{analysis}\npositions_per_cycle = 3"))
        + "[output]\nroot_stress = true\n"
        + output
}

/// The run's summary and its history.
fn run(analysis: &str, output: &str) -> (serde_json::Value, String) {
    let scratch = Scratch::new().file("a.toml", scene(analysis, output));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{analysis}: {}", run.stdout);
    assert!(run.stdout.contains("reduction, pinion"), "{}", run.stdout);
    (serde_json::from_str(&scratch.read("o/summary.json")).unwrap(), scratch.read("o/history.csv"))
}

/// One sector, a whole mesh that is found to be cyclic (ParaView files show all of it), and one factor of the whole
/// gear: the same degrees of freedom and the same history, root stress included.
#[test]
fn all_ways_end_in_the_same_results() {
    let (sector, by_sector) = run("model = \"reduced\"", "");
    let (_, by_whole) = run("model = \"reduced\"", "vtu = true\nvtu_every = 100\nfields = [\"displacement\"]\n");
    let (general, by_factor) = run("model = \"reduced\"\nreduction = \"general\"", "");
    assert_eq!(sector["reduction"], serde_json::json!(["cyclic sector", "cyclic sector"]));
    assert_eq!(general["reduction"], serde_json::json!(["general", "general"]));
    assert_eq!(sector["dof_before"], general["dof_before"]);
    assert_eq!(sector["dof_after"], general["dof_after"]);
    assert_eq!(sector["meshes"][0]["nodes"], general["meshes"][0]["nodes"]);
    assert_eq!(sector["meshes"][0]["elements"], general["meshes"][0]["elements"]);
    for other in [&by_whole, &by_factor] {
        for (a, b) in by_sector.lines().zip(other.lines()).skip(1) {
            for (i, (a, b)) in a.split(',').zip(b.split(',')).enumerate() {
                let [a, b]: [f64; 2] = [a, b].map(|v| v.parse().unwrap());
                // Residuals are round-off themselves.
                let same = (a - b).abs() <= 1e-8 * a.abs().max(b.abs()) || a.abs().max(b.abs()) < 1e-6 || a.is_nan();
                assert!(same, "column {i}: {a} and {b}");
            }
        }
    }
}

/// A model without reduction has no way of reduction.
#[test]
fn only_the_reduced_model_has_a_way() {
    for model in ["full", "iso"] {
        let analysis = format!("model = \"{model}\"\nreduction = \"general\"");
        let scratch = Scratch::new().file("a.toml", ISO_SCENE.replace("model = \"iso\"", &analysis));
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
        assert_eq!(run.code, Some(2), "{}", run.stdout);
        assert!(run.stderr.contains("`reduction` belongs to"), "{}", run.stderr);
    }
}
