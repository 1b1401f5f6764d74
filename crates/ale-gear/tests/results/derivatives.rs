//! Derivatives in `history.csv`, against differences of runs.

use crate::util::{ISO_SCENE, Scratch, chart_rows, column, motion_scene, tiny_at_rest};

const KEYS: [(&str, f64); 3] = [
    ("pinion.modification.tip_relief_um", 0.01),
    ("pinion.modification.tip_relief_start_roll_deg", 0.001),
    ("pair.misalignment.in_plane_of_action_um", 0.01),
];

fn relieved() -> String {
    tiny_at_rest(8)
        + "[pinion.modification]\ntip_relief_um = 10\ntip_relief_start_roll_deg = 25\nlead_crowning_um = 5\n\
           [pair.misalignment]\nin_plane_of_action_um = 4\n[contact]\nslices = 32\n"
}

/// Central differences of two whole runs are what the derivatives say, of transmission error, stiffness and force of the
/// pairs alike; where the two sides of a kink differ both are told, and the difference of the runs lies between.
#[test]
fn derivatives_are_those_of_central_differences() {
    let scratch = Scratch::new().file("a.toml", relieved());
    let list = KEYS.map(|(key, _)| key).join(",");
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--derivatives", &list]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let csv = scratch.read("o/history.csv");
    let value = |key: &str| [10.0, 25.0, 4.0][KEYS.iter().position(|(k, _)| *k == key).unwrap()];
    for (key, step) in KEYS {
        let [less, more] = [-step, step].map(|by| {
            let set = format!("{key}={}", value(key) + by);
            assert_eq!(scratch.ale_gear(["run", "a.toml", "--out", "side", "--set", &set]).code, Some(0), "{set}");
            scratch.read("side/history.csv")
        });
        for of in ["ste_um", "kinematic_te_um", "mesh_stiffness_n_per_um", "normal_force_pair_0_n"] {
            let name = format!("d_{of}_per_{}", key.replace('.', "_"));
            let found = column(&csv, &name);
            let wanted: Vec<f64> =
                column(&less, of).iter().zip(column(&more, of)).map(|(a, b)| (b - a) / (2.0 * step)).collect();
            let scale = found.iter().chain(&wanted).fold(0.0, |m: f64, v| m.max(v.abs()));
            assert_eq!(found.len(), 8, "{name}");
            for (i, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
                // Differences of runs by such steps: what curvature of the answer, and slices that come and go within a
                // step, leave.
                // A rate that is nowhere a millionth is the round-off of places over the step.
                let off = (found - wanted).abs() / scale.max(1e-6);
                assert!(off < 1e-3, "{name}, position {i}: {found} against {wanted}, scale {scale}");
            }
        }
        let name = |side: &str| format!("d_ste_um_{side}_per_{}", key.replace('.', "_"));
        let middle = column(&csv, &format!("d_ste_um_per_{}", key.replace('.', "_")));
        let sides = [column(&csv, &name("falling")), column(&csv, &name("growing"))];
        for (i, m) in middle.iter().enumerate() {
            assert!((0.5 * (sides[0][i] + sides[1][i]) - m).abs() <= 1e-12 * m.abs(), "{key}, position {i}");
        }
    }
    // What is differentiated is no other: the columns before are those of a run without.
    assert_eq!(scratch.ale_gear(["run", "a.toml", "--out", "plain"]).code, Some(0));
    let plain = scratch.read("plain/history.csv");
    for (line, own) in plain.lines().zip(csv.lines()) {
        assert!(own.starts_with(line), "{line}\n{own}");
    }
}

/// A plan takes derivatives of a case as it takes any column: those of a run with its values, bit by bit.
#[test]
fn a_plan_takes_the_derivatives_of_its_cases() {
    let (key, _) = KEYS[0];
    let names = ["d_ste_um", "d_kinematic_te_um"].map(|of| format!("{of}_per_{}", key.replace('.', "_")));
    let outputs = names.each_ref().map(|name| format!("\"largest({name})\""));
    let plan = format!("scene = \"a.toml\"\n[vary]\nkeys = [\"{key}=6,10\"]\noutput = [{}]\n", outputs.join(", "));
    let scene = relieved() + &format!("[output]\nderivatives = [\"{key}\"]\n");
    let scratch = Scratch::new().file("a.toml", scene).file("plan.toml", plan);
    for words in [["vary", "plan.toml", "--out", "o"], ["run", "a.toml", "--out", "of_10"]] {
        let run = scratch.ale_gear(words);
        assert_eq!(run.code, Some(0), "{words:?}: {}{}", run.stdout, run.stderr);
    }
    let [cases, rows] = ["o/cases.csv", "of_10/history.csv"].map(|file| scratch.read(file));
    for name in names {
        let largest = column(&rows, &name).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let of_cases: Vec<String> =
            chart_rows(&cases).iter().map(|row| row[&format!("largest_{name}")].clone()).collect();
        assert_eq!(of_cases[1].parse(), Ok(largest), "{name} of the second case");
        // Without load one relief is as good as another where the pair of teeth that leads has none.
        assert!(of_cases[0] != of_cases[1] || name.starts_with("d_kinematic"), "{name}: {of_cases:?}");
    }
}

/// What has no derivatives says so before any work, and what to do.
#[test]
fn what_has_no_derivatives_is_refused() {
    let refused = |scene: String, key: &str, said: &str| {
        let scratch = Scratch::new().file("a.toml", scene);
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--derivatives", key]);
        assert_eq!(run.code, Some(2), "{key}: {}", run.stdout);
        assert!(run.stderr.contains(said) && run.stderr.contains("hint: "), "`{said}` is not in {}", run.stderr);
        assert_eq!(scratch.names(), ["a.toml"]);
    };
    let relief = "pinion.modification.tip_relief_um";
    refused(ISO_SCENE.to_owned(), relief, "no other model than the reduced one at rest has derivatives");
    refused(motion_scene(1, ""), relief, "no other model than the reduced one at rest has derivatives");
    let auto = ISO_SCENE.replace("model = \"iso\"\n", "");
    refused(auto + "[accuracy]\nmean_ste = \"1 %\"\n", relief, "no other model than the reduced one");
    refused(
        tiny_at_rest(8) + "[contact]\nmethod = \"nodal\"\n",
        relief,
        "only loaded contact of slices has derivatives",
    );
    refused(tiny_at_rest(8), "pinion.teeth", "there is no derivative by `pinion.teeth`");
    refused(tiny_at_rest(8), "pinion.modification.tip_relief_start_roll_deg", "has no number in this scene");
}
