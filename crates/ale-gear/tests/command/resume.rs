//! A run that is taken up again is the same run: the same inputs, the same state, the same rows, or none.

use std::fs;

use crate::util::{Run, Scratch, motion_scene};

const ADVICE: &str = "hint: put that one back, or run without `--resume` to start from the beginning\n";
const FROM_START: &str = "hint: run without `--resume` to start from the beginning\n";
const TOPOGRAPHY: &str = "diameter_mm -9 9\n92 0 0\n96 1 1\n101 2 2\n";

fn pitch_errors(first_um: u32) -> String {
    (0..30).map(|k| if k == 0 { format!("{first_um}\n") } else { "0\n".into() }).collect()
}

/// Few cycles of a motion with a file of every kind.
fn with_files() -> String {
    let scene = motion_scene(3, "run = \"span\"\n[pinion.modification]\ntopography = \"topo.csv\"\n");
    let (before, wheel) = scene.split_once("[wheel]\n").unwrap();
    let before = before.lines().filter(|l| !l.starts_with("mesher")).map(|l| format!("{l}\n")).collect::<String>();
    format!("{before}mesh = \"p.msh\"\n[wheel]\npitch_errors_file = \"pitch.csv\"\n{wheel}")
}

/// The pinion's mesh of `plain.toml`.
fn mesh(scratch: &Scratch) -> Vec<u8> {
    let made = scratch.ale_gear(["mesh", "generate", "plain.toml", "--gear", "pinion", "--output", "p.msh", "-q"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    fs::read(scratch.path().join("p.msh")).unwrap()
}

fn plain(bore_mm: f64) -> String {
    motion_scene(3, "").replacen("bore_diameter_mm = 60.0", &format!("bore_diameter_mm = {bore_mm}"), 1)
}

fn cut(scratch: &Scratch) -> Run {
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o", "--stop-after-cycles", "2", "--no-cache"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    run
}

fn resume(scratch: &Scratch) -> Run {
    scratch.ale_gear(["run", "a.toml", "--out", "o", "--resume", "--no-cache"])
}

/// Any file that the scene names, once it holds something else, is named, and nothing is touched; put back it is good
/// again.
#[test]
fn a_run_is_not_gone_on_with_from_other_files() {
    let scratch = Scratch::new().file("plain.toml", plain(64.0));
    let other_mesh = mesh(&scratch);
    let scratch = scratch.file("plain.toml", plain(60.0));
    let own_mesh = mesh(&scratch);
    assert_ne!(own_mesh, other_mesh);
    let scratch = scratch.file("topo.csv", TOPOGRAPHY).file("pitch.csv", pitch_errors(1)).file("a.toml", with_files());
    cut(&scratch);
    let kept = scratch.read("o.checkpoint/history.csv");
    let put = |name: &str, content: &[u8]| fs::write(scratch.path().join(name), content).unwrap();
    for (name, own, other) in [
        ("topo.csv", TOPOGRAPHY.as_bytes().to_vec(), TOPOGRAPHY.replace("96 1 1", "96 9 9").into_bytes()),
        ("pitch.csv", pitch_errors(1).into_bytes(), pitch_errors(7).into_bytes()),
        ("p.msh", own_mesh, other_mesh),
    ] {
        put(name, &other);
        let refused = resume(&scratch);
        let said = format!("ale-gear: {name}: is not the file that the checkpoint was written with\n{ADVICE}");
        assert_eq!((refused.stderr, refused.code), (said, Some(2)));
        assert!(scratch.read("o.checkpoint/history.csv") == kept, "{name}: rows were touched");
        put(name, &own);
    }
    let whole = resume(&scratch);
    assert_eq!(whole.code, Some(0), "{}", whole.stderr);
    assert!(scratch.read("o/history.csv").starts_with(&kept), "rows before the stop are not those after it");
}

/// What was changed in the checkpoint itself is seen: one digit of the state or of any row is enough.
#[test]
fn a_checkpoint_bears_its_own_digest() {
    let scratch = Scratch::new().file("a.toml", motion_scene(3, "run = \"span\"\n"));
    cut(&scratch);
    let state = "is not as it was written: changed, damaged or of another version";
    let rows = "is not as its checkpoint left it: changed or damaged";
    // The last digit of the text before its last line's end: a number somewhere.
    let digit = |text: &str| {
        let at = text.rfind(|c: char| ('1'..='8').contains(&c)).unwrap();
        let next = char::from(text.as_bytes()[at] + 1);
        format!("{}{next}{}", &text[..at], &text[at + 1..])
    };
    let shorter = |text: &str| text[..text.len() - 20].to_owned();
    let row_lost = "is shorter than its checkpoint says";
    type Damage<'a> = &'a dyn Fn(&str) -> String;
    for (name, damage, what) in [
        ("state.json", &digit as Damage<'_>, state),
        ("state.json", &shorter, state),
        ("history.csv", &digit, rows),
        ("energy.csv", &digit, rows),
        ("history.csv", &shorter, row_lost),
    ] {
        let file = format!("o.checkpoint/{name}");
        let own = scratch.read(&file);
        fs::write(scratch.path().join(&file), damage(&own)).unwrap();
        let refused = resume(&scratch);
        assert_eq!((refused.stderr, refused.code), (format!("ale-gear: {file}: {what}\n{FROM_START}"), Some(2)));
        fs::write(scratch.path().join(&file), own).unwrap();
    }
    let whole = resume(&scratch);
    assert_eq!(whole.code, Some(0), "{}", whole.stderr);
    assert_eq!(scratch.names(), ["a.toml", "o"]);
}

/// A run that was killed before its first checkpoint has left its folder: it begins anew, with a remark, to the same
/// bytes.
#[test]
fn a_run_without_a_checkpoint_yet_begins_anew() {
    let scratch = Scratch::new().file("a.toml", motion_scene(1, "run = \"span\"\n"));
    assert_eq!(scratch.ale_gear(["run", "a.toml", "--out", "whole", "--no-cache"]).code, Some(0));
    fs::create_dir(scratch.path().join("o.checkpoint")).unwrap();
    fs::write(scratch.path().join("o.checkpoint/history.csv"), "time_s\n0.1,torn").unwrap();
    fs::write(scratch.path().join("o.checkpoint/in_use"), "ale-gear keeps checkpoints here\n").unwrap();
    let run = resume(&scratch);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let remark = "ale-gear: o.checkpoint: the run was cut short before its first checkpoint and begins anew\n";
    assert!(run.stderr.contains(remark), "{}", run.stderr);
    assert!(scratch.read("o/history.csv") == scratch.read("whole/history.csv"));
    assert_eq!(scratch.names(), ["a.toml", "o", "whole"]);
}

/// Two runs never write into the same rows.
#[test]
fn a_checkpoint_in_use_is_left_alone() {
    let scratch = Scratch::new().file("a.toml", motion_scene(3, "run = \"span\"\n"));
    cut(&scratch);
    let held = fs::File::open(scratch.path().join("o.checkpoint/in_use")).unwrap();
    held.try_lock().unwrap();
    for words in [&["--resume"][..], &["--stop-after-cycles", "1"]] {
        let run = scratch.command(&[&["run", "a.toml", "--out", "o", "--no-cache"], words].concat());
        let said = "ale-gear: o.checkpoint: another run writes its checkpoints there\nhint: wait for its end, or give another `--out`\n";
        assert_eq!((run.stderr.as_str(), run.code), (said, Some(2)));
    }
    drop(held);
    assert_eq!(resume(&scratch).code, Some(0));
}
