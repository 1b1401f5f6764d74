//! `ale-gear compare`: runs of any kind side by side.

use super::vary::lumped_scene;
use crate::util::{ISO_SCENE, Scratch, column, motion_scene, repository};
use serde_json::Value;

/// A static run, the same with another torque, a motion and a run of the ladder.
fn runs() -> Scratch {
    let tiny = motion_scene(2, "run = \"span\"\n");
    let seed = std::fs::read_to_string(repository().join("scenes/seeds/004.toml")).unwrap();
    let scratch = Scratch::new().file("iso.toml", ISO_SCENE).file("motion.toml", tiny).file("ladder.toml", seed);
    let short = "motion.warm_up_cycles=4";
    for words in [
        &["run", "iso.toml", "--out", "a"][..],
        &["run", "iso.toml", "--out", "b", "--set", "operation.torque_nm=300"],
        &["run", "motion.toml", "--out", "m"],
        &["run", "ladder.toml", "--out", "l", "--set", "analysis.cycles=2", "--set", short],
    ] {
        let run = scratch.command(words);
        assert_eq!(run.code, Some(0), "{words:?}: {}", run.stderr);
    }
    scratch
}

#[test]
fn runs_of_all_kinds_stand_side_by_side() {
    let scratch = runs();
    let run = scratch.ale_gear(["compare", "a", "b"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    // ISO's stiffness is linear: twice the torque is twice the error.
    let line = run.stdout.lines().find(|l| l.trim_start().starts_with("mean STE [µm]")).unwrap();
    assert!(line.trim_end().ends_with("+100.000"), "{line}");
    let input = run.stdout.lines().find(|l| l.trim_start().starts_with("operation.torque_nm")).unwrap();
    assert_eq!(input.split_whitespace().collect::<Vec<_>>(), ["operation.torque_nm", "150.0", "300.0"]);
    assert_eq!(scratch.names().iter().filter(|n| n.starts_with("compare")).count(), 0, "files that nobody asked for");

    let run = scratch.ale_gear(["compare", "a", "m", "l", "--out", "c", "--json"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let found: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(found["runs"], serde_json::json!(["a", "m", "l"]));
    let row = |key: &str| found["numbers"].as_array().unwrap().iter().find(|r| r["key"] == key).cloned().unwrap();
    let (ste, dte) = (row("mean_ste_um"), row("mean_dte_um"));
    assert!(ste["values"][0].is_number() && ste["values"][1].is_number(), "{ste}");
    assert!(dte["values"][0].is_null() && dte["values"][2].is_number(), "{dte}");
    let difference = ste["values"][1].as_f64().unwrap() - ste["values"][0].as_f64().unwrap();
    assert_eq!(ste["differences"][0]["absolute"], difference);

    // Equilibrium and motion on one picture, over the last whole mesh cycle of each.
    let curves = scratch.read("c/compare_curves.csv");
    let error: Vec<&str> = curves.lines().filter(|l| l.starts_with("history,te_um,mesh_phase")).collect();
    for (folder, file_column, rows, over) in [("a", "ste_um", 32, 0), ("m", "dte_um", 16, 1), ("l", "dte_um", 64, 0)] {
        let own: Vec<f64> = error
            .iter()
            .filter(|l| l.contains(&format!(",{folder},")))
            .map(|l| l.rsplit(',').next().unwrap().parse().unwrap())
            .collect();
        let history = scratch.read(&format!("{folder}/history.csv"));
        let written = column(&history, file_column);
        // A motion has its rows at the ends of steps: the last one begins the next cycle.
        let end = written.len() - over;
        let mut last = written[end - rows..end].to_vec();
        let mut drawn = own.clone();
        last.sort_by(f64::total_cmp);
        drawn.sort_by(f64::total_cmp);
        assert_eq!(drawn, last, "{folder}: not the last cycle of {file_column}");
    }
    let page = scratch.read("c/report.html");
    assert!(!page.contains("src=\"http") && !page.contains("href=\"http"), "the page wants the network");
    for file in ["compare_te_um.svg", "compare_contact_line_length_mm.svg"] {
        assert!(scratch.read(&format!("c/{file}")).contains("<svg"), "{file}");
    }
    let csv = scratch.read("c/compare.csv");
    assert!(csv.starts_with("key,A,B,C,B_minus_A,B_minus_A_per_cent,C_minus_A,C_minus_A_per_cent\n"), "{csv}");

    let run = scratch.ale_gear(["compare", "m", "l", "--out", "c"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(scratch.read("c/compare_curves.csv").contains("history,dte_um,time_s,l,"), "motions are drawn over time");
}

#[test]
fn what_is_no_result_is_refused() {
    let scratch = Scratch::new().file("iso.toml", ISO_SCENE);
    assert_eq!(scratch.ale_gear(["run", "iso.toml", "--out", "a"]).code, Some(0));
    for (name, summary) in [("empty", None), ("other", Some("{\"program\": \"x\"}")), ("broken", Some("{"))] {
        std::fs::create_dir(scratch.path().join(name)).unwrap();
        if let Some(text) = summary {
            std::fs::write(scratch.path().join(name).join("summary.json"), text).unwrap();
        }
    }
    let newer = scratch.read("a/summary.json").replacen("\"schema\": 4", "\"schema\": 999", 1);
    std::fs::create_dir(scratch.path().join("newer")).unwrap();
    std::fs::write(scratch.path().join("newer/summary.json"), newer).unwrap();
    for (folder, said) in [
        ("nowhere", "nowhere: there is no such folder"),
        ("iso.toml", "iso.toml: is not a folder"),
        ("empty", "empty: has no summary.json"),
        ("other", "other: summary.json is of another program"),
        ("broken", "broken: summary.json is no JSON"),
        ("newer", "newer: summary.json has schema 999, this program reads 4"),
    ] {
        let run = scratch.ale_gear(["compare", "a", folder]);
        assert!(run.stderr.starts_with(&format!("ale-gear: {said}")), "{}", run.stderr);
        assert!(run.stderr.contains("\nhint: "), "{}", run.stderr);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
    }
    let clash = scratch.ale_gear(["compare", "a", "a", "--out", "./a"]);
    assert_eq!(clash.code, Some(2), "{}", clash.stdout);
    assert!(clash.stderr.contains("is one of the folders to compare"), "{}", clash.stderr);
}

/// A page that was lost comes back as it was, from what stands beside it, for a run of any kind.
#[test]
fn a_report_is_made_again_from_its_folder() {
    let scratch = runs();
    for folder in ["a", "m", "l"] {
        let page = scratch.read(&format!("{folder}/report.html"));
        std::fs::remove_file(scratch.path().join(folder).join("report.html")).unwrap();
        let run = scratch.ale_gear(["report", folder]);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
        assert!(scratch.read(&format!("{folder}/report.html")) == page, "{folder}: another page");
        assert!(
            scratch.ale_gear(["report", folder, "--output", "-"]).stdout == page,
            "{folder}: another page on stdout"
        );
    }
    std::fs::write(scratch.path().join("a/report.json.gz"), "no gzip").unwrap();
    let damaged = scratch.ale_gear(["report", "a"]);
    assert_eq!(damaged.code, Some(2));
    assert!(damaged.stderr.contains("hint: "), "{}", damaged.stderr);
    assert_eq!(scratch.ale_gear(["report", "nowhere"]).code, Some(2));
}

/// Answers to any kind of question are laid over each other, those to two kinds where they have a number or a column in
/// common: the same question asked in two ways.
#[test]
fn answers_to_any_question_are_compared() {
    let scratch = Scratch::new().file("iso.toml", ISO_SCENE);
    let vary = |out: &str, factor: &str| {
        let axis = format!("operation.torque_nm=100:{factor}:3");
        let words = ["vary", "iso.toml", "--vary", &axis, "--output", "mean_ste_um", "--out", out];
        let run = scratch.ale_gear(words);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
    };
    vary("a", "200");
    vary("b", "400");
    let run = scratch.ale_gear(["compare", "a", "b", "--out", "c"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let curves = scratch.read("c/compare_curves.csv");
    let of =
        |run: &str| curves.lines().filter(|l| l.starts_with(&format!("cases,mean_ste_um,torque_nm,{run},"))).count();
    assert_eq!([of("a"), of("b")], [3, 3], "{curves}");
    assert!(scratch.read("c/compare_cases_mean_ste_um.svg").contains("<svg"));
    // The page of any answer can be made again.
    for folder in ["a", "c"] {
        let page = scratch.read(&format!("{folder}/report.html"));
        assert!(scratch.ale_gear(["report", folder, "--output", "-"]).stdout == page, "{folder}: another page");
    }
    assert_eq!(scratch.ale_gear(["run", "iso.toml", "--out", "r"]).code, Some(0));
    let two = scratch.ale_gear(["compare", "a", "r"]);
    assert_eq!(
        two.complaint(),
        "ale-gear: a has neither a number of its headline nor a column of its rows in common with the others\nhint: \
         compare answers of which some numbers are the same\n"
    );
    assert_eq!(two.code, Some(2));
    // The peak to peak of a motion at three speeds: each alone, and each from the state of the last one.
    let scratch = Scratch::new().file("a.toml", lumped_scene());
    let speeds = ["--vary", "operation.speed_rpm=2000,2400,2800"];
    let each = [&["vary", "a.toml", "--output", "peak_to_peak_dte_um", "--out", "each"][..], &speeds].concat();
    let carry = [&["vary", "a.toml", "--start", "carry", "--out", "carry"][..], &speeds].concat();
    for words in [each, carry] {
        let run = scratch.command(&words);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
    }
    let run = scratch.ale_gear(["compare", "each", "carry", "--out", "c"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let curves = scratch.read("c/compare_curves.csv");
    let of = |run: &str| {
        curves.lines().filter(|l| l.starts_with(&format!("rows,peak_to_peak_dte_um,speed_rpm,{run}"))).count()
    };
    assert_eq!([of("each,"), of("carry")], [3, 6], "{curves}");
}
