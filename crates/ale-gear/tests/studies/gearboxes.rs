//! Gearboxes in plans and optimisations, as pairs are.

use std::{
    process::Stdio,
    time::{Duration, Instant},
};

use crate::util::{Run, Scratch, chart_rows, repository};

/// Two stages at rest at two positions, and the scenes of their pairs.
fn two_stages() -> Scratch {
    let folder = repository().join("scenes/gearbox");
    let copy = |scratch: Scratch, name: &str| scratch.file(name, std::fs::read(folder.join(name)).unwrap());
    let scratch = ["first_stage.toml", "second_stage.toml"].into_iter().fold(Scratch::new(), copy);
    let text = std::fs::read_to_string(folder.join("two_stages.toml")).unwrap();
    let text = text.replace("positions_per_cycle = 8", "positions_per_cycle = 2");
    scratch.file("box.toml", text)
}

const SLOPE: &str = "mesh.0.scene.pinion.modification.lead_slope_um";

fn number(row: &std::collections::BTreeMap<String, String>, key: &str) -> f64 {
    row[key].parse().unwrap_or_else(|e| panic!("{key} of {row:?}: {e}"))
}

fn summary(scratch: &Scratch, out: &str) -> serde_json::Value {
    serde_json::from_str(&scratch.read(&format!("{out}/summary.json"))).unwrap()
}

/// A row of a gearbox varied over a bearing's stiffness and a tooth's lead slope has the numbers of a run with these
/// values, bit by bit: at rest, of its vibration and of its motion; a bearing is found by its number and by its name.
#[test]
fn a_row_of_a_gearbox_has_the_numbers_of_its_run() {
    let scratch = two_stages();
    let stiffness = "bearing.\"slow, fixed\".stiffness_n_per_mm.0";
    let outputs =
        ["face_load_factor.0", "mean_bearing_force_n.4", "largest_housing_force_rms_n.0", "peak_to_peak_dte_um.1"];
    let short = ["--set", "motion.cycles=2", "--set", "vibration.speeds=3"];
    let vary = [format!("{stiffness}=2e5,5e5"), format!("{SLOPE}=0,10")];
    let mut words = vec!["vary", "box.toml", "--out", "o", "--vary", &vary[0], "--vary", &vary[1]];
    words.extend(outputs.iter().flat_map(|key| ["--output", key]).chain(short));
    let run = scratch.command(&words);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let rows = chart_rows(&scratch.read("o/cases.csv"));
    assert_eq!(rows.len(), 4);
    let wheres = ["bearing.4.stiffness_n_per_mm.0", "bearing.\"slow, fixed\".stiffness_n_per_mm.0"];
    for (case, key) in [(0, wheres[0]), (3, wheres[1])] {
        let (row, out) = (&rows[case], format!("r{case}"));
        assert_eq!(row["status"], "solved", "{row:?}");
        let set = [format!("{key}={}", row[stiffness]), format!("{SLOPE}={}", row[SLOPE])];
        let mut words = vec!["run", "box.toml", "--out", &out, "--set", &set[0], "--set", &set[1]];
        words.extend(short);
        let single = scratch.command(&words);
        assert_eq!(single.code, Some(0), "{}", single.stderr);
        let headline = &summary(&scratch, &out)["headline"];
        for output in outputs {
            let (key, at) = output.split_once('.').unwrap();
            let own = headline[key][at.parse::<usize>().unwrap()].as_f64();
            assert_eq!(Some(number(row, output)), own, "case {case}: {output}");
        }
    }
    assert_ne!(rows[0]["mean_bearing_force_n.4"], rows[2]["mean_bearing_force_n.4"], "the bearing does something");
    assert_ne!(rows[0]["face_load_factor.0"], rows[1]["face_load_factor.0"], "the slope does something");
}

/// What is not there is told before any work, with what is; starts that a gearbox has not are refused.
#[test]
fn what_a_gearbox_has_not_is_told_before_any_work() {
    for (words, said) in [
        (&["--vary", "bearing.9.position_mm=1,2", "--output", "face_load_factor.0"][..], "bearing"),
        (
            &["--vary", "mesh.third.scene.pair.face_width_mm=20,21", "--output", "face_load_factor.0"],
            "there is no mesh `third`; there are 0 (",
        ),
        (&["--vary", "mesh.0.scene.pinion.lead=1,2", "--output", "face_load_factor.0"], "lead"),
        (
            &["--vary", "bearing.0.position_mm=14,15", "--output", "face_load_factor"],
            "it is a list: write `face_load_factor.0` .. `face_load_factor.1`",
        ),
        (
            &["--vary", "bearing.0.position_mm=14,15", "--output", "face_load_facto.0"],
            "did you mean `face_load_factor`?",
        ),
        (&["--vary", "bearing.0.position_mm=14,15", "--of", "mesh_1_ste"], "is not a column of motion.csv"),
        (&["--vary", &format!("{SLOPE}~iso1328:6"), "--output", "face_load_factor.0"], "ISO 1328"),
        (&["--vary", "input.speed=1,2", "--start", "carry"], "cases of a gearbox are each alone"),
        (&["--vary", "motion.speed_rpm=1,2", "--start", "carry"], "`to_speed_rpm` in [motion]"),
        (&["--vary", "motion.speed_rpm=1,2", "--start", "branch"], "`run = \"continuation\"` in [motion]"),
        (&["--harris"], "`--harris` is for pairs"),
        (
            &["--vary", "bearing.left.position_mm=1,2", "--output", "face_load_factor.0"],
            "--set bearing.left.position_mm: none is called `left`; there are 0 (\"fast, fixed\"), 2 (",
        ),
    ] {
        let scratch = two_stages();
        let run = scratch.command(&[&["vary", "box.toml", "--out", "o"], words].concat());
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{words:?}: {}", run.stderr);
        assert!(run.stderr.contains(said), "{words:?}: {}", run.stderr);
        assert_eq!(scratch.names(), ["box.toml", "first_stage.toml", "second_stage.toml"], "work was begun");
    }
}

/// A case by itself and its report are those of its row; pieces that are put together are the plan in one piece.
#[test]
fn cases_of_a_gearbox_run_by_themselves_and_in_pieces() {
    let plan = "scene = \"box.toml\"\n[vary]\nkeys = [\"bearing.0.position_mm=14,15,16\"]\n\
                output = [\"max_pressure_mpa.1\", \"mean(mesh_1_ste_um)\", \"harmonic(mesh_1_ste_um)\"]\n";
    let text = two_stages().read("box.toml");
    let (at_rest, _) = text.split_once("[vibration]").unwrap();
    let scratch = two_stages().file("box.toml", at_rest).file("plan.toml", plan);
    let run = scratch.command(&["run", "plan.toml", "--out", "whole"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    for (out, range) in [("a.csv", "0..2"), ("b.csv", "2..3")] {
        let part = scratch.command(&["vary", "plan.toml", "--cases", range, "--out", out]);
        assert_eq!(part.code, Some(0), "{}", part.stderr);
    }
    let merged = scratch.command(&["merge", "plan.toml", "a.csv", "b.csv", "--out", "merged"]);
    assert_eq!(merged.code, Some(0), "{}", merged.stderr);
    assert_eq!(scratch.read("merged/cases.csv"), scratch.read("whole/cases.csv"));
    let rows = chart_rows(&scratch.read("whole/cases.csv"));
    let case = scratch.command(&["run", "plan.toml", "--case", "2", "--out", "one"]);
    assert_eq!(case.code, Some(0), "{}", case.stderr);
    let own = summary(&scratch, "one")["headline"]["max_pressure_mpa"][1].as_f64();
    assert_eq!(own, Some(number(&rows[2], "max_pressure_mpa.1")));
    let positions = chart_rows(&scratch.read("one/positions.csv"));
    let mean = positions.iter().map(|p| number(p, "mesh_1_ste_um")).sum::<f64>() / positions.len() as f64;
    assert!((mean - number(&rows[2], "mean_mesh_1_ste_um")).abs() < 1e-12 * mean.abs());
    let reports = scratch.command(&["vary", "plan.toml", "--reports", "1", "--out", "best"]);
    assert_eq!(reports.code, Some(0), "{}", reports.stderr);
    assert_eq!(reports_of(&scratch), 1);
}

fn reports_of(scratch: &Scratch) -> usize {
    let cases = std::fs::read_dir(scratch.path().join("best/cases")).unwrap();
    cases.filter(|case| case.as_ref().unwrap().path().join("positions.csv").exists()).count()
}

/// Runs a command, kills it whenever its file of done cases has grown, three times, and runs it to its end.
fn killed(scratch: &Scratch, words: &[&str], out: &str) -> Run {
    let done = scratch.path().join(format!("{out}.cases"));
    let lines = || std::fs::read_to_string(&done).map_or(0, |text| text.lines().count());
    for _ in 0..3 {
        let mut child = scratch.program().args(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let (before, begun) = (lines(), Instant::now());
        while lines() < before + 4 && child.try_wait().unwrap().is_none() && begun.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    scratch.command(words)
}

/// Killed again and again, a plan and an optimisation of a gearbox come to the same bytes as in one piece.
#[test]
fn a_killed_gearbox_goes_on() {
    let scratch = two_stages();
    let vary = |out: &'static str| {
        ["vary", "box.toml", "--out", out, "--vary", "bearing.0.position_mm=10:20:40", "--output", "face_load_factor.0"]
    };
    let slope = format!("{SLOPE}=-60:60");
    let optimise = |out: &'static str| {
        ["optimise", "box.toml", "--out", out, "--goal", "face_load_factor.0", "--vary", &slope, "--evaluations", "12"]
    };
    let whole = [scratch.command(&vary("whole")), scratch.command(&optimise("best"))];
    whole.iter().for_each(|run| assert_eq!(run.code, Some(0), "{}", run.stderr));
    let cut = [killed(&scratch, &vary("cut"), "cut"), killed(&scratch, &optimise("cut_best"), "cut_best")];
    cut.iter().for_each(|run| assert_eq!(run.code, Some(0), "{}", run.stderr));
    for (a, b, file) in
        [("whole", "cut", "cases.csv"), ("best", "cut_best", "steps.csv"), ("best", "cut_best", "numbers.csv")]
    {
        let [a, b] = [a, b].map(|out| scratch.read(&format!("{out}/{file}")));
        assert!(a == b, "{file} differs:\n{a}\n{b}");
    }
    assert!(!scratch.names().iter().any(|name| name.ends_with(".cases")), "{:?}", scratch.names());
}

/// The lead slope for which K_Hbeta is smallest is the one that a scan finds, a limit on the pressure holds, and a run of
/// the optimum with the words that are told has its numbers.
#[test]
fn the_optimum_of_a_gearbox_is_that_of_a_scan() {
    let scratch = two_stages();
    let (bounds, scan) = (format!("{SLOPE}=-80:40"), format!("{SLOPE}=-80:40:61"));
    let scanned =
        scratch.command(&["vary", "box.toml", "--out", "scan", "--vary", &scan, "--output", "face_load_factor.0"]);
    assert_eq!(scanned.code, Some(0), "{}", scanned.stderr);
    let rows = chart_rows(&scratch.read("scan/cases.csv"));
    let least = rows.iter().map(|row| number(row, "face_load_factor.0")).fold(f64::INFINITY, f64::min);
    let found =
        scratch.command(&["optimise", "box.toml", "--out", "o", "--goal", "face_load_factor.0", "--vary", &bounds]);
    assert_eq!(found.code, Some(0), "{}", found.stderr);
    let numbers = chart_rows(&scratch.read("o/numbers.csv"));
    let (before, after) = (number(&numbers[0], "before"), number(&numbers[0], "after"));
    // A step of the search that gains less than half a per cent is none.
    assert!(after <= 1.005 * least && after < 0.6 * before, "{after}, from {before}; the scan has {least}");
    let file = format!("scene = \"box.toml\"\n[optimise]\nkeys = [\"{bounds}\"]\ngoal = [\"face_load_factor.0\"]\n");
    std::fs::write(scratch.path().join("opt.toml"), file).unwrap();
    let run = scratch.command(&["run", "opt.toml", "--out", "file"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(scratch.read("file/steps.csv"), scratch.read("o/steps.csv"), "the words of a file");
    let told = summary(&scratch, "o");
    let set: Vec<String> =
        told["headline"]["set"].as_array().unwrap().iter().map(|w| w.as_str().unwrap().into()).collect();
    let set: Vec<&str> = set.iter().map(|word| word.trim_start_matches("--set '").trim_end_matches('\'')).collect();
    let run = scratch.command(&["run", "box.toml", "--out", "r", "--set", set[0]]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(summary(&scratch, "r")["headline"]["face_load_factor"][0].as_f64(), Some(after));
    let limit = 0.98 * summary(&scratch, "r")["headline"]["max_pressure_mpa"][1].as_f64().unwrap();
    let limit = format!("max_pressure_mpa.1={limit}");
    let words =
        ["optimise", "box.toml", "--out", "q", "--goal", "face_load_factor.0", "--vary", &bounds, "--limit", &limit];
    let passed = scratch.command(&words);
    assert_eq!(passed.code, Some(3), "the other mesh's pressure does not go by this slope: {}", passed.stderr);
    assert_eq!(summary(&scratch, "q")["remarks"][0]["code"], "limit_passed");
}

/// Numbers of a pair can be the goal as well, where exact derivatives have none: from too much crowning the largest
/// pressure goes down to the least of a scan. The search begins at what is set beside the file.
#[test]
fn numbers_of_a_pair_are_made_small() {
    let key = "pinion.modification.drive.lead_crowning_um";
    let (bounds, scan, set) = (format!("{key}=0:20"), format!("{key}=0:20:21"), format!("{key}=15"));
    let scratch = Scratch::new().file("a.toml", crate::util::five_teeth());
    let pressure = "max_pressure_mpa";
    let run = scratch.command(&["vary", "a.toml", "--out", "scan", "--vary", &scan, "--output", pressure]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let rows = chart_rows(&scratch.read("scan/cases.csv"));
    let least = rows.iter().map(|row| number(row, pressure)).fold(f64::INFINITY, f64::min);
    let words = ["optimise", "a.toml", "--out", "o", "--goal", pressure, "--vary", &bounds, "--set", &set];
    let run = scratch.command(&words);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let numbers = chart_rows(&scratch.read("o/numbers.csv"));
    let (before, after) = (number(&numbers[0], "before"), number(&numbers[0], "after"));
    assert_eq!(before, number(&rows[15], pressure), "the start is what is set");
    assert!(after < 0.95 * before && after <= 1.01 * least, "{after}, from {before}; the scan has {least}");
    for (words, said) in [
        (&["--goal", "max_pressure_mp", "--vary", "operation.torque_nm=1:2"][..], "did you mean `max_pressure_mpa`?"),
        (&["--goal", "max_pressure_mpa"], "names no key that may change"),
        (&["--goal", "max_pressure_mpa", "--vary", "operation.torque_nm=1:2", "--limit", "mean_ste_um"], "has no `=`"),
        (&["--limit", "mean_ste_um=3"], "--goal"),
    ] {
        let run = scratch.command(&[&["optimise", "a.toml", "--out", "x"], words].concat());
        assert_eq!(run.code, Some(2), "{words:?}: {}", run.stderr);
        assert!(run.stderr.contains(said), "{words:?}: {}", run.stderr);
    }
}

/// The search begins at what is set beside the file, by number or name; a mesh that is called by a number is meant by its
/// place where it has one.
#[test]
fn keys_of_a_gearbox_mean_one_entry() {
    let text = two_stages().read("box.toml");
    let named = text.replace("name = \"first\"", "name = \"1\"").replace("name = \"second\"", "name = \"0\"");
    assert_ne!(named, text);
    let scratch = two_stages().file("named.toml", named);
    let start = |file: &str, out: &str, more: &[&str]| {
        let words = ["optimise", file, "--out", out, "--goal", "face_load_factor.0", "--evaluations", "1"];
        let run = scratch.command(&[&words, more].concat());
        assert_eq!(run.code, Some(0), "{more:?}: {}", run.stderr);
        let told = summary(&scratch, out)["headline"]["parameters"].clone();
        told.as_object().unwrap().values().next().unwrap()["start"].as_f64()
    };
    let set = "bearing.\"slow, fixed\".position_mm=17";
    assert_eq!(start("box.toml", "a", &["--vary", "bearing.4.position_mm=10:20", "--set", set]), Some(17.0));
    let set = "mesh.second.scene.pinion.modification.lead_slope_um=3";
    let vary = "mesh.1.scene.pinion.modification.lead_slope_um=0:20";
    assert_eq!(start("box.toml", "b", &["--vary", vary, "--set", set]), Some(3.0));
    let factors = |set: &str, out: &str| {
        let run = scratch.command(&["run", "named.toml", "--out", out, "--set", set]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        summary(&scratch, out)["headline"]["face_load_factor"].clone()
    };
    let own = |which: &str| format!("mesh.{which}.scene.pinion.modification.lead_slope_um=20");
    let [first, second] = ["0", "1"].map(|which| factors(&own(which), which));
    assert_ne!(first, second, "each is about one mesh");
}
