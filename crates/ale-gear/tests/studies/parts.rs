//! `ale-gear vary --cases` and `ale-gear merge`: the cases of a plan in pieces.

use crate::util::{ISO_SCENE, Scratch};

const PLAN: &str = r#"
scene = "iso.toml"
[vary]
keys = ["operation.torque_nm~50:1e3"]
output = ["mean_ste_um"]
samples = 50
"#;

fn scratch() -> Scratch {
    Scratch::new().file("iso.toml", ISO_SCENE).file("plan.toml", PLAN)
}

fn part(scratch: &Scratch, range: &str, out: &str) {
    let run = scratch.ale_gear(["--quiet", "vary", "plan.toml", "--cases", range, "--out", out]);
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (Some(0), "", ""), "{range}");
}

/// Pieces in any order, one of them twice and overlapping, make the bytes of one machine.
#[test]
fn pieces_make_what_one_machine_makes() {
    let scratch = scratch();
    assert_eq!(scratch.ale_gear(["vary", "plan.toml", "--out", "whole"]).code, Some(0));
    let listed = scratch.ale_gear(["--quiet", "vary", "plan.toml", "--list", "20"]).stdout;
    assert_eq!(listed, "0..20\n20..40\n40..50\n");
    for (range, out) in [("40..99", "c.csv"), ("0..20", "a.csv"), ("10..40", "b.csv")] {
        part(&scratch, range, out);
    }
    let before = scratch.read("a.csv");
    // Once more, with other threads: the same file.
    let again = scratch.ale_gear(["-j", "1", "vary", "plan.toml", "--cases", "0..20", "--out", "a.csv"]);
    assert!(again.stdout.contains("cases 0..20 of 50 are there"), "{}", again.stdout);
    std::fs::remove_file(scratch.path().join("a.csv")).unwrap();
    part(&scratch, "0..20", "a.csv");
    assert_eq!(scratch.read("a.csv"), before);
    let merged = scratch.ale_gear(["merge", "plan.toml", "c.csv", "a.csv", "b.csv", "--out", "all"]);
    assert_eq!(merged.code, Some(0), "{}", merged.stderr);
    assert_eq!(scratch.read("all/cases.csv"), scratch.read("whole/cases.csv"));
    let parquet = |folder: &str| std::fs::read(scratch.path().join(folder).join("cases.parquet")).unwrap();
    assert_eq!(parquet("all"), parquet("whole"));
    assert_eq!(scratch.names().iter().filter(|name| name.contains(".new")).count(), 0, "nothing is left behind");
}

/// A part that has the cases already is left alone, one that has others of them or is of another plan as well; one that was
/// cut short is made again.
#[test]
fn no_part_loses_its_rows() {
    let scratch = scratch();
    part(&scratch, "0..20", "a.csv");
    let whole = scratch.read("a.csv");
    let run = |range: &str| scratch.ale_gear(["vary", "plan.toml", "--cases", range, "--out", "a.csv"]);
    assert!(run("5..7").stdout.contains("cases 5..7 of 50 are there"));
    let others = run("10..30");
    assert_eq!(others.code, Some(2));
    assert!(others.stderr.contains("--out a.csv: has the cases 0..20 of this plan\nhint: "), "{}", others.stderr);
    assert_eq!(scratch.read("a.csv"), whole);
    std::fs::write(scratch.path().join("a.csv"), &whole[..whole.len() / 2]).unwrap();
    assert_eq!(run("0..20").code, Some(0));
    assert_eq!(scratch.read("a.csv"), whole);
    std::fs::write(scratch.path().join("iso.toml"), ISO_SCENE.to_owned() + "positions_per_cycle = 7\n").unwrap();
    let another = run("0..20");
    assert_eq!((another.code, scratch.read("a.csv")), (Some(2), whole));
    assert!(another.stderr.contains("has cases of another plan or version\nhint: "), "{}", another.stderr);
}

/// What is missing, cut short, changed or of another plan is named and refused.
#[test]
fn pieces_that_do_not_fit_are_refused() {
    let scratch = scratch();
    part(&scratch, "0..30", "a.csv");
    part(&scratch, "30..50", "b.csv");
    let refused = |parts: &[&str], wanted: &str| {
        let run = scratch.command(&[&["merge", "plan.toml"], parts, &["--out", "all"]].concat());
        assert_eq!(run.code, Some(2), "{}", run.stdout);
        assert!(run.stderr.contains(wanted), "`{wanted}` is not in {}", run.stderr);
        assert!(!scratch.path().join("all").exists());
    };
    refused(&["a.csv"], "cases 30..50 are in no part");
    refused(&["a.csv", "none.csv"], "none.csv cannot be read");
    let whole = scratch.read("b.csv");
    let write = |text: &str| std::fs::write(scratch.path().join("cut.csv"), text).unwrap();
    write(&whole[..whole.len() - 10]);
    refused(&["a.csv", "cut.csv"], "it was cut short");
    write(&whole.replacen(",solved,", ",SOLVED,", 1));
    refused(&["a.csv", "cut.csv"], "it was cut short, or changed");
    // A scene with another load is another plan, for the keys that are not varied as well.
    let other = ISO_SCENE.to_owned() + "positions_per_cycle = 7\n";
    assert_ne!(other, ISO_SCENE);
    std::fs::write(scratch.path().join("iso.toml"), other).unwrap();
    refused(&["a.csv", "b.csv"], "plan, scene or version of the program are others");
    for range in ["5..5", "7", "b..c"] {
        let run = scratch.ale_gear(["vary", "plan.toml", "--cases", range, "--out", "x.csv"]);
        assert_eq!(run.code, Some(2), "{range}");
    }
}
