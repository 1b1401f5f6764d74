//! What must hold of a result: steps that an explicit method bears, and certificates with their bounds.

use crate::util::{ISO_SCENE, Scratch, column, motion_scene};
use serde_json::Value;

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// Three mesh cycles at 300/min by an explicit method.
fn explicit(method: &str, steps: u32) -> String {
    motion_scene(3, &format!("run = \"span\"\nmethod = \"{method}\"\n"))
        .replace("steps_per_mesh_cycle = 16", &format!("steps_per_mesh_cycle = {steps}"))
        .replace("torque_nm = 150.0", "torque_nm = 150.0\nspeed_rpm = 300.0")
}

/// The number behind a word of a hint.
fn number_after(text: &str, word: &str) -> u32 {
    let rest = text.split_once(word).unwrap_or_else(|| panic!("no `{word}`: {text}")).1;
    rest.chars().take_while(char::is_ascii_digit).collect::<String>().parse().unwrap()
}

/// Steps beyond the limit are refused before the run, with a number that would do; with this number the motion is
/// bounded, with two thirds of it it is refused as well.
#[test]
fn steps_beyond_the_stability_limit_are_refused() {
    for method in ["rk4", "dormand-prince"] {
        let scratch = Scratch::new().file("long.toml", explicit(method, 16));
        let refused = scratch.ale_gear(["run", "long.toml", "--out", "o"]);
        assert_eq!((refused.code, refused.stdout.as_str()), (Some(1), ""), "{method}: {}", refused.stderr);
        assert!(refused.stderr.contains("is too long for the explicit method"), "{}", refused.stderr);
        assert_eq!(scratch.names(), ["long.toml"], "a refused run leaves something behind");
        let enough = number_after(&refused.stderr, "steps_per_mesh_cycle = ");
        let scratch =
            scratch.file("fine.toml", explicit(method, enough)).file("short.toml", explicit(method, 2 * enough / 3));
        let fine = scratch.ale_gear(["run", "fine.toml", "--out", "fine", "--json"]);
        assert_eq!(fine.code, Some(0), "{method}, {enough} steps: {}", fine.stderr);
        let summary = json(&fine.stdout);
        assert_eq!(summary["certificate"], "held");
        let largest = column(&scratch.read("fine/history.csv"), "dte_um").into_iter().fold(0.0, f64::max);
        let ste = summary["headline"]["mean_ste_um"].as_f64().unwrap();
        assert!(largest < 3.0 * ste, "{method}, {enough} steps: DTE of {largest} um, STE of {ste} um");
        let short = scratch.ale_gear(["run", "short.toml", "--out", "short"]);
        assert_eq!(short.code, Some(1), "{method}, {} steps: {}", 2 * enough / 3, short.stderr);
    }
}

/// With an error tolerance no limit is needed: the error shortens the steps.
#[test]
fn a_tolerance_needs_no_limit() {
    let text = explicit("rk4", 16).replace("cycles = 3\n", "cycles = 1\n") + "error_tolerance = 1e-4\n";
    let scratch = Scratch::new().file("a.toml", text);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--json"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(json(&run.stdout)["certificate"], "held");
}

/// A cheaper model with light bodies on stiff bearings.
#[test]
fn cheaper_models_know_their_limit() {
    let text = std::fs::read_to_string(crate::util::repository().join("scenes/seeds/004.toml")).unwrap();
    let text = text.replace("spectral_radius", "# spectral_radius");
    let scratch = Scratch::new().file("a.toml", text);
    let words =
        ["--set", "motion.method=\"rk4\"", "--set", "motion.steps_per_resonance=0", "--set", "analysis.cycles=4"];
    let run = |steps: &str, out: &str| {
        let steps = format!("motion.steps_per_mesh_cycle={steps}");
        let first = ["run", "a.toml", "--out", out, "--set", "motion.warm_up_cycles=2", "--set", &steps];
        scratch.command(&[&first[..], &words[..]].concat())
    };
    let refused = run("8", "long");
    assert_eq!(refused.code, Some(1), "{}", refused.stderr);
    assert!(refused.stderr.contains("is too long for the explicit method"), "{}", refused.stderr);
    let enough = number_after(&refused.stderr, "steps_per_mesh_cycle = ").to_string();
    let fine = run(&enough, "fine");
    assert_eq!(fine.code, Some(0), "{enough} steps: {}", fine.stderr);
}

/// A torque that bends the teeth by half a module: files are there and say that they do not hold, wherever one looks.
#[test]
fn a_result_that_does_not_hold_says_so_everywhere() {
    let failing = motion_scene(0, "")
        .split("kind = \"dynamic\"")
        .next()
        .unwrap()
        .replace("torque_nm = 150.0", "torque_nm = 30000.0");
    let scratch = Scratch::new().file("a.toml", failing).file("b.toml", ISO_SCENE);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(1), "{}\n{}", run.stdout, run.stderr);
    assert!(run.stderr.contains("check failed: deflection_over_module "), "{}", run.stderr);
    assert!(run.stderr.contains(", limit 0.3"), "{}", run.stderr);
    assert!(run.stdout.contains("CHECK FAILED"), "{}", run.stdout);
    let summary = json(&scratch.read("o/summary.json"));
    assert_eq!(summary["certificate"], "failed");
    let check = &summary["certificate_checks"]["deflection_over_module"];
    assert!(check["bound"] == 0.3 && check["value"].as_f64().is_none_or(|v| v > 0.3), "{check}");
    assert!(scratch.read("o/report.html").contains("This result failed a check."));

    let fine = scratch.ale_gear(["run", "b.toml", "--out", "p"]);
    assert_eq!((fine.code, fine.stderr.as_str()), (Some(0), ""));
    assert_eq!(json(&scratch.read("p/summary.json"))["certificate"], "held");
    assert!(!scratch.read("p/report.html").contains("failed a check"));

    let compared = scratch.ale_gear(["compare", "p", "o", "--out", "c"]);
    assert!(compared.stdout.contains("FAILED A CHECK: deflection_over_module"), "{}", compared.stdout);
    assert!(scratch.read("c/report.html").contains("FAILED A CHECK"));
    let again = scratch.ale_gear(["report", "o"]);
    assert!(again.stdout.contains("CHECK FAILED: deflection_over_module"), "{}", again.stdout);
    assert!(scratch.read("o/report.html").contains("This result failed a check."));
}

/// Steps so long that teeth leap over each other end the run at once, with where it happened and a hint; in a sweep
/// the speed has that for its reason, and where no speed is left the command fails.
#[test]
fn teeth_that_pass_through_each_other_end_the_run_there() {
    let long = |run: &str, rpm: u32| {
        motion_scene(3, &format!("{run}\nmethod = \"newmark\"\n"))
            .replace("steps_per_mesh_cycle = 16", "steps_per_mesh_cycle = 8")
            .replace("torque_nm = 150.0", &format!("torque_nm = 150.0\nspeed_rpm = {rpm}.0"))
    };
    let sweep = |from: u32, to: u32| {
        let sweep = format!("sweep = {{ from_rpm = {from}.0, to_rpm = {to}.0, speeds = 2, ways = [\"apart\"] }}");
        long(&format!("run = \"sweep\"\nperiodic_tolerance = 1e-2\n{sweep}"), 1000)
    };
    let scratch = Scratch::new()
        .file("a.toml", long("run = \"span\"", 20))
        .file("b.toml", sweep(20, 2000))
        .file("c.toml", sweep(20, 21));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""), "{}", run.stderr);
    for part in [" of cycle 1: teeth have passed through each other: ", "a.toml: at 0.1", "hint: take smaller steps "] {
        assert!(run.stderr.contains(part), "no `{part}`: {}", run.stderr);
    }
    assert_eq!(scratch.names(), ["a.toml", "b.toml", "c.toml"]);
    let run = scratch.ale_gear(["run", "b.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let rows = scratch.read("o/resonance.csv");
    let words: Vec<[bool; 2]> =
        rows.lines().skip(1).map(|l| [",failed,", "teeth have passed"].map(|w| l.contains(w))).collect();
    assert_eq!(words, [[true; 2], [false; 2]], "{rows}");
    let run = scratch.ale_gear(["run", "c.toml", "--out", "p"]);
    assert_eq!(run.code, Some(1), "{}{}", run.stdout, run.stderr);
    assert!(run.stderr.contains("teeth have passed through each other"), "{}", run.stderr);
}

/// Bounds of checks are those that the document says.
#[test]
fn bounds_are_those_of_the_document() {
    let document = std::fs::read_to_string(crate::util::repository().join("docs/outputs.md")).unwrap();
    let (_, section) = document.split_once("### Certificate").expect("a section of certificates");
    let scratch = Scratch::new().file("a.toml", motion_scene(2, "run = \"span\"\n")).file("b.toml", ISO_SCENE);
    let mut seen = std::collections::BTreeSet::new();
    for (file, model) in [("a.toml", "reduced"), ("a.toml", "mapped"), ("b.toml", "iso")] {
        let set = format!("analysis.model=\"{model}\"");
        let run = scratch.ale_gear(["run", file, "--out", "o", "--json", "--set", &set]);
        assert_eq!(run.code, Some(0), "{model}: {}", run.stderr);
        for (name, check) in json(&run.stdout)["certificate_checks"].as_object().unwrap() {
            let row = section.lines().find(|line| line.starts_with(&format!("| `{name}` |")));
            let told = row.unwrap_or_else(|| panic!("{name} has no row")).split('|').nth(2).unwrap().trim();
            assert_eq!(check["bound"].as_f64(), told.parse().ok(), "{name}: the document says {told}");
            seen.insert(name.clone());
        }
    }
    for name in ["energy_residual", "map_error", "map_excess", "pulling_force", "force_jump", "torque_residual"] {
        assert!(seen.contains(name), "no model has {name}: {seen:?}");
    }
}
