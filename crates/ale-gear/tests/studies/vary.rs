//! `ale-gear vary`: many cases of one scene, a row each.

use std::{
    collections::BTreeMap,
    process::Stdio,
    time::{Duration, Instant},
};

use crate::util::{Scratch, chart_rows, column, five_teeth, motion_scene};

const PLAN: &str = r#"
scene = "a.toml"
samples = 4
design = "sobol"
[[vary]]
key = "pinion.modification.drive.lead_crowning_um"
also = ["wheel.modification.drive.lead_crowning_um"]
from = 0
to = 6
[[vary]]
key = "operation.torque_nm"
values = [100, 150, 1e7]
[[output]]
headline = "peak_to_peak_ste_um"
[[output]]
headline = "ste_harmonics_um.1"
[[output]]
column = "contact_line_length_mm"
take = "least"
[[output]]
column = "ste_um"
take = "harmonic"
order = 2
"#;

fn rows(scratch: &Scratch, file: &str) -> Vec<BTreeMap<String, String>> {
    chart_rows(&scratch.read(file))
}

/// A row has the numbers of a run with its values, bit by bit; a load that no tooth stands is a row that says so.
#[test]
fn a_row_has_the_numbers_of_a_run() {
    let scratch = Scratch::new().file("a.toml", five_teeth()).file("plan.toml", PLAN);
    let run = scratch.ale_gear(["vary", "plan.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    assert!(run.stdout.contains("cases without a result: 4"), "{}", run.stdout);
    let all = rows(&scratch, "o/cases.csv");
    assert_eq!(all.len(), 12);
    for (i, row) in all.iter().enumerate() {
        assert_eq!(row["case"], i.to_string());
        let torque = &row["operation.torque_nm"];
        if torque == "10000000" {
            assert_eq!((row["status"].as_str(), row["peak_to_peak_ste_um"].as_str()), ("failed", ""), "{row:?}");
            assert!(row["reason"].contains("would bend the teeth"), "{row:?}");
            continue;
        }
        assert_eq!((row["status"].as_str(), row["reason"].as_str()), ("ok", ""), "{row:?}");
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

/// Cases in time are runs too.
#[test]
fn motions_are_cases_as_well() {
    let plan = "scene = \"a.toml\"\n[[vary]]\nkey = \"operation.speed_rpm\"\nvalues = [900, 1100]\n\
                [[output]]\ncolumn = \"dte_um\"\ntake = \"peak_to_peak\"\n";
    let scene = motion_scene(1, "run = \"span\"\n");
    let scratch = Scratch::new().file("a.toml", scene).file("plan.toml", plan);
    let run = scratch.ale_gear(["vary", "plan.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let single = scratch.ale_gear(["run", "a.toml", "--out", "r", "--set", "operation.speed_rpm=1100"]);
    assert_eq!(single.code, Some(0), "{}", single.stderr);
    let dte = column(&scratch.read("r/history.csv"), "dte_um");
    let [low, high] = dte.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &x| [a.min(x), b.max(x)]);
    let found = column(&scratch.read("o/cases.csv"), "peak_to_peak_dte_um");
    assert_eq!(found[1], high - low);
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
    let vary = "[[vary]]\nkey = \"operation.torque_nm\"\nvalues = [1, 2]\n";
    let output = "[[output]]\nheadline = \"mean_ste_um\"\n";
    for (text, said) in [
        (format!("{vary}{output}"), "a plan without `scene`"),
        (format!("scene = \"a.toml\"\n{output}"), "a plan that varies nothing"),
        (format!("scene = \"a.toml\"\n{vary}"), "a plan that asks for nothing"),
        (format!("scene = \"b.toml\"\n{vary}{output}"), "b.toml cannot be read"),
        (format!("scene = \"a.toml\"\nsampels = 3\n{vary}{output}"), "did you mean `samples`"),
        (format!("scene = \"a.toml\"\ndesign = \"sobo\"\n{vary}{output}"), "did you mean \"sobol\""),
        (format!("scene = \"a.toml\"\n{vary}from = 1\n{output}"), "in one way what values there are"),
        (format!("scene = \"a.toml\"\n{vary}{vary}{output}"), "varies `operation.torque_nm` twice"),
        (format!("scene = \"a.toml\"\n{vary}{output}{output}"), "asks for `mean_ste_um` twice"),
        (format!("scene = \"a.toml\"\n{}{output}", vary.replace("torque_nm", "torqe_nm")), "torqe_nm"),
        (format!("scene = \"a.toml\"\n{}{output}", vary.replace("values = [1, 2]", "values = []")), "no values"),
        (
            format!("scene = \"a.toml\"\n{}{output}", vary.replace("values = [1, 2]", "mean = 1\ndeviation = 0")),
            "a standard deviation is above 0",
        ),
        (
            format!("scene = \"a.toml\"\n{}{output}", vary.replace("values = [1, 2]", "from = 3\nto = 1")),
            "`from` lies below `to`",
        ),
    ] {
        let complaint = plan(&text);
        assert!(complaint.contains(said), "{text}\n{complaint}");
    }
    for (words, said) in [
        (&["--vary", "operation.torque_nm=1"][..], "`--output` says what is wanted"),
        (&["--vary", "operation.torque_nm", "--output", "mean_ste_um"], "neither `=` (each value) nor `~` (drawn)"),
        (&["--vary", "operation.torque_nm=1:2:0", "--output", "mean_ste_um"], "`0` is no number of values"),
        (&["--vary", "operation.torque_nm~a:2", "--output", "mean_ste_um"], "`a` is no number"),
        (&["--samples", "3"], "a plan file says keys, samples and seed itself"),
    ] {
        let run = scratch.command(&[&["vary", "a.toml", "--out", "o"][..], words].concat());
        assert!(run.code == Some(2) && run.stderr.contains(said), "{words:?}: {}", run.stderr);
    }
    assert_eq!(scratch.names(), ["a.toml", "plan.toml"]);
}
