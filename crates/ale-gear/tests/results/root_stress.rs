//! `[output] root_stress`: columns, headline, chart, and who may not ask for it.

use std::collections::HashMap;

use crate::util::{ISO_SCENE, Scratch, remark_words};

/// The default pair on small meshes.
fn scene(model: &str, output: &str) -> String {
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 3, elements_rim = 1 }\n";
    ISO_SCENE
        .replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}"))
        .replace("model = \"iso\"", &format!("model = \"{model}\"\npositions_per_cycle = 4"))
        + output
}

fn history(scratch: &Scratch, folder: &str) -> HashMap<String, Vec<f64>> {
    let csv = scratch.read(&format!("{folder}/history.csv"));
    let mut lines = csv.lines();
    let names: Vec<String> = lines.next().unwrap().split(',').map(str::to_owned).collect();
    let rows: Vec<Vec<f64>> = lines.map(|l| l.split(',').map(|v| v.parse().unwrap()).collect()).collect();
    assert!(rows.iter().all(|r| r.len() == names.len()), "ragged rows");
    names.into_iter().enumerate().map(|(i, name)| (name, rows.iter().map(|r| r[i]).collect())).collect()
}

/// Asked for, both gears have their columns, pair by pair too; the headline names the place of the largest of them.
#[test]
fn root_stress_is_written_when_asked_for() {
    let scratch = Scratch::new().file("a.toml", scene("reduced", "[output]\nroot_stress = true\n"));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stdout.contains("largest root tension, pinion"), "{}", run.stdout);
    let columns = history(&scratch, "o");
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    let root = &summary["headline"]["root_stress"];
    assert!(root["averaging"].as_str().unwrap().contains("polynomials through the most accurate points"), "{root}");
    assert!(root["definition"].as_str().unwrap().contains("20 deg tangent"), "{root}");
    for gear in ["pinion", "wheel"] {
        for (measure, sign) in [("max_principal", 1.0), ("min_principal", -1.0), ("von_mises", 1.0)] {
            let column = &columns[&format!("{gear}_root_stress_{measure}_mpa")];
            assert!(column.iter().all(|v| sign * v > 10.0), "{gear} {measure}: {column:?}");
            let worst = column.iter().fold(0.0f64, |m, v| m.max(sign * v));
            let place = &root[gear][measure];
            // Written with all digits; read back to the last one but round-off.
            let off = sign * place["stress_mpa"].as_f64().unwrap() / worst - 1.0;
            assert!(off.abs() < 1e-14, "{gear} {measure}: {place}, {worst} in the history");
            let r = place["radius_mm"].as_f64().unwrap();
            assert!((44.0..45.6).contains(&r) && place["tooth"].as_u64().unwrap() < 30, "{place}");
        }
        // Linear elements, two along the fillet: far off, and the program says so, beside the value and in a warning.
        let error = root[gear]["max_principal"]["estimated_error_percent"].as_f64().unwrap();
        assert!(error > 3.0, "{gear}: {error} %");
        let of_rows = &columns[&format!("{gear}_root_stress_estimated_error_percent")];
        assert!(of_rows.iter().any(|e| (e / error - 1.0).abs() < 1e-12), "{gear}: {error} %, {of_rows:?}");
        let told = format!("the {gear}'s root stress of");
        assert!(summary["remarks"].as_array().unwrap().iter().any(|w| remark_words(w).contains(&told)), "{summary}");
        // The gear's largest value is that of one of its loaded teeth.
        let all = &columns[&format!("{gear}_root_stress_max_principal_mpa")];
        let name = |k: i32| format!("{gear}_root_stress_max_principal_pair_{k}_mpa");
        for (i, all) in all.iter().enumerate() {
            let of_pairs = (-2..=2).filter_map(|k| columns.get(&name(k))).map(|c| c[i]).fold(0.0, f64::max);
            assert_eq!(of_pairs, *all, "{gear}, row {i}");
        }
    }
    let page = scratch.read("o/report.html");
    assert_eq!(page.matches("<svg").count(), 12);
    assert!(page.contains("Largest principal root stress, wheel"));
}

/// Not asked for, nothing of it appears.
#[test]
fn root_stress_is_left_out_by_default() {
    let scratch = Scratch::new().file("a.toml", scene("reduced", ""));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(!scratch.read("o/history.csv").contains("root_stress") && !run.stdout.contains("root tension"));
    assert_eq!(scratch.read("o/report.html").matches("<svg").count(), 10);
}

/// The model without a mesh has no fillets.
#[test]
fn the_iso_model_has_no_root_stress() {
    let scratch = Scratch::new().file("a.toml", ISO_SCENE.to_owned() + "[output]\nroot_stress = true\n");
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(2));
    assert_eq!(
        run.complaint(),
        "ale-gear: a.toml:18: `root_stress` needs a mesh, and the model \"iso\" has none\n\
         hint: leave it out, or use `model = \"reduced\"`\n"
    );
}
