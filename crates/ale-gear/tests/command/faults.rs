//! What the machine does to a run: a disk that is full, a place where nobody may write, two runs at one cache, no home,
//! a clock that goes back. Nothing that was reported is lost, nothing half written is taken for whole.
#![cfg(unix)]

use std::{
    fs,
    path::Path,
    process::{Command, Stdio},
    time::{Duration, SystemTime},
};

use crate::util::{ISO_SCENE, Run, Scratch, motion_scene};

/// The default pair at rest on tiny meshes.
fn reduced() -> String {
    let mesher = "elements_profile = 2\nelements_fillet = 2\nelements_thickness = 2\nelements_face = 2\n";
    let meshers = ["pinion", "wheel"].map(|g| format!("[{g}.mesher]\norder = 1\n{mesher}elements_rim = 1\n"));
    ISO_SCENE.replace("model = \"iso\"", "positions_per_cycle = 4") + &meshers.concat()
}

/// The program where no file may grow beyond so many bytes: as if the disk were full there.
fn on_a_full_disk(scratch: &Scratch, kilobytes: u32, words: &str) -> Run {
    // Blocks are of 512 bytes. Without the trap the signal would end the program, as no full disk does.
    scratch.shell(&format!("trap '' XFSZ; ulimit -f {}; exec ale-gear {words}", 2 * kilobytes))
}

fn future(path: &Path) {
    let later = SystemTime::now() + Duration::from_secs(10 * 24 * 3600);
    fs::File::options().append(true).open(path).unwrap().set_modified(later).unwrap();
}

/// Wherever the disk is full, the run says so with status 1 and leaves nothing; where it is not, the result is whole.
#[test]
fn a_full_disk_leaves_no_half_result() {
    let scratch = Scratch::new().file("a.toml", reduced());
    assert_eq!(scratch.ale_gear(["run", "a.toml", "--out", "whole", "--no-cache"]).code, Some(0));
    let (mut failed, mut done) = (0, 0);
    for kilobytes in [0, 1, 4, 16, 64, 100_000] {
        let run = on_a_full_disk(&scratch, kilobytes, "run a.toml --out o --no-cache -q");
        match run.code {
            Some(0) => {
                done += 1;
                assert!(scratch.read("o/history.csv") == scratch.read("whole/history.csv"), "{kilobytes} kB");
                fs::remove_dir_all(scratch.path().join("o")).unwrap();
            }
            Some(1) => {
                failed += 1;
                assert!(run.stderr.starts_with("ale-gear: "), "{kilobytes} kB: {}", run.stderr);
                assert!(run.stderr.contains("cannot be written"), "{kilobytes} kB: {}", run.stderr);
                assert!(run.stderr.contains("\nhint: is the disk full"), "{kilobytes} kB: {}", run.stderr);
            }
            other => panic!("{kilobytes} kB: status {other:?}, {}", run.stderr),
        }
        assert_eq!(scratch.names(), ["a.toml", "whole"], "{kilobytes} kB: something is left");
    }
    assert!(failed >= 3 && done >= 1, "{failed} runs met a full disk, {done} did not");
}

/// A cache that cannot take a record costs a warning and no result, and holds nothing that a later run would take.
#[test]
fn a_full_disk_below_the_cache_costs_a_warning() {
    let scratch = Scratch::new().file("a.toml", reduced());
    // The results go to where there is room: the shell's limit is for both, so the run is of the gears alone.
    let run = on_a_full_disk(&scratch, 4, "mesh reduce a.toml --cache kept");
    assert!(matches!(run.code, Some(0 | 1)), "{:?}: {}", run.code, run.stderr);
    let next = scratch.ale_gear(["run", "a.toml", "--out", "o", "--cache", "kept"]);
    assert_eq!((next.code, next.stderr.as_str()), (Some(0), ""), "{}", next.stdout);
    assert!(!next.stdout.contains("reduced again"), "a half record was found: {}", next.stdout);
    assert_eq!(scratch.ale_gear(["run", "a.toml", "--out", "p", "--no-cache"]).code, Some(0));
    assert!(scratch.read("o/history.csv") == scratch.read("p/history.csv"));
}

/// A motion whose checkpoint meets a full disk says so; taken up where there is room it ends as if nothing had been.
#[test]
fn a_motion_on_a_full_disk_goes_on_from_its_last_checkpoint() {
    let motion = motion_scene(40, "run = \"span\"\ncheckpoint_every_cycles = 1\n");
    let scratch = Scratch::new().file("a.toml", motion);
    assert_eq!(scratch.ale_gear(["run", "a.toml", "--out", "whole", "--no-cache"]).code, Some(0));
    let mut kept = 0;
    for kilobytes in [8, 100, 250, 300] {
        let run = on_a_full_disk(&scratch, kilobytes, "run a.toml --out o --no-cache -q");
        assert_eq!(run.code, Some(1), "{kilobytes} kB: {}", run.stderr);
        assert!(run.stderr.contains("cannot be written"), "{kilobytes} kB: {}", run.stderr);
        assert!(!scratch.path().join("o").exists(), "{kilobytes} kB: a result without an end");
        kept += u32::from(scratch.path().join("o.checkpoint/state.json").exists());
        let next = scratch.ale_gear(["run", "a.toml", "--out", "o", "--no-cache", "--resume"]);
        assert_eq!(next.code, Some(0), "{kilobytes} kB: {}", next.stderr);
        for file in ["history.csv", "energy.csv", "spectrum.csv"] {
            let [now, whole] = ["o", "whole"].map(|folder| scratch.read(&format!("{folder}/{file}")));
            assert!(now == whole, "{kilobytes} kB: {file} is another");
        }
        fs::remove_dir_all(scratch.path().join("o")).unwrap();
    }
    assert!(kept > 0, "no checkpoint was there when the disk was full");
}

/// Where nobody may write the run says so before it computes anything. (`/proc` refuses even the superuser.)
#[cfg(target_os = "linux")]
#[test]
fn a_place_where_nobody_may_write_is_named() {
    let scratch = Scratch::new().file("a.toml", reduced());
    let run = scratch.ale_gear(["run", "a.toml", "--out", "/proc/ale-gear/o", "--no-cache"]);
    assert!(matches!(run.code, Some(1 | 2)), "{:?}: {}", run.code, run.stderr);
    assert!(run.stderr.starts_with("ale-gear: ") && run.stderr.contains("/proc/"), "{}", run.stderr);
    assert!(run.stderr.contains("\nhint: "), "{}", run.stderr);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--cache", "/proc/ale-gear"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stdout.contains("the next run will reduce the gear again"), "{}", run.stdout);
}

/// Several runs that begin at once with one empty cache: each has its result, and the cache is sound.
#[test]
fn runs_share_a_cache() {
    let scratch = Scratch::new().file("a.toml", reduced());
    assert_eq!(scratch.ale_gear(["run", "a.toml", "--out", "whole", "--no-cache"]).code, Some(0));
    let whole = scratch.read("whole/history.csv");
    let outs = ["o1", "o2", "o3", "o4"];
    let start = |out: &str| {
        let words = ["run", "a.toml", "--out", out, "--cache", "kept", "-q", "--threads", "1"];
        scratch.program().args(words).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    };
    for round in 0..3 {
        let runs = outs.map(start);
        for (run, out) in runs.into_iter().zip(outs) {
            let ended = run.wait_with_output().unwrap();
            assert!(ended.status.success(), "{out}, round {round}: {}", String::from_utf8_lossy(&ended.stderr));
            assert!(scratch.read(&format!("{out}/history.csv")) == whole, "{out}, round {round}");
        }
    }
    let last = scratch.ale_gear(["run", "a.toml", "--out", "o", "--cache", "kept"]);
    assert_eq!(last.code, Some(0), "{}", last.stderr);
    assert!(!last.stdout.contains("reduced again"), "the cache holds a spoilt record: {}", last.stdout);
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    assert_eq!(summary["model"]["gears_from_cache"], 2);
}

/// Two runs into one folder at once: one of them is the result in the end, whole.
#[test]
fn runs_into_one_folder_leave_one_whole_result() {
    let scratch = Scratch::new().file("a.toml", reduced());
    assert_eq!(scratch.ale_gear(["run", "a.toml", "--out", "whole", "--no-cache"]).code, Some(0));
    for round in 0..3 {
        let start = || {
            let words = ["run", "a.toml", "--out", "o", "--no-cache", "-q", "--threads", "1"];
            scratch.program().args(words).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
        };
        let ended = [start(), start(), start()].map(|run| run.wait_with_output().unwrap());
        let won = ended.iter().filter(|e| e.status.success()).count();
        assert!(won >= 1, "round {round}: {}", String::from_utf8_lossy(&ended[0].stderr));
        for lost in ended.iter().filter(|e| !e.status.success()) {
            let said = String::from_utf8_lossy(&lost.stderr);
            assert!(said.starts_with("ale-gear: ") && !said.contains("panicked"), "round {round}: {said}");
        }
        assert!(scratch.read("o/history.csv") == scratch.read("whole/history.csv"), "round {round}");
        assert!(scratch.path().join("o/summary.json").exists(), "round {round}");
        assert_eq!(scratch.names(), ["a.toml", "o", "whole"], "round {round}");
    }
}

/// Without a home there is nowhere to keep gears: the result is the same.
#[test]
fn no_home_costs_no_result() {
    let scratch = Scratch::new().file("a.toml", reduced());
    assert_eq!(scratch.ale_gear(["run", "a.toml", "--out", "whole", "--no-cache"]).code, Some(0));
    // Nobody can make a folder below `/proc`, not even the superuser.
    for home in [None, Some(""), Some("/proc/nowhere")] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ale-gear"));
        command.current_dir(scratch.path()).args(["run", "a.toml", "--out", "o", "-q"]);
        command.env_remove("HOME").env_remove("XDG_CACHE_HOME");
        if let Some(home) = home {
            command.env("HOME", home);
        }
        let run = Scratch::done(&mut command);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "HOME {home:?}: {}", run.stdout);
        assert!(scratch.read("o/history.csv") == scratch.read("whole/history.csv"), "HOME {home:?}");
    }
}

/// Files that seem to come from tomorrow, since the clock was put back, are what they were.
#[test]
fn a_clock_that_goes_back_changes_nothing() {
    let motion = motion_scene(4, "run = \"span\"\n");
    let scratch = Scratch::new().file("a.toml", reduced()).file("m.toml", motion);
    let first = scratch.ale_gear(["run", "a.toml", "--out", "first", "--cache", "kept"]);
    assert_eq!(first.code, Some(0), "{}", first.stderr);
    for entry in fs::read_dir(scratch.path().join("kept")).unwrap() {
        future(&entry.unwrap().path());
    }
    future(&scratch.path().join("a.toml"));
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--cache", "kept"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    assert!(scratch.read("o/history.csv") == scratch.read("first/history.csv"));
    assert_eq!(scratch.ale_gear(["run", "m.toml", "--out", "whole", "--no-cache"]).code, Some(0));
    let cut = scratch.ale_gear(["run", "m.toml", "--out", "p", "--no-cache", "--stop-after-cycles", "2"]);
    assert_eq!(cut.code, Some(0), "{}", cut.stderr);
    for entry in fs::read_dir(scratch.path().join("p.checkpoint")).unwrap() {
        future(&entry.unwrap().path());
    }
    let run = scratch.ale_gear(["run", "m.toml", "--out", "p", "--no-cache", "--resume"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    assert!(scratch.read("p/history.csv") == scratch.read("whole/history.csv"));
}
