//! Study files end to end on small scenes: files, numbers, threads, and what wrong files are told.

use ale_gear::scene::{Setting, study::Study};
use plan::{columns_of_scene, study_digest};

use crate::util::{ISO_SCENE, Scratch, column, motion_scene, tiny_at_rest};

/// Three pairs without meshes that differ in the helix angle.
fn iso_cases() -> Scratch {
    let scene = |degrees: u32| ISO_SCENE.replace("helix_angle_deg = 20.0", &format!("helix_angle_deg = {degrees}"));
    Scratch::new().file("a.toml", scene(10)).file("b.toml", scene(15)).file("c.toml", scene(20))
}

const ISO_STUDY: &str = r#"name = "three angles"
parameter = "helix angle [deg]"
[[case]]
scene = "a.toml"
label = "10 deg"
value = 10
[[case]]
scene = "b.toml"
label = "15 deg"
value = 15
[[case]]
scene = "c.toml"
label = "20 deg"
value = 20
[[quantity]]
column = "ste_um"
take = "peak_to_peak"
[[quantity]]
column = "wheel_force_z_n"
[[over_time]]
column = "wheel_moment_y_nmm"
[[follow]]
case = "20 deg"
column = "ste_um"
beside = ["contact_line_length_mm", "pairs_in_contact"]
"#;

/// The numbers of a study are those of its cases' own rows; every case has a whole result of its own.
#[test]
fn a_study_reads_its_numbers_off_the_rows_of_its_cases() {
    let scratch = iso_cases().file("s.toml", ISO_STUDY);
    let run = scratch.ale_gear(["run", "s.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let csv = scratch.read("o/study.csv");
    assert_eq!(
        csv.lines().next().unwrap(),
        "label,value,eps_alpha,eps_beta,eps_gamma,peak_to_peak_ste_um,mean_wheel_force_z_n,\
         correlation_ste_um_contact_line_length_mm,correlation_ste_um_pairs_in_contact,reason"
    );
    let numbers = csv.lines().map(|l| l.split_once(',').unwrap().1).collect::<Vec<_>>().join("\n");
    let (swing, axial) = (column(&numbers, "peak_to_peak_ste_um"), column(&numbers, "mean_wheel_force_z_n"));
    for (i, folder) in ["01-10-deg", "02-15-deg", "03-20-deg"].iter().enumerate() {
        let rows = scratch.read(&format!("o/cases/{folder}/history.csv"));
        let ste = column(&rows, "ste_um");
        let (low, high) = ste.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(*x), h.max(*x)));
        assert_eq!(swing[i], high - low, "{folder}");
        let force = column(&rows, "wheel_force_z_n");
        assert_eq!(axial[i], force.iter().sum::<f64>() / force.len() as f64, "{folder}");
        // Nobody asked for views and reports of single cases.
        let files = std::fs::read_dir(scratch.path().join("o/cases").join(folder)).unwrap();
        let mut files: Vec<_> = files.map(|file| file.unwrap().file_name()).collect();
        files.sort();
        assert_eq!(files, ["history.csv", "summary.json"], "{folder}");
    }
    // ISO's stiffness goes with the length of the lines, and the error as one over it: all but a straight line.
    let follows = column(&numbers, "correlation_ste_um_contact_line_length_mm");
    assert!(follows.iter().all(|r| *r < -0.98), "{follows:?}");
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    assert_eq!(summary["headline"]["cases"][2]["quantities"]["mean_wheel_force_z_n"].as_f64(), Some(axial[2]));
    assert_eq!(summary["files"], serde_json::json!(["cases", "report.html", "report.json.gz", "study.csv"]));
    let page = scratch.read("o/report.html");
    // Three columns over cycles, two against others, one over time, two over the angle.
    assert_eq!(page.matches("<svg").count(), 8);
    assert!(!page.contains("src=") && !page.contains("href="));
    // With reports they are whole results, of the same rows, and linked.
    let whole = scratch.ale_gear(["vary", "s.toml", "--out", "w", "--reports", "all"]);
    assert_eq!(whole.code, Some(0), "{}", whole.stderr);
    assert_eq!(scratch.read("w/study.csv"), csv);
    for folder in ["01-10-deg", "02-15-deg", "03-20-deg"] {
        let rows = |out: &str| scratch.read(&format!("{out}/cases/{folder}/history.csv"));
        assert_eq!(rows("w"), rows("o"), "{folder}");
        assert!(scratch.read(&format!("w/cases/{folder}/report.html")).contains("<svg"), "{folder}");
        assert!(
            scratch.page("w/report.html").contains(&format!("<a href=\"cases/{folder}/report.html\">")),
            "{folder}"
        );
    }
    for text in ["three angles", "20 deg", "peak to peak STE [µm]", "results: o"] {
        assert!(run.stdout.contains(text), "{text} is not in\n{}", run.stdout);
    }
    // An earlier study is replaced; a folder with somebody's file among the cases is not.
    assert_eq!(scratch.ale_gear(["run", "s.toml", "--out", "o"]).code, Some(0));
    let scratch = scratch.file("o/cases/01-10-deg/thesis.tex", "years of work");
    let refused = scratch.ale_gear(["run", "s.toml", "--out", "o"]);
    assert!(refused.stderr.contains("holds `cases/01-10-deg/thesis.tex`"), "{}", refused.stderr);
    assert_eq!(refused.code, Some(2));
}

/// A case without a solution stands with its reason in its row, and takes nothing from the others; where none has one,
/// nothing is left.
#[test]
fn a_case_without_a_solution_stands_alone() {
    let failing = "set = [\"pair.centre_distance_mm=80\"]\n";
    let at = |study: String, label: &str| {
        let line = format!("label = \"{label}\"\n");
        assert!(study.contains(&line));
        study.replacen(&line, &format!("{line}{failing}"), 1)
    };
    let one = at(ISO_STUDY.to_owned(), "15 deg");
    let scratch = iso_cases().file("s.toml", &one);
    let run = scratch.ale_gear(["run", "s.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let reason = "[pair]: centre distance 80 mm is too small";
    assert!(run.stdout.contains("warning: 15 deg: no result: ") && run.stdout.contains(reason), "{}", run.stdout);
    let csv = scratch.read("o/study.csv");
    let rows: Vec<&str> = csv.lines().collect();
    assert_eq!(rows.len(), 4, "{csv}");
    assert!(rows[2].starts_with("15 deg,15,NaN,NaN,NaN,NaN,NaN,NaN,NaN,") && rows[2].contains(reason), "{csv}");
    // The others are those of a study without it.
    assert_eq!(scratch.ale_gear(["run", "s.toml", "--out", "o"]).code, Some(0));
    let whole = iso_cases().file("s.toml", ISO_STUDY);
    assert_eq!(whole.ale_gear(["run", "s.toml", "--out", "o"]).code, Some(0));
    let own = whole.read("o/study.csv");
    assert_eq!([rows[1], rows[3]], [own.lines().nth(1).unwrap(), own.lines().nth(3).unwrap()]);
    let folders: Vec<_> =
        std::fs::read_dir(scratch.path().join("o/cases")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(folders.len(), 2, "{folders:?}");
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    let cases = &summary["headline"]["cases"];
    assert!(cases[1]["reason"].as_str().is_some_and(|r| r.contains(reason)), "{cases}");
    assert!(
        cases[1]["quantities"].is_null() && cases[1]["folder"].is_null() && cases[0]["reason"].is_null(),
        "{cases}"
    );
    assert!(summary["headline"]["correlations"][0]["by_case"][1].is_null(), "{summary}");
    let page = scratch.read("o/report.html");
    assert_eq!(page.matches("<svg").count(), 8);
    assert!(page.matches("Without 15 deg: no result.").count() == 2 && page.contains("<td>no result: "), "{page}");
    // Of a case that is drawn by itself the figure says so.
    let drawn = iso_cases().file("s.toml", at(ISO_STUDY.to_owned(), "20 deg"));
    assert_eq!(drawn.ale_gear(["run", "s.toml", "--out", "o"]).code, Some(0));
    assert!(drawn.read("o/report.html").contains("20 deg has no result: STE is not drawn."));
    let none = ["10 deg", "15 deg", "20 deg"].iter().fold(ISO_STUDY.to_owned(), |study, label| at(study, label));
    let none = iso_cases().file("s.toml", none);
    let run = none.ale_gear(["run", "s.toml", "--out", "o"]);
    assert!(run.stderr.starts_with("ale-gear: s.toml: none of 3 cases has a result; 10 deg: "), "{}", run.stderr);
    assert_eq!((run.code, none.names().len()), (Some(2), 4), "{:?}", none.names());
}

/// Motions side by side: any number of threads writes the same bytes. The whole model of a case is timed beside it.
#[test]
fn a_study_of_motions_does_not_see_the_number_of_threads() {
    let study = "parameter = \"torque [N m]\"\n\
                 [[case]]\nscene = \"a.toml\"\nlabel = \"light\"\nvalue = 50\nset = [\"operation.torque_nm=50\"]\n\
                 [[case]]\nscene = \"a.toml\"\nlabel = \"heavy\"\nvalue = 150\n\
                 [[quantity]]\ncolumn = \"dte_um\"\ntake = \"largest\"\n\
                 [[over_time]]\ncolumn = \"dte_um\"\ncycles = 1\n\
                 [full]\ncase = \"heavy\"\npositions = 1\n";
    let scratch = Scratch::new().file("a.toml", motion_scene(2, "")).file("s.toml", study);
    for (out, threads) in [("one", "1"), ("two", "2")] {
        let run = scratch.ale_gear(["run", "s.toml", "--out", out, "-j", threads]);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    }
    for file in ["study.csv", "cases/01-light/history.csv", "cases/02-heavy/energy.csv"] {
        assert!(scratch.read(&format!("one/{file}")) == scratch.read(&format!("two/{file}")), "{file} differs");
    }
    let of = |case: &str| -> serde_json::Value {
        serde_json::from_str(&scratch.read(&format!("one/cases/{case}/summary.json"))).unwrap()
    };
    for (case, torque) in [("01-light", 50.0), ("02-heavy", 150.0)] {
        assert_eq!(of(case)["inputs"]["operation"]["torque_nm"].as_f64(), Some(torque), "{case}");
    }
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("one/summary.json")).unwrap();
    let full = &summary["headline"]["full"];
    let number = |key: &str| full["at_rest"][key].as_f64().unwrap_or_else(|| panic!("no {key}: {full}"));
    assert_eq!((full["case"].as_str(), number("full_positions_run")), (Some("heavy"), 1.0));
    assert!(number("times_faster_position") > 1.0, "{full}");
    assert!(number("dof") > 5.0 * number("dof_kept"), "{full}");
    // The reduced model interpolates its bulk compliance.
    assert!(number("relative_difference_of_ste").abs() < 1e-4, "{full}");
    assert!(full["full_position_over_motion_step"].as_f64().unwrap() > 1.0, "{full}");
}

/// Wrong files are told by line and key before any work; nothing is written.
#[test]
fn wrong_studies_are_told_with_line_and_hint() {
    let says = |old: &str, new: &str, text: &str| {
        assert!(ISO_STUDY.contains(old), "{old}");
        let scratch = iso_cases().file("s.toml", ISO_STUDY.replacen(old, new, 1));
        let run = scratch.ale_gear(["run", "s.toml", "--out", "o"]);
        assert_eq!(run.complaint(), format!("ale-gear: {text}\n"), "for {new}");
        assert_eq!((run.code, scratch.names().len()), (Some(2), 4));
    };
    says("parameter =", "paramter =", "s.toml:2: unknown key `paramter`\nhint: did you mean `parameter`?");
    says("take =", "takes =", "s.toml:17: unknown key `takes`\nhint: did you mean `take`?");
    says("name =", "beside = 1\nname =", "s.toml:1: unknown key `beside`\nhint: `beside` belongs to [[follow]]");
    says(
        "\"peak_to_peak\"",
        "\"peak\"",
        "s.toml:17: `take` is \"peak\", allowed is \"mean\" or \"peak_to_peak\" or \"least\" or \"largest\"\n\
         hint: give `take` a value that is allowed",
    );
    says(
        "column = \"ste_um\"",
        "column = \"dte_um\"",
        "s.toml:16: `column` is \"dte_um\", allowed is a column of history.csv of the case \"10 deg\"\nhint: did you mean \"ste_um\"?",
    );
    says(
        "\"pairs_in_contact\"",
        "\"pairs_in_contct\"",
        "s.toml:25: `beside` is \"pairs_in_contct\", allowed is a column of history.csv of the case \"10 deg\"\nhint: did you \
         mean \"pairs_in_contact\"?",
    );
    says(
        "case = \"20 deg\"",
        "case = \"21 deg\"",
        "s.toml:23: `case` is \"21 deg\", allowed is \"10 deg\" or \"15 deg\" or \"20 deg\"\nhint: did you mean \"20 deg\"?",
    );
    says(
        "label = \"15 deg\"",
        "label = \"10 deg\"",
        "s.toml:7: there are two cases with the label \"10 deg\"\nhint: give each a `label` of its own",
    );
    says("value = 10\n", "", "s.toml:3: [[case]] has no `value`\nhint: give its place on the axis of the parameter");
    says(
        "value = 10",
        "value = \"10\"",
        "s.toml:6: `value` must be a number, found string \"10\"\nhint: write numbers without \
         quotes and without a unit: the unit is in the key",
    );
    says(
        "\"a.toml\"",
        "\"z.toml\"",
        "s.toml:4: \"z.toml\" cannot be read: No such file or directory (os error 2)\nhint: paths are relative to the study file",
    );
    says(
        "[[over_time]]",
        "[full]\npositions = 1\n[[over_time]]",
        "s.toml:20: the case \"10 deg\" has no gears with slices to reduce\nhint: name a `case` with the model \"reduced\" and the method \
         \"slice\", or leave [full] out",
    );
    says(
        "value = 10\n",
        "value = 10\nset = [\"operation.torqe_nm=3\"]\n",
        "s.toml:7: set operation.torqe_nm: unknown key `torqe_nm`\nhint: did you mean `torque_nm`?",
    );
    let nothing = iso_cases().file("s.toml", &ISO_STUDY[..ISO_STUDY.find("[[quantity]]").unwrap()]);
    let run = nothing.ale_gear(["run", "s.toml", "--out", "o"]);
    assert_eq!(
        run.complaint(),
        "ale-gear: s.toml:1: a study that asks for nothing\nhint: say what to draw: [[quantity]], [[over_time]], [[follow]]\n"
    );
}

/// A scene that is wrong is told by its own line; a sweep has no rows.
#[test]
fn scenes_of_a_study_are_checked_before_any_of_them_runs() {
    let wrong =
        iso_cases().file("b.toml", ISO_SCENE.replace("face_width_mm", "face_widht_mm")).file("s.toml", ISO_STUDY);
    let run = wrong.ale_gear(["run", "s.toml", "--out", "o"]);
    assert_eq!(
        run.complaint(),
        "ale-gear: b.toml:12: unknown key `face_widht_mm`\nhint: did you mean `face_width_mm`?\n"
    );
    let sweep = "run = \"sweep\"\nsweep = { from_rpm = 3000, to_rpm = 4000, speeds = 2 }\n";
    let sweep = iso_cases().file("b.toml", motion_scene(1, sweep)).file("s.toml", ISO_STUDY);
    let run = sweep.ale_gear(["run", "s.toml", "--out", "o"]);
    assert!(
        run.stderr.starts_with("ale-gear: s.toml:8: b.toml is a sweep, which has no rows over time\n"),
        "{}",
        run.stderr
    );
    assert_eq!((run.code, sweep.names().len()), (Some(2), 4));
}

/// A case whose result does not hold gives no numbers; with reports it leaves its files, marked as failed, as a run by
/// itself does.
#[test]
fn a_case_that_does_not_hold_leaves_its_files() {
    let scene = motion_scene(0, "").split("kind = \"dynamic\"").next().unwrap().to_owned();
    let study = "name = \"two loads\"\n[[case]]\nscene = \"a.toml\"\nlabel = \"some\"\nvalue = 1\n\
                 [[case]]\nscene = \"a.toml\"\nlabel = \"none\"\nvalue = 2\nset = [\"operation.torque_nm=30000\"]\n\
                 [[quantity]]\ncolumn = \"ste_um\"\n";
    let scratch = Scratch::new().file("a.toml", scene).file("s.toml", study);
    let reason = |words: &[&str]| {
        let run = scratch.command(&[&["vary", "s.toml", "--out", "o"], words].concat());
        assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
        let mut summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
        let case = summary["headline"]["cases"][1].take();
        assert!(case["reason"].as_str().is_some_and(|r| r.contains("check failed: deflection_over_module")), "{case}");
        assert!(case["quantities"].is_null(), "{case}");
        case
    };
    assert!(reason(&[])["folder"].is_null(), "no reports, no files of it");
    let case = reason(&["--reports", "all"]);
    let folder = case["folder"].as_str().unwrap_or_else(|| panic!("no folder: {case}"));
    let own: serde_json::Value = serde_json::from_str(&scratch.read(&format!("o/{folder}/summary.json"))).unwrap();
    assert_eq!(own["certificate"], "failed");
    assert!(scratch.page("o/report.html").contains(&format!("({folder})")));
}

/// A value that the scene does not allow in one case is that case's reason; a scene that is wrong in all is told first.
#[test]
fn a_value_that_is_none_takes_nothing_from_the_others() {
    let study = ISO_STUDY.replacen("value = 15\n", "value = 15\nset = [\"operation.torque_nm=-5\"]\n", 1);
    let scratch = iso_cases().file("s.toml", &study);
    let run = scratch.ale_gear(["run", "s.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let csv = scratch.read("o/study.csv");
    let rows: Vec<&str> = csv.lines().collect();
    assert!(rows[2].starts_with("15 deg,15,NaN") && rows[2].contains("`torque_nm` is -5"), "{csv}");
    assert!(rows[1].ends_with(',') && rows[3].ends_with(','), "the others have no reason: {csv}");
    assert!(scratch.path().join("o/cases/03-20-deg").is_dir() && !scratch.path().join("o/cases/02-15-deg").exists());
}

/// Cases at rest have the rows of runs by themselves to the bit, on models that they share; cases of one value are dots,
/// not a line that goes up and down. Killed in the middle, a study goes on and does nothing twice.
#[test]
fn a_killed_study_goes_on() {
    let case = |i: u32| {
        let (torque, crowning) = (50 + 5 * (i / 2), 3 * (i % 2));
        format!(
            "[[case]]\nscene = \"a.toml\"\nlabel = \"c{i}\"\nvalue = {torque}\nset = [\"operation.torque_nm={torque}\", \
             \"pinion.modification.drive.lead_crowning_um={crowning}\"]\n"
        )
    };
    let cases: String = (0..100).map(case).collect();
    let study =
        format!("parameter = \"torque [N m]\"\n{cases}[[quantity]]\ncolumn = \"ste_um\"\ntake = \"peak_to_peak\"\n");
    let scratch = Scratch::new().file("a.toml", tiny_at_rest(32)).file("s.toml", study);
    let kept = scratch.path().join("cut.cases");
    let done = || -> Vec<std::path::PathBuf> {
        let Ok(entries) = std::fs::read_dir(&kept) else { return Vec::new() };
        entries.map(|e| e.unwrap().path()).filter(|p| p.join("summary.json").is_file()).collect()
    };
    let mut child = scratch
        .program()
        .args(["run", "s.toml", "--out", "cut"])
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let begun = std::time::Instant::now();
    while done().len() < 5 && child.try_wait().unwrap().is_none() && begun.elapsed().as_secs() < 60 {
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let written = |path: &std::path::Path| std::fs::metadata(path.join("history.csv")).unwrap().modified().unwrap();
    let before: Vec<_> =
        done().into_iter().map(|path| (path.file_name().unwrap().to_owned(), written(&path))).collect();
    assert!(before.len() >= 5, "{} cases were done", before.len());
    let run = scratch.ale_gear(["run", "s.toml", "--out", "cut"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    for (name, time) in before {
        let now = written(&scratch.path().join("cut/cases").join(&name));
        assert_eq!(now, time, "{name:?} was done twice");
    }
    assert!(!kept.exists(), "nothing is left beside the results");
    let set = ["operation.torque_nm=65", "pinion.modification.drive.lead_crowning_um=3"];
    let single = scratch.ale_gear(["run", "a.toml", "--out", "r", "--set", set[0], "--set", set[1]]);
    assert_eq!(single.code, Some(0), "{}", single.stderr);
    assert_eq!(scratch.read("cut/cases/08-c7/history.csv"), scratch.read("r/history.csv"));
    let page = scratch.read("cut/report.html");
    assert!(page.contains(r#""kind":"dots""#) && !page.contains(r#""kind":"lines""#), "two cases at every torque");
    // A folder of somebody else is left alone.
    std::fs::create_dir(&kept).unwrap();
    std::fs::write(kept.join("thesis.tex"), "years of work").unwrap();
    let refused = scratch.ale_gear(["run", "s.toml", "--out", "cut"]);
    assert!(refused.code == Some(2) && refused.stderr.contains("is not a folder of cases"), "{}", refused.stderr);
}

/// Words that say something else than a study's file are refused, not ignored.
#[test]
fn words_of_other_values_are_refused() {
    let scratch = iso_cases().file("s.toml", ISO_STUDY);
    for (word, value) in [("--start", "carry"), ("--of", "ste_um"), ("--samples", "3"), ("--cases", "0..1")] {
        let run = scratch.command(&["vary", "s.toml", "--out", "o", word, value]);
        let said = format!("ale-gear: s.toml: `{word}` does not go with a study file\n");
        assert!(run.code == Some(2) && run.stderr.starts_with(&said), "{word}: {}", run.stderr);
        assert!(!scratch.path().join("o").exists());
    }
}

/// `--set` holds for the scene of every case, and what a case sets itself before it: the numbers are those of a study whose
/// scenes say so. What no case would follow is refused, and wrong words are refused as `run` refuses them.
#[test]
fn keys_are_set_in_every_case() {
    let own = ISO_STUDY.replacen("value = 15\n", "value = 15\nset = [\"operation.torque_nm=70\"]\n", 1);
    let scratch = iso_cases().file("s.toml", &own);
    let run = |words: &[&str]| scratch.command(&[&["run", "s.toml", "--out", "o"][..], words].concat());
    let set = run(&["--set", "operation.torque_nm=90", "--set", "analysis.cycles=2"]);
    assert_eq!((set.code, set.stderr.as_str()), (Some(0), ""), "{}", set.stdout);
    for (folder, torque) in [("01-10-deg", 90.0), ("02-15-deg", 70.0), ("03-20-deg", 90.0)] {
        let text = scratch.read(&format!("o/cases/{folder}/summary.json"));
        let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
        let inputs = &summary["inputs"];
        assert_eq!(inputs["operation"]["torque_nm"].as_f64(), Some(torque), "{folder}");
        assert_eq!(summary["headline"]["cycles"].as_u64(), Some(2), "{folder}");
    }
    let written = [10, 15, 20].map(|degrees: u32| {
        let torque = if degrees == 15 { 70 } else { 90 };
        let scene = ISO_SCENE.replace("helix_angle_deg = 20.0", &format!("helix_angle_deg = {degrees}"));
        scene.replace("torque_nm = 150.0", &format!("torque_nm = {torque}")) + "cycles = 2\n"
    });
    let [a, b, c] = written;
    let by_hand = Scratch::new().file("a.toml", a).file("b.toml", b).file("c.toml", c).file("s.toml", ISO_STUDY);
    assert_eq!(by_hand.ale_gear(["run", "s.toml", "--out", "o"]).code, Some(0));
    assert_eq!(scratch.read("o/study.csv"), by_hand.read("o/study.csv"));
    let wrong = |words: &[&str]| {
        let refused = run(words);
        assert_eq!(refused.code, Some(2), "{}", refused.stderr);
        refused.complaint()
    };
    for word in ["operation.torqe_nm=3", "operation.torque_nm=-3", "operation", "operation.torque_nm=[3"] {
        let single = scratch.ale_gear(["run", "a.toml", "--out", "r", "--set", word]);
        assert_eq!(wrong(&["--set", word]), single.complaint(), "{word}");
    }
    let all = |torque: u32| format!("set = [\"operation.torque_nm={torque}\"]\nvalue = ");
    let scratch = iso_cases().file("s.toml", ISO_STUDY.replace("value = ", &all(70)));
    let refused = scratch.ale_gear(["run", "s.toml", "--out", "o", "--torque-nm", "90"]);
    assert_eq!(
        refused.complaint(),
        "ale-gear: --torque-nm: every case of the study sets `operation.torque_nm` itself\n\
         hint: leave it out, or change `set` of the cases\n"
    );
    assert_eq!((refused.code, scratch.names().len()), (Some(2), 4));
}

/// Cases that are done are taken up again by a study of the same keys alone, mesh cycles included.
#[test]
fn kept_cases_are_those_of_the_same_keys() {
    let scratch = iso_cases().file("s.toml", ISO_STUDY);
    let digest = |word: &str| {
        let settings = [Setting::parse(word).unwrap()];
        let study = Study::read(&scratch.path().join("s.toml"), &settings, &columns_of_scene).unwrap();
        study_digest(&study, false)
    };
    let all = ["analysis.cycles=1", "analysis.cycles=2", "operation.torque_nm=90"].map(digest);
    assert_eq!(digest("analysis.cycles=2"), all[1]);
    assert!(all[0] != all[1] && all[0] != all[2] && all[1] != all[2], "{all:?}");
}
