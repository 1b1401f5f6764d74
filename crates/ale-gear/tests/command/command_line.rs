//! Manners of the command line: what goes where, and with which status.

use crate::util::{ISO_SCENE, Run, Scratch, motion_scene};
use serde_json::Value;

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|e| panic!("{e}:\n{text}"))
}

fn fine(run: &Run) {
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
}

/// 0 solved, 1 the input is fine but nothing came out, 2 the input is wrong; complaints on stderr alone.
#[test]
fn the_exit_status_says_whose_fault_it_is() {
    let scratch = Scratch::new().file("a.toml", ISO_SCENE).file("o", "a file where a folder is wanted");
    let solved = scratch.ale_gear(["run", "a.toml", "--out", "fine"]);
    fine(&solved);
    assert!(solved.stdout.contains("results: fine"), "{}", solved.stdout);
    let wrong = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!((wrong.code, wrong.stdout.as_str()), (Some(2), ""), "{}", wrong.stderr);
    // The scene is fine, but the motion leaves all bounds: an explicit method with steps that are far too long.
    let unstable = motion_scene(0, "run = \"span\"\nmethod = \"dormand-prince\"\nwarm = 1\n").replace("warm = 1\n", "");
    let stiff = "[pinion.body]\nfree = [\"y\"]\nmass_kg = 1e-9\n[pinion.bearing]\nstiffness_y_n_per_mm = 1e15\n";
    let scratch = Scratch::new().file("a.toml", unstable + stiff);
    let failed = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!((failed.code, failed.stdout.as_str()), (Some(1), ""), "{}", failed.stderr);
    assert!(failed.stderr.starts_with("ale-gear: "), "{}", failed.stderr);
    assert_eq!(scratch.names(), ["a.toml"], "a failed run leaves something behind");
    for words in [&["fly"][..], &["run"], &["compare", "one"], &["run", "a.toml", "--out", "o", "-q", "-v"]] {
        assert_eq!(scratch.command(words).code, Some(2), "{words:?}");
    }
}

/// `--json` is the summary, `--quiet` is nothing, `-v` is talk on stderr; none of them changes a number.
#[test]
fn data_goes_to_stdout_and_talk_to_stderr() {
    let scratch = Scratch::new().file("a.toml", ISO_SCENE);
    let as_json = scratch.ale_gear(["run", "a.toml", "--out", "o", "--json"]);
    fine(&as_json);
    assert_eq!(as_json.stdout, scratch.read("o/summary.json"));
    let headline = json(&as_json.stdout)["headline"].clone();
    for words in [["-q"], ["--quiet"]] {
        let quiet = scratch.command(&[&["run", "a.toml", "--out", "o"], &words[..]].concat());
        assert_eq!((quiet.code, quiet.stdout.as_str(), quiet.stderr.as_str()), (Some(0), "", ""));
    }
    let steps = scratch.ale_gear(["-v", "run", "a.toml", "--out", "o", "--threads", "1"]);
    let timed = steps.stderr.split_once("geometry ...\ngeometry: ").and_then(|(_, rest)| rest.split_once(" s\n"));
    assert!(timed.is_some_and(|(s, _)| s.parse::<f64>().is_ok_and(|s| s >= 0.0)), "{}", steps.stderr);
    assert!(steps.stdout.contains("mean STE"), "{}", steps.stdout);
    let summary = json(&scratch.read("o/summary.json"));
    assert_eq!((&summary["headline"], &summary["cost"]["threads"]), (&headline, &Value::from(1)));
    let none = scratch.ale_gear(["run", "a.toml", "--out", "o", "-j", "0"]);
    assert_eq!(
        (none.code, none.stderr.as_str()),
        (Some(2), "ale-gear: `--threads` is 0, allowed is 1 .. 1024\nhint: leave it out to use all cores\n")
    );
}

/// Into a log goes a line on how far a phase is, as late as the environment says: twenty seconds, at once, or never.
#[test]
fn a_log_is_told_how_far_the_work_is() {
    let still = motion_scene(0, "").replace("kind = \"dynamic\"\n", "").replace(crate::util::MOTION_LINES, "");
    let scratch = Scratch::new().file("a.toml", still);
    let run = |after: &str| {
        let words = ["run", "a.toml", "--out", "o"];
        Scratch::done(scratch.program().args(words).env(ale_gear::talk::PROGRESS_AFTER_S, after))
    };
    for late in ["1000000", "never"] {
        fine(&run(late));
    }
    let told = run("0");
    assert_eq!(told.code, Some(0), "{}", told.stderr);
    // Of four steps nobody knows how long the rest takes.
    let tells = |line: &str| line.starts_with("solve: ") && line.contains(" of 4 after ") && line.ends_with(" s");
    assert!(told.stderr.lines().any(tells), "{}", told.stderr);
    for wrong in ["soon", "-1", "2.5", ""] {
        let refused = run(wrong);
        let said = format!("ale-gear: ALE_GEAR_PROGRESS_AFTER_S is `{wrong}`, allowed are whole seconds and `never`\n");
        assert!(refused.stderr.starts_with(&said) && refused.code == Some(2), "{wrong}: {}", refused.stderr);
    }
}

/// Every shell's script knows the subcommands, and the manual page has a part for each.
#[test]
fn shells_and_manuals_know_the_subcommands() {
    let scratch = Scratch::new();
    let subcommands = ["run", "init", "chart", "compare", "vary", "mesh", "print"];
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = scratch.ale_gear(["print", "completions", shell]);
        fine(&script);
        for word in subcommands {
            assert!(script.stdout.contains(word), "{shell}: no {word}");
        }
    }
    let page = scratch.ale_gear(["print", "man"]);
    fine(&page);
    for word in subcommands {
        assert!(
            page.stdout.contains(&format!(".TH ale\\-gear\\-{word}"))
                || page.stdout.contains(&format!(".TH ale-gear-{word}")),
            "no page of {word}"
        );
    }
}

/// The schema is JSON, of the draft that it says, and knows a key with its range, default and unit.
#[test]
fn the_schema_is_data_on_stdout() {
    let run = Scratch::new().ale_gear(["print", "schema"]);
    fine(&run);
    let schema = json(&run.stdout);
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    let speed = &schema["$defs"]["pair"]["properties"]["operation"]["properties"]["speed_rpm"];
    assert_eq!((&speed["default"], &speed["maximum"]), (&Value::from(1000.0), &Value::from(1e7)));
    assert!(speed["description"].as_str().is_some_and(|d| d.contains("1/min")));
}

/// A starter scene runs as it is, says what was asked for, and replaces nothing that it was not told to.
#[test]
fn init_writes_a_scene_that_runs() {
    let scratch = Scratch::new();
    let words =
        ["init", "pair.toml", "--teeth", "23,41", "--module-mm", "2.5", "--helix-deg", "-15", "--torque-nm", "80"];
    let run = scratch.command(&words);
    fine(&run);
    assert!(run.stdout.contains("ale-gear run pair.toml --out out"), "{}", run.stdout);
    let solved = scratch.command(&["run", "pair.toml", "--out", "o", "--set", "analysis.model=iso", "--json"]);
    fine(&solved);
    let inputs = &json(&solved.stdout)["inputs"];
    assert_eq!(
        (&inputs["pinion"]["teeth"], &inputs["wheel"]["helix_angle_deg"]),
        (&Value::from(23), &Value::from(15.0))
    );
    let again = scratch.command(&words);
    assert_eq!(again.code, Some(2));
    assert!(again.stderr.contains("pair.toml: is there already"), "{}", again.stderr);
    fine(&scratch.command(&[&words[..], &["--force"]].concat()));
    // No terminal and no flags: the default pair, without questions.
    fine(&scratch.command(&["init"]));
    let dynamic = scratch.command(&["init", "-", "--kind", "dynamic"]);
    fine(&dynamic);
    assert!(dynamic.stdout.contains("kind = \"dynamic\""), "{}", dynamic.stdout);
    // A ring, whose tips are as short as its pinion needs.
    fine(&scratch.command(&["init", "ring.toml", "--teeth", "20,-52"]));
    let ring = std::fs::read_to_string(scratch.path().join("ring.toml")).unwrap();
    assert!(ring.contains("teeth = -52") && ring.contains("tip_diameter_mm = 160.7"), "{ring}");
    // What would not run is not written.
    let wrong = scratch.command(&["init", "no.toml", "--teeth", "8,9", "--module-mm", "0.001"]);
    assert_eq!(wrong.code, Some(2), "{}", wrong.stdout);
    assert!(!scratch.path().join("no.toml").exists());
}

/// Gears are reduced once; a run afterwards takes them from where they were put.
#[test]
fn reduce_fills_the_cache_that_a_run_reads() {
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";
    let scene = ISO_SCENE
        .replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}"))
        .replace("model = \"iso\"\n", "positions_per_cycle = 2\n");
    let scratch = Scratch::new().file("a.toml", scene);
    let first = scratch.ale_gear(["mesh", "reduce", "a.toml", "--cache", "kept", "--json"]);
    fine(&first);
    let found = json(&first.stdout);
    let gears = found["gears"].as_array().unwrap();
    assert_eq!((gears.len(), &gears[0]["from_cache"]), (2, &Value::from(false)));
    for gear in gears {
        assert!(scratch.path().join(gear["file"].as_str().unwrap()).is_file(), "{gear}");
        assert!(gear["coordinates"].as_u64() < gear["dof_before"].as_u64(), "{gear}");
    }
    let second = scratch.ale_gear(["mesh", "reduce", "a.toml", "--cache", "kept"]);
    fine(&second);
    assert_eq!(second.stdout.matches("from the cache").count(), 2, "{}", second.stdout);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--cache", "kept", "--json"]);
    fine(&run);
    assert_eq!(json(&run.stdout)["model"]["gears_from_cache"], 2);
    let none = scratch.ale_gear(["mesh", "reduce", "a.toml", "--set", "analysis.model=iso"]);
    assert_eq!(none.code, Some(2));
    assert!(none.stderr.contains("this model reduces nothing"), "{}", none.stderr);
    fine(&scratch.command(&["mesh", "generate", "a.toml", "--gear", "pinion", "--output", "p.msh"]));
    let of_mesh = scratch.ale_gear(["mesh", "reduce", "p.msh", "--window-teeth", "2"]);
    fine(&of_mesh);
    assert!(of_mesh.stdout.contains("coordinates of 2 teeth"), "{}", of_mesh.stdout);
    let both = scratch.ale_gear(["mesh", "reduce", "a.toml", "--teeth", "30"]);
    assert_eq!(both.code, Some(2), "{}", both.stdout);
}

/// Words that cannot be obeyed are one message and a hint, before any work; so are a folder where a file is wanted, and
/// bytes that no terminal should see.
#[test]
fn wrong_words_are_told_with_a_way_out() {
    let scratch = Scratch::new().file("a.toml", ISO_SCENE).file("a.msh", b"\x1b[2Jabc\x07 1 2 3\n");
    std::fs::create_dir(scratch.path().join("f")).unwrap();
    for (words, complaint) in [
        (&["run", "a.toml", "--out", "o", "--threads", "100000"][..], "`--threads` is 100000, allowed is 1 .. 1024"),
        (&["init", "f"], "f: is a folder"),
        (&["init", "f", "--force"], "f: is a folder"),
        (&["chart", "a.toml", "--out", "o", "--limit-s", "nan"], "`--limit-s` is NaN, allowed is above 0"),
        (&["mesh", "info", "a.msh"], "found `\\u{1b}[2Jabc\\u{7}`"),
    ] {
        let run = scratch.command(words);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{words:?}: {}", run.stderr);
        assert!(run.stderr.contains(complaint) && run.stderr.contains("\nhint: "), "{words:?}: {}", run.stderr);
        assert!(run.stderr.chars().all(|c| c == '\n' || !c.is_control()), "{words:?}: {:?}", run.stderr);
    }
    assert_eq!(scratch.names(), ["a.msh", "a.toml", "f"]);
}

/// A command line that cannot be read is told as everything else is: one line and a hint.
#[test]
fn a_command_line_that_cannot_be_read_is_one_line_and_a_hint() {
    let lists = |command: &str| format!("`ale-gear {command} --help` lists its options");
    for (words, message, hint) in [
        (&["run", "a.toml"][..], "missing on the command line: --out <DIR>", lists("run")),
        (&["run", "--oot", "x"], "unknown option `--oot`", "is `--out` meant?".into()),
        (&["run", "--bogus"], "unknown option `--bogus`", lists("run")),
        (&["run", "a.toml", "b.toml", "--out", "x"], "`b.toml` is one argument too many", lists("run")),
        (
            &["run", "a.toml", "--out", "x", "--out", "y"],
            "`--out <DIR>` is given twice",
            "leave one of them out".into(),
        ),
        (
            &["mesh", "check", "--teeth", "0/24", "a"],
            "`--teeth <Z>` is `0/24`, allowed is a whole number",
            lists("mesh check"),
        ),
        (&["mesh", "check", "--teeth", "0", "a"], "`--teeth` is 0, allowed is 5 .. 2000", "whole gear".into()),
        (&["init", "--teeth"], "`--teeth <Z1,Z2>` has no value", lists("init")),
        (&["mesh", "generate", "a", "--gear", "sun"], "`--gear <GEAR>` is `sun`", "known here: pinion, wheel".into()),
        (&["mesh", "chek"], "unknown subcommand `chek`", "is `check` meant?".into()),
        (&["mesh", "foo"], "unknown subcommand `foo`", "`ale-gear mesh --help` lists its subcommands".into()),
        (&["run", "a.toml", "-out", "o"], "`o` is one argument too many", "is `--out` meant, with two dashes?".into()),
        (&["vary", "a.toml", "--samples", "-5"], "`-5` is not allowed here", "takes no negative number".into()),
        (&["a.toml"], "a subcommand is missing before `a.toml`", "to run it: `ale-gear run a.toml --out DIR`".into()),
    ] {
        let run = Scratch::new().command(words);
        let lines: Vec<&str> = run.stderr.lines().collect();
        assert_eq!((run.code, lines.len(), run.stdout.as_str()), (Some(2), 2, ""), "{words:?}: {}", run.stderr);
        assert_eq!(lines[0], format!("ale-gear: {message}"), "{words:?}");
        assert!(lines[1].starts_with("hint: ") && lines[1].contains(&hint), "{words:?}: {}", lines[1]);
    }
}

/// A pair on the built-in mesher, model and mesh left to the program.
const PLAIN_SCENE: &str = "[pinion]\nteeth = 24\nhelix_angle_deg = 15.0\n[wheel]\nteeth = 31\n[pair]\nnormal_module_mm = 3.0\n\
     face_width_mm = 15.0\n[operation]\ntorque_nm = 200.0\n";

/// What is asked and kept: status 0. Less exact than asked: the result is there, and status 3 says so.
#[test]
fn an_accuracy_that_is_not_kept_has_a_status_of_its_own() {
    let meshed = PLAIN_SCENE.replace("[wheel]", "[pinion.mesher]\nelements_profile = 2\n[wheel]");
    let scratch = Scratch::new().file("a.toml", PLAIN_SCENE).file("meshed.toml", meshed);
    let kept = scratch.ale_gear(["run", "a.toml", "--out", "kept", "--no-cache", "--accuracy", "10%"]);
    fine(&kept);
    let summary = json(&scratch.read("kept/summary.json"));
    assert_eq!(summary["accuracy"]["bounds"][0]["quantity"], "mean_ste");
    assert_eq!(summary["accuracy"]["bounds"][0]["met"], true);
    assert!(scratch.read("kept/report.html").contains("How exact"));
    let words = ["run", "meshed.toml", "--out", "missed", "--no-cache", "--accuracy", "0.01%", "--set"];
    let missed = scratch.command(&[&words[..], &["analysis.model=reduced"]].concat());
    assert_eq!(missed.code, Some(3), "{}", missed.stderr);
    assert!(missed.stderr.contains("the accuracy asked for is not kept: mean_ste is"), "{}", missed.stderr);
    assert_eq!(json(&scratch.read("missed/summary.json"))["accuracy"]["bounds"][0]["met"], false);
    // The program chooses the mesh, or the scene does.
    let both = scratch.ale_gear(["run", "meshed.toml", "--out", "both", "--accuracy", "10%"]);
    assert_eq!((both.code, both.stderr.contains("chooses the mesh")), (Some(2), true), "{}", both.stderr);
}
