//! Where results go and what is read: work folders of killed runs, links, devices, the scene that is part of the
//! program.
#![cfg(unix)]

use std::{
    fs,
    os::unix::fs::symlink,
    path::PathBuf,
    process::{Child, Command, Stdio},
};

use crate::util::{ISO_SCENE, MOTION_LINES, Scratch, motion_scene, repository};

const MARK: &str = ".ale-gear-work";
/// By what an earlier result is known.
const RECORD: &str = "{ \"program\": \"ale-gear\", \"files\": [\"history.csv\"] }";

/// A motion that goes on until it is killed.
fn endless() -> String {
    motion_scene(1_000, "run = \"span\"\n")
        .replace(MOTION_LINES, "[motion]\nsteps_per_mesh_cycle = 1000\nsteps_per_resonance = 0\n")
}

fn start(scratch: &Scratch, out: &str) -> Child {
    Command::new(env!("CARGO_BIN_EXE_ale-gear"))
        .args(["run", "endless.toml", "--out", out, "--no-cache"])
        .current_dir(scratch.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// The work folder of a run that writes there, as soon as its mark can be seen.
fn work_folder(scratch: &Scratch, out: &str, run: &mut Child) -> PathBuf {
    let beginning = format!(".{out}.partial-");
    loop {
        for name in scratch.names().iter().filter(|n| n.starts_with(&beginning)) {
            let folder = scratch.path().join(name);
            if folder.join(MARK).exists() {
                return folder;
            }
        }
        assert!(run.try_wait().unwrap().is_none(), "the run has ended by itself");
        std::thread::yield_now();
    }
}

/// What a killed run has left in its place.
fn killed(scratch: &Scratch, out: &str) -> PathBuf {
    let mut run = start(scratch, out);
    let folder = work_folder(scratch, out, &mut run);
    // SIGKILL: no handler of the program sees it.
    run.kill().unwrap();
    run.wait().unwrap();
    assert!(folder.exists(), "the killed run has cleaned up after itself");
    folder
}

fn scratch() -> Scratch {
    Scratch::new().file("a.toml", ISO_SCENE).file("endless.toml", endless())
}

fn fine(scratch: &Scratch, out: &str) {
    // Quiet, since a slow machine would have more to say.
    let run = scratch.ale_gear(["run", "a.toml", "--out", out, "-q"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
}

/// The next run into the same place takes away what a killed one has left there, and what belongs to a living one or to
/// nobody it knows stays.
#[test]
fn folders_of_killed_runs_go_and_all_others_stay() {
    let scratch = scratch();
    let left = killed(&scratch, "o");
    let mark = fs::read_to_string(left.join(MARK)).unwrap();
    let mut living = start(&scratch, "p");
    let of_living = work_folder(&scratch, "p", &mut living);
    // Never made by this program, or no longer only its own.
    let make = |name: &str, files: &[(&str, &str)]| {
        let folder = scratch.path().join(name);
        fs::create_dir_all(folder.join("new")).unwrap();
        files.iter().for_each(|(file, text)| fs::write(folder.join(file), text).unwrap());
    };
    let (host, _) = mark.split_once("\nprocess").unwrap();
    make(".o.partial-1", &[("new/history.csv", "time_s\n")]);
    make(".o.partial-2", &[(MARK, &mark), ("new/thesis.tex", "years of work")]);
    make(".o.partial-3", &[(MARK, &mark), ("thesis.tex", "years of work")]);
    make(".o.partial-4", &[(MARK, &mark.replace(host, &format!("{host}-other")))]);
    make(".o.partial-5a", &[(MARK, &mark)]);
    make(".o.partial-6", &[(MARK, "another program's\n")]);
    // Killed before there was a mark: nothing but an empty folder, or the mark in the making.
    let bare = [".o.partial-7", ".o.partial-8"];
    bare.iter().for_each(|name| fs::create_dir(scratch.path().join(name)).unwrap());
    fs::write(scratch.path().join(bare[1]).join(format!("{MARK}.new")), "").unwrap();
    let goes = |name: &str| bare.contains(&name) || name == left.file_name().unwrap().to_str().unwrap();
    let stay = scratch.names().into_iter().filter(|n| !goes(n));
    let mut stay: Vec<String> = stay.chain(["o".to_owned()]).collect();
    stay.sort();
    fine(&scratch, "o");
    assert_eq!(scratch.names(), stay);
    // In the place of the living one too.
    fine(&scratch, "p");
    assert!(of_living.join("new").is_dir(), "the folder of a living run is gone");
    living.kill().unwrap();
    living.wait().unwrap();
    fine(&scratch, "p");
    assert!(!of_living.exists(), "it is left after its death");
}

/// Killed between the two renames of the end: the next run finds the new result and puts it where it belongs.
#[test]
fn a_result_that_was_whole_when_the_run_was_killed_is_not_lost() {
    let scratch = scratch();
    let left = killed(&scratch, "o");
    fs::remove_dir_all(left.join("new")).unwrap();
    for (name, text) in [("old", "earlier"), ("new", "later")] {
        fs::create_dir(left.join(name)).unwrap();
        fs::write(left.join(name).join("history.csv"), text).unwrap();
        fs::write(left.join(name).join("summary.json"), RECORD).unwrap();
    }
    // It comes to nothing itself, so what it found can be seen.
    let failing = scratch.ale_gear(["run", "a.toml", "--out", "o", "--set", "pair.centre_distance_mm=80"]);
    assert_eq!(failing.code, Some(2), "{}", failing.stdout);
    assert_eq!((scratch.read("o/history.csv").as_str(), left.exists()), ("later", false));
}

/// A link to a folder stays one, and the folder that it leads to is replaced.
#[test]
fn results_are_written_through_a_link() {
    let scratch = scratch();
    let at = |name: &str| scratch.path().join(name);
    fs::create_dir_all(at("disk/results")).unwrap();
    fs::write(at("disk/results/history.csv"), "an earlier one").unwrap();
    fs::write(at("disk/results/summary.json"), RECORD).unwrap();
    symlink("disk/results", at("o")).unwrap();
    for out in ["o", "o/"] {
        fine(&scratch, out);
        assert!(fs::symlink_metadata(at("o")).unwrap().is_symlink(), "{out}: the link is replaced");
        assert!(scratch.read("disk/results/history.csv").starts_with("time_s,"), "{out}");
        assert_eq!(fs::read_dir(at("disk")).unwrap().count(), 1, "{out}: something is left beside the results");
    }
    fs::write(at("disk/results/thesis.tex"), "years of work").unwrap();
    let refused = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert!(refused.stderr.contains("holds `thesis.tex`"), "{}", refused.stderr);
    symlink("nowhere", at("lost")).unwrap();
    let refused = scratch.ale_gear(["run", "a.toml", "--out", "lost"]);
    assert!(refused.stderr.starts_with("ale-gear: --out lost: is a link that leads nowhere: "), "{}", refused.stderr);
    assert_eq!(refused.code, Some(2));
}

/// What has no end is not read: devices, and pipes that nobody writes into. What the shell hands over is.
#[test]
fn only_what_has_an_end_is_read() {
    let reduced = ISO_SCENE.replace("model = \"iso\"", "model = \"reduced\"");
    let with = |old: &str, new: &str| reduced.replacen(old, new, 1);
    let scratch = scratch()
        .file("mesh.toml", with("bore_diameter_mm = 60.0\n", "mesh = \"/dev/zero\"\n"))
        .file("pitch.toml", with("[wheel]\n", "[wheel]\npitch_errors_file = \"pipe\"\n"))
        .file("grid.toml", format!("{reduced}[pinion.modification]\ntopography = \"/dev/zero\"\n"))
        .file("study.toml", "[[case]]\nscene = \"pipe\"\nvalue = 1\n[[quantity]]\ncolumn = \"ste_um\"\n");
    assert!(Command::new("mkfifo").arg(scratch.path().join("pipe")).status().unwrap().success());
    symlink("/dev/zero", scratch.path().join("zero.msh")).unwrap();
    const NO_FILE: &str = "it is a device or a pipe, not a file";
    for (words, text) in [
        (&["run", "mesh.toml", "--out", "o"][..], "mesh.toml:4: `mesh` is \"/dev/zero\", but "),
        (&["run", "pitch.toml", "--out", "o"], "pitch.toml:7: `pitch_errors_file` is \"pipe\", but "),
        (&["run", "grid.toml", "--out", "o"], "grid.toml:18: `topography` is \"/dev/zero\", but "),
        (&["run", "pipe", "--out", "o"], "pipe: cannot be read: "),
        (&["run", "/dev/zero", "--out", "o"], "/dev/zero: cannot be read: "),
        (&["vary", "pipe", "--out", "o"], "pipe: cannot be read: "),
        (&["run", "study.toml", "--out", "o"], "study.toml:2: \"pipe\" cannot be read: "),
        (&["init", "new.toml", "--rexs", "pipe"], "pipe: cannot be read: "),
        (&["mesh", "info", "/dev/zero"], "/dev/zero: cannot be read: "),
        (&["mesh", "reduce", "zero.msh"], "zero.msh: cannot be read: "),
    ] {
        let run = scratch.command(words);
        assert_eq!(run.code, Some(2), "{words:?}: {}", run.stderr);
        assert!(run.stderr.starts_with(&format!("ale-gear: {text}")), "{words:?}: {}", run.stderr);
        assert!(run.stderr.contains(NO_FILE), "{words:?}: {}", run.stderr);
    }
    let handed =
        scratch.shell("ale-gear run /dev/stdin --out o -q < a.toml; cat a.toml | ale-gear run /dev/stdin --out o -q");
    assert_eq!((handed.code, handed.stderr.as_str()), (Some(0), ""), "{}", handed.stdout);
    let endless = scratch.shell("ale-gear run /dev/stdin --out p < /dev/zero");
    assert_eq!(endless.code, Some(2));
    assert!(endless.stderr.contains("/dev/stdin: cannot be read: it goes on beyond 16 MB"), "{}", endless.stderr);
}

/// Without a word the default pair runs anywhere, says so, and gives the numbers of the scene of the repository.
#[test]
fn the_default_pair_is_in_the_program() {
    let scratch = Scratch::new();
    // A copy of its own far from the repository: nothing of that is to be found from here.
    let program = scratch.path().join("installed");
    fs::copy(env!("CARGO_BIN_EXE_ale-gear"), &program).unwrap();
    let run = scratch.shell("./installed && mv out/default bare");
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stderr.starts_with(
            "ale-gear: no scene given: runs the default pair, which is in the program, into out/default; `ale-gear run SCENE.toml --out DIR` runs another"
        ),
        "{}",
        run.stderr
    );
    let scene = repository().join("scenes/default.toml");
    let own = scratch.command(&["run", &scene.display().to_string(), "--out", "o", "-q"]);
    assert_eq!(own.code, Some(0), "{}", own.stderr);
    assert!(scratch.read("bare/history.csv") == scratch.read("o/history.csv"), "other numbers than the scene's");
    let summary = |out: &str| -> serde_json::Value {
        serde_json::from_str(&scratch.read(&format!("{out}/summary.json"))).unwrap()
    };
    assert_eq!(summary("bare")["inputs"], summary("o")["inputs"]);
    assert!(scratch.read("bare/report.html").contains("<pre>ale-gear</pre>"), "how to make it again");
}
