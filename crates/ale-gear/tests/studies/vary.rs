//! `ale-gear vary`: many cases of one scene, a row each.

use std::{
    collections::BTreeMap,
    process::Stdio,
    time::{Duration, Instant},
};

use ale_gear::scene::plan::Plan;

use crate::util::{ISO_SCENE, Scratch, chart_rows, column, five_teeth, motion_scene, tiny_at_rest};

const PLAN: &str = r#"
scene = "a.toml"
[vary]
keys = [
    "pinion.modification.drive.lead_crowning_um+wheel.modification.drive.lead_crowning_um~0:6",
    "operation.torque_nm=100,150,1e7",
]
output = ["peak_to_peak_ste_um", "ste_harmonics_um.1", "least(contact_line_length_mm)", "harmonic(ste_um, 2)"]
samples = 4
design = "sobol"
"#;

fn rows(scratch: &Scratch, file: &str) -> Vec<BTreeMap<String, String>> {
    chart_rows(&scratch.read(file))
}

/// A misspelt number is told before a case is solved: nothing is begun, also where rows of cases are made apart.
#[test]
fn numbers_that_no_case_will_have_are_told_before_any_work() {
    let plan = |wanted: &str| PLAN.replace("\"ste_harmonics_um.1\"", &format!("\"{wanted}\""));
    for (wanted, said) in [
        ("mean_ste_u", "the headline has no `mean_ste_u`\nhint: did you mean `mean_ste_um`?"),
        ("ste_harmonics_um.8", "not a number\nhint: it is a list: write `ste_harmonics_um.0` .. `ste_harmonics_um.7`"),
        ("mean(max_pressure_mp)", "no column `max_pressure_mp`\nhint: did you mean \"max_pressure_mpa\"?"),
    ] {
        let scratch = Scratch::new().file("a.toml", five_teeth()).file("plan.toml", plan(wanted));
        for words in [&["vary", "plan.toml", "--out", "o"][..], &["vary", "plan.toml", "--cases", "0..2", "--out", "o"]]
        {
            let run = scratch.command(words);
            assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{}", run.stderr);
            assert!(run.stderr.starts_with("ale-gear: plan.toml: ") && run.stderr.contains(said), "{}", run.stderr);
            assert_eq!(scratch.names(), ["a.toml", "plan.toml"], "work was begun");
        }
    }
    let scratch = Scratch::new().file("a.toml", motion_scene(1, ""));
    let words =
        ["vary", "a.toml", "--out", "o", "--vary", "operation.torque_nm=100,150", "--output", "max_pressure_mp"];
    let run = scratch.ale_gear(words);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("did you mean `max_pressure_mpa`?"), "{}", run.stderr);
    assert_eq!(scratch.names(), ["a.toml"], "work was begun");
}

/// A row has the numbers of a run with its values, bit by bit; a load that no tooth stands is a row that says so.
#[test]
fn a_row_has_the_numbers_of_a_run() {
    let scratch = Scratch::new().file("a.toml", five_teeth()).file("plan.toml", PLAN);
    let run = scratch.ale_gear(["vary", "plan.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    assert!(run.stdout.contains("4 of 12 cases have no result"), "{}", run.stdout);
    let all = rows(&scratch, "o/cases.csv");
    assert_eq!(all.len(), 12);
    for (i, row) in all.iter().enumerate() {
        assert_eq!(row["case"], i.to_string());
        let torque = &row["operation.torque_nm"];
        if torque == "10000000" {
            assert_eq!((row["status"].as_str(), row["peak_to_peak_ste_um"].as_str()), ("failed", "NaN"), "{row:?}");
            assert!(row["reason"].contains("would bend the teeth"), "{row:?}");
            continue;
        }
        assert_eq!((row["status"].as_str(), row["reason"].as_str()), ("solved", ""), "{row:?}");
        if i % 6 != 0 {
            continue;
        }
        let crowning = &row["pinion.modification.drive.lead_crowning_um"];
        let set = |gear: &str| format!("{gear}.modification.drive.lead_crowning_um={crowning}");
        let (out, torque) = (format!("r{i}"), format!("operation.torque_nm={torque}"));
        let words = ["run", "a.toml", "--out", &out, "--set", &set("pinion"), "--set", &set("wheel"), "--set", &torque];
        let single = scratch.command(&words);
        assert_eq!(single.code, Some(0), "{}", single.stderr);
        let summary: serde_json::Value = serde_json::from_str(&scratch.read(&format!("{out}/summary.json"))).unwrap();
        let headline = &summary["headline"];
        let number = |name: &str| row[name].parse::<f64>().unwrap();
        assert_eq!(Some(number("peak_to_peak_ste_um")), headline["peak_to_peak_ste_um"].as_f64(), "case {i}");
        assert_eq!(Some(number("ste_harmonics_um.1")), headline["ste_harmonics_um"][1].as_f64(), "case {i}");
        assert_eq!(number("harmonic_2_ste_um"), number("ste_harmonics_um.1"), "case {i}");
        let lines = column(&scratch.read(&format!("{out}/history.csv")), "contact_line_length_mm");
        let least = lines.iter().copied().fold(f64::INFINITY, f64::min);
        assert_eq!(number("least_contact_line_length_mm"), least, "case {i}");
    }
}

/// Killed again and again, and with other numbers of threads, a run comes to the same bytes as in one piece; nothing is
/// done twice, and nothing is left behind.
#[test]
fn a_killed_run_goes_on() {
    let words = |out: &'static str, threads: &'static str| {
        let vary = ["--vary", "operation.torque_nm=50:200:150", "--output", "mean_ste_um"];
        [&["vary", "a.toml", "--out", out, "--threads", threads][..], &vary[..]].concat()
    };
    let scratch = Scratch::new().file("a.toml", five_teeth());
    let whole = scratch.command(&words("whole", "1"));
    assert_eq!(whole.code, Some(0), "{}", whole.stderr);
    let done = scratch.path().join("cut.cases");
    let lines = || std::fs::read_to_string(&done).map_or(0, |text| text.lines().count());
    for killed in 1..=3 {
        let mut program = scratch.program();
        let threads = if killed == 2 { "1" } else { "2" };
        let mut child =
            program.args(words("cut", threads)).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let (before, begun) = (lines(), Instant::now());
        while lines() < before + 20 && child.try_wait().unwrap().is_none() && begun.elapsed() < Duration::from_secs(60)
        {
            std::thread::sleep(Duration::from_millis(2));
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let cut = scratch.command(&words("cut", "2"));
    assert_eq!(cut.code, Some(0), "{}", cut.stderr);
    for file in ["cases.csv", "cases.parquet"] {
        let [a, b] = ["whole", "cut"].map(|o| std::fs::read(scratch.path().join(o).join(file)).unwrap());
        assert!(a == b, "{file} differs");
    }
    assert_eq!(rows(&scratch, "cut/cases.csv").len(), 150);
    assert_eq!(scratch.names(), ["a.toml", "cut", "whole"]);
}

/// A pair on springs whose mesh needs no finite elements, for two mesh cycles.
pub fn lumped_scene() -> String {
    let spring = |gear: &str| {
        format!(
            "[{gear}.bearing]\nstiffness_x_n_per_mm = 2e5\nstiffness_y_n_per_mm = 2e5\nstiffness_z_n_per_mm = 1e5\n"
        )
    };
    let scene = ISO_SCENE.replace("model = \"iso\"", "model = \"lumped8\"\ncycles = 2");
    format!(
        "{scene}{}{}[mesh]\nstiffness_from = \"iso\"\n[motion]\nsteps_per_mesh_cycle = 64\nrun = \"span\"\n",
        spring("pinion"),
        spring("wheel")
    )
}

/// Cases in time have the numbers of runs of any model to the bit. Nothing is written for them on the way: there is no
/// place where temporary files could go.
#[test]
fn motions_are_cases_as_well() {
    let plan = "scene = \"a.toml\"\n[vary]\nkeys = [\"operation.speed_rpm=900,1100\"]\n\
                output = [\"peak_to_peak(dte_um)\", \"rms_dte_um\", \"mean_wheel_force_n.2\"]\n";
    let reduced = motion_scene(1, "run = \"span\"\n");
    let mapped = reduced.replace("kind = \"dynamic\"", "kind = \"dynamic\"\nmodel = \"mapped\"");
    for scene in [reduced, mapped, lumped_scene()] {
        let scratch = Scratch::new().file("a.toml", &scene).file("plan.toml", plan);
        let mut program = scratch.program();
        let nowhere = scratch.path().join("nowhere");
        let run = Scratch::done(program.args(["vary", "plan.toml", "--out", "o"]).env("TMPDIR", &nowhere));
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
        assert_eq!(scratch.names(), ["a.toml", "o", "plan.toml"]);
        let cases = scratch.read("o/cases.csv");
        for (case, speed) in ["900", "1100"].into_iter().enumerate() {
            let (out, speed) = (format!("r{case}"), format!("operation.speed_rpm={speed}"));
            let single = scratch.command(&["run", "a.toml", "--out", &out, "--set", &speed]);
            assert_eq!(single.code, Some(0), "{}", single.stderr);
            let dte = column(&scratch.read(&format!("{out}/history.csv")), "dte_um");
            let [low, high] = dte.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| [a.min(x), b.max(x)]);
            let text = scratch.read(&format!("{out}/summary.json"));
            let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
            let headline = &summary["headline"];
            let expected = [
                high - low,
                headline["rms_dte_um"].as_f64().unwrap(),
                headline["mean_wheel_force_n"][2].as_f64().unwrap(),
            ];
            let names = ["peak_to_peak_dte_um", "rms_dte_um", "mean_wheel_force_n.2"];
            assert_eq!(names.map(|name| column(&cases, name)[case]), expected, "{speed}: {scene}");
        }
    }
}

/// Every complaint comes before any work, and names what it is about.
#[test]
fn words_of_a_plan_are_checked_first() {
    let scratch = Scratch::new().file("a.toml", five_teeth());
    let plan = |text: &str| {
        std::fs::write(scratch.path().join("plan.toml"), text).unwrap();
        let run = scratch.ale_gear(["vary", "plan.toml", "--out", "o"]);
        assert_eq!(run.code, Some(2), "{text}: {}", run.stderr);
        run.complaint()
    };
    let whole = |scene: &str, keys: &str, output: &str, more: &str| {
        format!("scene = \"{scene}\"\n[vary]\nkeys = [{keys}]\noutput = [{output}]\n{more}")
    };
    let (torque, mean) = ("\"operation.torque_nm=1,2\"", "\"mean_ste_um\"");
    let keys = |keys: &str| whole("a.toml", keys, mean, "");
    for (text, said) in [
        (whole("a.toml", torque, mean, "").replace("scene = \"a.toml\"\n", ""), "a plan without `scene`"),
        (keys(""), "nothing is varied"),
        (whole("a.toml", torque, "", ""), "a plan that asks for nothing"),
        (whole("b.toml", torque, mean, ""), "\"b.toml\" cannot be read"),
        (whole("a.toml", torque, mean, "sampels = 3\n"), "did you mean `samples`"),
        (whole("a.toml", torque, mean, "design = \"sobo\"\n"), "did you mean \"sobol\""),
        (keys("\"operation.torque_nm=1:2\""), "say how many, as `=1:2:9`, or draw them, as `~1:2`"),
        (keys(&format!("{torque}, {torque}")), "`operation.torque_nm` is varied twice"),
        (whole("a.toml", torque, &format!("{mean}, {mean}"), ""), "`mean_ste_um` is asked for twice"),
        (keys("\"operation.torqe_nm=1,2\""), "torqe_nm"),
        (keys("\"operation.torque_nm=\""), "`` is not a number"),
        (keys("\"operation.torque_nm=1,nan\""), "`NaN` is not a value"),
        (keys("\"operation.torque_nm~normal:1:0\""), "a standard deviation is above 0"),
        (keys("\"operation.torque_nm~3:1\""), "`from` lies below `to`"),
        (whole("a.toml", torque, "\"meen(ste_um)\"", ""), "did you mean `mean(..)`?"),
        (whole("a.toml", torque, "\"mean(ste_um, 2)\"", ""), "an order goes with `harmonic(..)`"),
        (whole("a.toml", torque, "\"harmonic(ste_um, 0)\"", ""), "an order is a number, 1 to 1000"),
    ] {
        let complaint = plan(&text);
        assert!(complaint.contains(said), "{text}\n{complaint}");
    }
    for (words, said) in [
        (&["--vary", "operation.torque_nm=1"][..], "`--output` says what is wanted"),
        (&["--vary", "operation.torque_nm", "--output", "mean_ste_um"], "neither `=` (each value) nor `~` (drawn)"),
        (&["--vary", "operation.torque_nm=1:2:0", "--output", "mean_ste_um"], "`0` is not a number of values"),
        (&["--vary", "operation.torque_nm~a:2", "--output", "mean_ste_um"], "`a` is not a number"),
        (&["--samples", "3"], "a plan file says samples and seed itself"),
        (
            &["--vary", "operation.torque_nm~1:2", "--samples", "0", "--output", "mean_ste_um"],
            "--samples 0: allowed is 1 .. 10000000",
        ),
    ] {
        let run = scratch.command(&[&["vary", "a.toml", "--out", "o"][..], words].concat());
        assert!(run.code == Some(2) && run.stderr.contains(said), "{words:?}: {}", run.stderr);
    }
    assert_eq!(scratch.names(), ["a.toml", "plan.toml"]);
}

/// A plan may stand in the document that it varies: the rows are those of a file of its own, and the document without it
/// is what every other command takes.
#[test]
fn a_plan_stands_in_its_document_or_beside_it() {
    let table = "[vary]\nkeys = [\"operation.torque_nm=70,90\"]\noutput = [\"mean_ste_um\"]\n";
    let scratch = Scratch::new()
        .file("a.toml", five_teeth())
        .file("plan.toml", format!("scene = \"a.toml\"\n{table}"))
        .file("own.toml", format!("{}{table}", five_teeth()));
    for (file, out) in [("plan.toml", "beside"), ("own.toml", "own")] {
        let run = scratch.ale_gear(["run", file, "--out", out]);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{file}: {}", run.stdout);
    }
    assert_eq!(scratch.read("beside/cases.csv"), scratch.read("own/cases.csv"));
    let [own, plain] = ["own.toml", "a.toml"].map(|file| scratch.ale_gear(["geometry", file]));
    assert_eq!((own.code, &own.stdout), (Some(0), &plain.stdout), "{}", own.stderr);
    let words =
        ["vary", "own.toml", "--vary", "operation.torque_nm=70,90", "--output", "mean_ste_um", "--out", "words"];
    let run = scratch.ale_gear(words);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(scratch.read("words/cases.csv"), scratch.read("own/cases.csv"));
    let wrong = format!("{}{}", five_teeth(), table.replace("keys", "key"));
    std::fs::write(scratch.path().join("wrong.toml"), wrong).unwrap();
    let run = scratch.ale_gear(["run", "wrong.toml", "--out", "x"]);
    assert!(run.code == Some(2) && run.stderr.contains("did you mean `keys`"), "{}", run.stderr);
    // A typo in the pair is told at its line, and two questions in one document are refused by all who are asked one.
    let typo = format!("{}{table}", five_teeth().replacen("teeth", "teeht", 1));
    std::fs::write(scratch.path().join("typo.toml"), typo).unwrap();
    for words in [&["run", "typo.toml", "--out", "x"][..], &["geometry", "typo.toml"]] {
        let run = scratch.command(words);
        assert!(run.code == Some(2) && run.stderr.contains("did you mean `teeth`"), "{words:?}: {}", run.stderr);
    }
    let both = format!("{}{table}[optimise]\nevaluations = 3\n", five_teeth());
    std::fs::write(scratch.path().join("both.toml"), both).unwrap();
    for command in ["run", "vary", "optimise"] {
        let run = scratch.ale_gear([command, "both.toml", "--out", "x"]);
        assert!(run.code == Some(2) && run.stderr.contains("[vary] and [optimise]"), "{command}: {}", run.stderr);
    }
}

/// `run` takes a plan as `vary` does; `--set` holds for the scene of all cases, behind what the plan sets itself; words of
/// a single run are refused.
#[test]
fn a_plan_is_run_as_any_document() {
    let plan = "scene = \"a.toml\"\nset = [\"operation.torque_nm=70\"]\n[vary]\nkeys = [\"contact.friction=0,0.05\"]\n\
                output = [\"mean_ste_um\"]\n";
    let scratch = Scratch::new().file("a.toml", five_teeth()).file("plan.toml", plan);
    for words in [&["vary", "plan.toml", "--out", "v"][..], &["run", "plan.toml", "--out", "r"]] {
        let done = scratch.command(words);
        assert_eq!((done.code, done.stderr.as_str()), (Some(0), ""), "{words:?}");
    }
    assert_eq!(scratch.read("v/cases.csv"), scratch.read("r/cases.csv"));
    let set = scratch.ale_gear(["run", "plan.toml", "--out", "s", "--set", "operation.torque_nm=90", "--json"]);
    let summary: serde_json::Value =
        serde_json::from_str(&set.stdout).unwrap_or_else(|e| panic!("{e}: {}", set.stderr));
    assert_eq!(summary["kind"], "plan");
    let ste = |folder: &str| crate::util::column(&scratch.read(&format!("{folder}/cases.csv")), "mean_ste_um")[0];
    assert!(ste("s") > 1.1 * ste("r"), "{} {}", ste("s"), ste("r"));
    let refused = scratch.ale_gear(["run", "plan.toml", "--out", "t", "--resume"]);
    assert!(refused.code == Some(2) && refused.stderr.contains("`--resume` is for single runs"), "{}", refused.stderr);
    assert!(!scratch.path().join("t").exists());
}

/// A number that the headline has not is named with what may have been meant, and a plan without any result is none.
#[test]
fn a_plan_without_a_result_fails() {
    let scratch = Scratch::new().file("a.toml", five_teeth());
    let words = ["--vary", "operation.torque_nm=1e7,2e7", "--output", "peak_to_peak_ste_um", "--out", "o"];
    let run = scratch.command(&[&["vary", "a.toml"][..], &words].concat());
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    for said in ["no case has a result", "would bend the teeth", "`cases.csv` in o"] {
        assert!(run.stderr.contains(said), "{said}: {}", run.stderr);
    }
}

/// Pitch deviations of a class: a row tells F_p of the gear that was drawn, its other numbers are those of a run with
/// that gear's list; pieces make the bytes of one machine, another seed makes other gears, and no axis the other's.
#[test]
fn pitch_deviations_are_drawn_tooth_by_tooth() {
    let plan = "scene = \"a.toml\"\n[vary]\nsamples = 4\nkeys = [\"pinion.pitch_errors_um~iso1328:7\", \"wheel.pitch_errors_um~iso1328:7\"]\n\
                output = [\"mean_ste_um\"]\n";
    let scratch = Scratch::new().file("a.toml", five_teeth()).file("plan.toml", plan);
    let run = scratch.ale_gear(["vary", "plan.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let (all, parsed) = (rows(&scratch, "o/cases.csv"), Plan::read(&scratch.path().join("plan.toml")).unwrap());
    for (case, row) in all.iter().enumerate() {
        assert_eq!(row["status"], "solved", "{row:?}");
        let machine = parsed.machine(case).unwrap();
        let scene = machine.pair().unwrap();
        for (name, gear) in [("pinion", &scene.pinion), ("wheel", &scene.wheel)] {
            let list = &gear.pitch_errors_um;
            assert_eq!(list.len(), gear.teeth as usize);
            let [low, high] = list.iter().fold([f64::MAX, f64::MIN], |[a, b], &e| [a.min(e), b.max(e)]);
            let told: f64 = row[&format!("{name}.pitch_errors_um")].parse().unwrap();
            assert!((told - (high - low)).abs() < 1e-12, "case {case}: {told} um told of {list:?}");
        }
        assert_ne!(scene.pinion.pitch_errors_um, scene.wheel.pitch_errors_um, "case {case}");
        if case == 0 {
            let list = |name: &str, list: &[f64]| format!("{name}.pitch_errors_um={list:?}");
            let words = [list("pinion", &scene.pinion.pitch_errors_um), list("wheel", &scene.wheel.pitch_errors_um)];
            let run = scratch.ale_gear(["run", "a.toml", "--out", "r", "--set", &words[0], "--set", &words[1]]);
            assert_eq!(run.code, Some(0), "{}", run.stderr);
            let summary: serde_json::Value = serde_json::from_str(&scratch.read("r/summary.json")).unwrap();
            let mean = row["mean_ste_um"].parse::<f64>().ok();
            assert_eq!(mean, summary["headline"]["mean_ste_um"].as_f64(), "a run with the list");
        }
    }
    for range in ["0..1", "1..4"] {
        let run = scratch.ale_gear(["vary", "plan.toml", "--cases", range, "--out", &format!("{}.csv", &range[..1])]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
    }
    assert_eq!(scratch.ale_gear(["merge", "plan.toml", "1.csv", "0.csv", "--out", "m"]).code, Some(0));
    assert_eq!(scratch.read("m/cases.csv"), scratch.read("o/cases.csv"));
    let words = ["vary", "a.toml", "--vary", "pinion.pitch_errors_um~iso1328:7", "--output", "mean_ste_um"];
    for (seed, out) in [("1", "s1"), ("2", "s2")] {
        let run = scratch.command(&[&words[..], &["--samples", "2", "--seed", seed, "--out", out]].concat());
        assert_eq!(run.code, Some(0), "{}", run.stderr);
    }
    assert_ne!(scratch.read("s1/cases.csv"), scratch.read("s2/cases.csv"));
}

/// What pitch deviations are not drawn by is refused with what to write.
#[test]
fn pitch_deviations_want_a_class() {
    let scratch = Scratch::new().file("a.toml", five_teeth());
    for (word, said) in [
        ("pinion.pitch_errors_um=1,2", "within a class, as `~iso1328:6`"),
        ("pinion.pitch_errors_um~iso1328:0", "a tolerance class is a number, 1 to 11"),
        ("operation.torque_nm~iso1328:6", "ISO 1328 has no tolerance for `operation.torque_nm`"),
        ("pinion.pitch_errors_um~iso1328:12", "a tolerance class is a number, 1 to 11"),
        ("pinion.pitch_errors_um~0:5", "drawn together, within a class"),
        ("pinion.pitch_errors_um+wheel.pitch_errors_um~iso1328:6", "each gear are drawn by a word of its own"),
    ] {
        let file = format!("scene = \"a.toml\"\n[vary]\nkeys = [\"{word}\"]\noutput = [\"mean_ste_um\"]\n");
        std::fs::write(scratch.path().join("p.toml"), file).unwrap();
        let run = scratch.ale_gear(["vary", "p.toml", "--out", "o"]);
        assert!(run.code == Some(2) && run.stderr.contains(said), "{word}: {}", run.stderr);
        assert!(run.stderr.contains("p.toml:3: "), "{word}: {}", run.stderr);
        let run = scratch.ale_gear(["vary", "a.toml", "--vary", word, "--output", "mean_ste_um", "--out", "o"]);
        assert!(run.code == Some(2) && run.stderr.contains(said), "{word}: {}", run.stderr);
    }
}

/// Single cases have reports of their own on request: whole results, linked in the table, with the row's numbers bit by
/// bit.
#[test]
fn the_report_of_a_case_has_the_numbers_of_its_row() {
    // The third torque of each sample is none.
    let plan = PLAN.replace("1e7", "-1");
    let scratch = Scratch::new().file("a.toml", tiny_at_rest(8)).file("plan.toml", plan);
    let run = scratch.ale_gear(["vary", "plan.toml", "--out", "o", "--reports", "1", "--report-case", "0,2"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let all = rows(&scratch, "o/cases.csv");
    let number = |case: usize, name: &str| all[case][name].parse::<f64>().ok();
    let best = (0..all.len()).filter(|&i| number(i, "peak_to_peak_ste_um").is_some());
    let best = best
        .min_by(|&a, &b| {
            all[a]["peak_to_peak_ste_um"]
                .parse::<f64>()
                .unwrap()
                .total_cmp(&all[b]["peak_to_peak_ste_um"].parse().unwrap())
        })
        .unwrap();
    let page = scratch.page("o/report.html");
    assert!(!page.contains("cases/2/") && !scratch.path().join("o/cases/2").exists());
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    assert_eq!(summary["headline"]["outputs"]["peak_to_peak_ste_um"]["least_case"], best);
    let mut reports = vec![0, best];
    reports.dedup();
    assert_eq!(summary["reports"], serde_json::json!(reports));
    let headline = |folder: &str| -> serde_json::Value {
        let text = scratch.read(&format!("{folder}/summary.json"));
        serde_json::from_str::<serde_json::Value>(&text).unwrap()["headline"].take()
    };
    for case in reports {
        assert!(page.contains(&format!("<a href=\"cases/{case}/report.html\">{case}</a>")), "case {case}");
        assert!(scratch.read(&format!("o/cases/{case}/report.html")).contains("<svg"), "case {case}");
        let own = headline(&format!("o/cases/{case}"));
        assert_eq!(own["peak_to_peak_ste_um"].as_f64(), number(case, "peak_to_peak_ste_um"), "case {case}");
        assert_eq!(own["ste_harmonics_um"][1].as_f64(), number(case, "harmonic_2_ste_um"), "case {case}");
    }
    // One case by itself, from the plan alone; the folder of a plan with reports may be replaced.
    let single = scratch.ale_gear(["run", "plan.toml", "--case", "1", "--out", "one"]);
    assert_eq!(single.code, Some(0), "{}", single.stderr);
    assert_eq!(headline("one")["peak_to_peak_ste_um"].as_f64(), number(1, "peak_to_peak_ste_um"));
    assert_eq!(scratch.ale_gear(["vary", "plan.toml", "--out", "o"]).code, Some(0));
    let beyond = scratch.ale_gear(["vary", "plan.toml", "--out", "p", "--report-case", "12"]);
    assert!(beyond.code == Some(2) && beyond.stderr.contains("there is no case 12"), "{}", beyond.stderr);
    assert!(beyond.stderr.contains("from 0 to 11") && !scratch.path().join("p").exists(), "{}", beyond.stderr);
}

/// A Harris map is one command: peak-to-peak STE over the torque, a curve for each relief, and over both a map with its
/// least value marked. Each relief is flattest at a load of its own, the deeper one at the higher load.
#[test]
fn a_harris_map_is_one_command() {
    let relief =
        |gear: &str| format!("[{gear}.modification.drive]\ntip_relief_um = 0\ntip_relief_start_diameter_mm = 92\n");
    let scene = tiny_at_rest(8).replace("helix_angle_deg = 20.0", "helix_angle_deg = 0.0");
    let scratch = Scratch::new().file("a.toml", scene + &relief("pinion") + &relief("wheel"));
    let reliefs = "pinion.modification.drive.tip_relief_um+wheel.modification.drive.tip_relief_um=4,8";
    let words =
        ["vary", "a.toml", "--out", "o", "--harris", "--vary", reliefs, "--set", "analysis.positions_per_cycle=6"];
    let run = scratch.command(&words);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let all = rows(&scratch, "o/cases.csv");
    let of = |relief: &str| -> Vec<(f64, f64)> {
        let own = all.iter().filter(|row| row["pinion.modification.drive.tip_relief_um"] == relief);
        own.map(|row| (row["operation.torque_nm"].parse().unwrap(), row["peak_to_peak_ste_um"].parse().unwrap()))
            .collect()
    };
    let flattest = |relief: &str| of(relief).into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0;
    assert_eq!((of("4").len(), of("4")[0].0, of("8")[13].0), (14, 15.0, 210.0));
    assert!(flattest("4") < flattest("8"), "{:?} {:?}", of("4"), of("8"));
    let page = scratch.read("o/report.html");
    assert!(page.contains("tip relief 4 µm") && page.contains("tip relief 8 µm"), "a curve for each relief");
    assert!(page.contains("\"mark\":{\"at\":[") && page.contains("least: "), "a map with its optimum");
    assert!(
        page.contains("--harris --vary &#x27;") && page.contains("analysis.positions_per_cycle=6"),
        "how to make it again"
    );
}

/// Samples over two keys are dots in the colours of the number; over a torque that is gone through they are quantiles.
#[test]
fn drawn_samples_are_coloured_dots() {
    let scratch = Scratch::new().file("a.toml", ISO_SCENE);
    let keys = ["--vary", "pair.face_width_mm~15:20", "--vary", "wheel.thickness_allowance_mm~0:0.1"];
    let base = [&["vary", "a.toml", "--out", "o", "--output", "mean_ste_um", "--samples", "7"], &keys[..]].concat();
    assert_eq!(scratch.command(&base).code, Some(0));
    let page = scratch.read("o/report.html");
    let dots = page.split("\"dots\":[[").nth(1).expect("coloured dots").split("]]").next().unwrap();
    assert_eq!(dots.matches("],[").count(), 6, "seven samples: {dots}");
    assert!(!page.contains("90 % of samples"));
    let torques = [&base[..], &["--vary", "operation.torque_nm=50,100"]].concat();
    assert_eq!(scratch.command(&torques).code, Some(0));
    assert!(scratch.read("o/report.html").contains("90 % of samples"));
}

/// Numbers of a rating under a load spectrum are those of a run by itself, where each load is solved as well: alone, and
/// beside numbers that need none.
#[test]
fn ratings_of_cases_have_the_loads_of_a_run() {
    let gear = "material = \"18CrNiMo7-6\"\nflank_roughness_rz_um = 4.8\nroot_roughness_rz_um = 20.0\n";
    let rating = format!(
        "[pair.misalignment]\nin_plane_of_action_um = 20.0\n[rating]\nlife_h = 2e4\napplication_factor = 1.25\n\
         tolerance_class = 6\nlubricant = \"mineral VG 220\"\nspectrum = \"loads.csv\"\n[rating.pinion]\n{gear}[rating.wheel]\n{gear}"
    );
    let scratch = Scratch::new()
        .file("a.toml", tiny_at_rest(4) + &rating)
        .file("loads.csv", "torque_nm,speed_rpm,share\n100,1000,1\n40,1000,3\n");
    assert_eq!(scratch.ale_gear(["run", "a.toml", "--set", "operation.torque_nm=100", "--out", "run"]).code, Some(0));
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("run/summary.json")).unwrap();
    let wanted = ["/rating/spectrum/wheel/pitting_damage", "/rating/local_spectrum/pitting_damage/1", "/mean_ste_um"];
    let of_run = |key: &str| summary["headline"].pointer(key).unwrap().as_f64().unwrap();
    let names = wanted.map(|key| key[1..].replace('/', "."));
    for outputs in [&names[..], &names[2..]] {
        let mut words = vec!["vary", "a.toml", "--vary", "operation.torque_nm=100", "--out", "cases"];
        outputs.iter().for_each(|name| words.extend(["--output", name.as_str()]));
        let run = scratch.command(&words);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let rows = rows(&scratch, "cases/cases.csv");
        for name in outputs {
            let key = format!("/{}", name.replace('.', "/"));
            assert_eq!(rows[0][name].parse::<f64>().unwrap(), of_run(&key), "{name}");
        }
        std::fs::remove_dir_all(scratch.path().join("cases")).unwrap();
    }
}
