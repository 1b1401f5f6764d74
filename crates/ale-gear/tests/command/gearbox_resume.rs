//! A gearbox's motion in parts.

use crate::util::{Run, Scratch, repository};

/// Two stages at two positions, and how they move.
fn two_stages(motion: &str) -> Scratch {
    let folder = repository().join("scenes/gearbox");
    let copy = |scratch: Scratch, name: &str| scratch.file(name, std::fs::read(folder.join(name)).unwrap());
    let scratch = ["first_stage.toml", "second_stage.toml"].into_iter().fold(Scratch::new(), copy);
    let text = std::fs::read_to_string(folder.join("two_stages.toml")).unwrap();
    let (at_rest, _) = text.split_once("[vibration]").unwrap();
    let at_rest = at_rest.replace("positions_per_cycle = 8", "positions_per_cycle = 2");
    scratch.file("box.toml", format!("{at_rest}[motion]\nspeed_rpm = 1500.0\n{motion}"))
}

fn run(scratch: &Scratch, out: &str, words: &[&str]) -> Run {
    scratch.command(&[&["run", "box.toml", "--out", out], words].concat())
}

/// Every kind of mesh and of drive, rows at the ends of cycles and beside them, steps by an error, a motion that settles
/// first: a motion that is stopped and gone on with,
/// twice, has the bytes of one in a piece, and so has one that leaves a checkpoint after every cycle.
#[test]
fn a_motion_in_parts_is_the_one_in_a_piece() {
    for motion in [
        "mesh = \"spring\"\ndrive = \"torque\"\ncycles = 12\nsteps_per_cycle = 20\n",
        "mesh = \"spring\"\nto_speed_rpm = 2500.0\ncycles = 9\nsteps_per_cycle = 20\nsteps_per_row = 3\n",
        "mesh = \"spring\"\nmethod = \"generalised-alpha\"\ncycles = 8\nsteps_per_cycle = 16\nsteps_per_row = 3\n",
        "mesh = \"exact\"\ncycles = 6\nsteps_per_cycle = 12\nsteps_per_row = 3\n",
        "mesh = \"spring\"\nerror_tolerance = 1e-5\nstop_at_events = true\ncycles = 8\nsteps_per_cycle = 16\n",
        "mesh = \"spring\"\nrun = \"steady\"\nperiodic_tolerance = 1e-2\ncycles = 4\nsteps_per_cycle = 16\nsteps_per_row = 4\n",
    ] {
        let scratch = two_stages(motion);
        let whole = run(&scratch, "whole", &[]);
        assert_eq!(whole.code, Some(0), "{motion}: {}", whole.stderr);
        let stopped = run(&scratch, "o", &["--stop-after-cycles", "2"]);
        assert_eq!(stopped.code, Some(0), "{motion}: {}", stopped.stderr);
        assert!(stopped.stdout.contains("go on with\n  ale-gear run box.toml --out o --resume"), "{}", stopped.stdout);
        assert!(!scratch.path().join("o").exists() && scratch.path().join("o.checkpoint/state.json").exists());
        let again = run(&scratch, "o", &["--resume", "--stop-after-cycles", "5", "--json"]);
        let cycles: serde_json::Value = serde_json::from_str(&again.stdout).unwrap();
        // The next row may be some cycles on.
        assert!(cycles["stopped_after_cycles"].as_u64().unwrap() >= 5, "{motion}: {}{}", again.stdout, again.stderr);
        let last = run(&scratch, "o", &["--resume"]);
        assert_eq!(last.code, Some(0), "{motion}: {}", last.stderr);
        let often = run(&scratch, "often", &["--set", "motion.checkpoint_every_cycles=1"]);
        assert_eq!(often.code, Some(0), "{motion}: {}", often.stderr);
        for out in ["o", "often"] {
            for name in ["positions.csv", "motion.csv", "energy.csv"] {
                let [own, uncut] = [out, "whole"].map(|folder| scratch.read(&format!("{folder}/{name}")));
                assert!(own == uncut, "{motion}: {name} of {out} is another than in one piece");
            }
            let [own, uncut] = [out, "whole"].map(|folder| {
                let text = scratch.read(&format!("{folder}/summary.json"));
                serde_json::from_str::<serde_json::Value>(&text).unwrap()["motion"].clone()
            });
            assert_eq!(own, uncut, "{motion}: counts and energy of {out}");
        }
        let left = ["box.toml", "first_stage.toml", "o", "often", "second_stage.toml", "whole"];
        assert_eq!(scratch.names(), left, "{motion}");
    }
}

/// The command that goes on sets what the one that stopped had set, in words that a shell takes.
#[test]
fn the_command_that_goes_on_is_whole() {
    let scratch = two_stages("mesh = \"spring\"\ndrive = \"torque\"\ncycles = 4\nsteps_per_cycle = 20\n");
    let set = ["--set", "motion.cycles=6", "--set", "motion.method=\"generalised-alpha\"", "--stop-after-cycles", "2"];
    let stopped = run(&scratch, "o", &set);
    let again =
        "ale-gear run box.toml --set motion.cycles=6 --set 'motion.method=\"generalised-alpha\"' --out o --resume";
    assert!(stopped.stdout.contains(again), "{}{}", stopped.stdout, stopped.stderr);
}

/// What is not the same any more is refused and named; a motion at a steady speed may be made longer.
#[test]
fn a_motion_is_not_gone_on_with_as_another_one() {
    let scratch = two_stages("mesh = \"spring\"\ncycles = 4\nsteps_per_cycle = 16\n");
    let none = run(&scratch, "o", &["--resume"]);
    assert!(none.stderr.starts_with("ale-gear: o.checkpoint/state.json: there is no checkpoint: "), "{}", none.stderr);
    assert_eq!(run(&scratch, "o", &["--stop-after-cycles", "2"]).code, Some(0));
    let kept = scratch.read("o.checkpoint/rows.jsonl");
    let other = |differs: &str| {
        format!(
            "ale-gear: box.toml: the checkpoint belongs to another gearbox file: {differs}\n\
             hint: go on with what it belongs to, give another `--out`, or run without `--resume` to start from the beginning\n"
        )
    };
    for (set, differs) in [
        ("torque.0.torque_nm=700", "`torque.0` is another one"),
        ("shaft.0.section.0.outer_diameter_mm=26", "`shaft.fast` is another one"),
        ("motion.mesh_damping_ratio=0.06", "`motion.mesh_damping` was Ratio(0.05) and is Ratio(0.06)"),
        ("analysis.shaft_elements=12", "`analysis.shaft_elements` was 16 and is 12"),
        ("mesh.0.set=[\"contact.slices=9\"]", "`mesh.first.scene.contact.slices` was 16 and is 9"),
    ] {
        let refused = run(&scratch, "o", &["--resume", "--set", set]);
        assert_eq!((refused.stderr, refused.code), (other(differs), Some(2)), "{set}");
    }
    let pair = scratch.read("second_stage.toml");
    let changed = scratch.file("second_stage.toml", format!("{pair}\n[material]\npoisson = 0.29\n"));
    let refused = run(&changed, "o", &["--resume"]);
    let differs = "`mesh.second.scene.pinion.material.poisson` was 0.3 and is 0.29; \
                   `mesh.second.scene.wheel.material.poisson` was 0.3 and is 0.29";
    assert_eq!((refused.stderr, refused.code), (other(differs), Some(2)));
    let scratch = changed.file("second_stage.toml", pair);
    assert!(scratch.read("o.checkpoint/rows.jsonl") == kept, "rows were touched");
    // A digit of a row.
    let damaged = kept.replacen("\"normal_force\":1", "\"normal_force\":2", 1);
    let damaged = if damaged == kept { kept.replacen("\"time\":0.0", "\"time\":0.1", 1) } else { damaged };
    assert_ne!(damaged, kept);
    let scratch = scratch.file("o.checkpoint/rows.jsonl", damaged);
    let refused = run(&scratch, "o", &["--resume"]);
    let said = "ale-gear: o.checkpoint/rows.jsonl: is not as its checkpoint left it: changed or damaged\n\
                hint: run without `--resume` to start from the beginning\n";
    assert_eq!((refused.stderr.as_str(), refused.code), (said, Some(2)));
    let scratch = scratch.file("o.checkpoint/rows.jsonl", kept);
    let longer = ["--set", "motion.cycles=5"];
    let whole = run(&scratch, "whole", &longer);
    assert_eq!(whole.code, Some(0), "{}", whole.stderr);
    let resumed = run(&scratch, "o", &[&["--resume"], &longer[..]].concat());
    assert_eq!(resumed.code, Some(0), "{}", resumed.stderr);
    assert!(scratch.read("o/motion.csv") == scratch.read("whole/motion.csv"));
    // Of a gearbox at rest nothing is to be gone on with.
    let text = scratch.read("box.toml");
    let scratch = scratch.file("rest.toml", text.split_once("[motion]").unwrap().0);
    let refused = scratch.ale_gear(["run", "rest.toml", "--out", "r", "--resume"]);
    let said = "ale-gear: rest.toml: this analysis has no checkpoints\n\
                hint: `--resume` and `--stop-after-cycles` belong to gearbox files with [motion]\n";
    assert_eq!((refused.stderr.as_str(), refused.code), (said, Some(2)));
    // A branch is followed in one piece.
    let branch = "[motion]\nrun = \"continuation\"\nspeed_rpm = 1000.0\nto_speed_rpm = 1100.0\nmesh = \"spring\"\n";
    let scratch = scratch.file("branch.toml", text.split_once("[motion]").unwrap().0.to_owned() + branch);
    let refused = scratch.ale_gear(["run", "branch.toml", "--out", "r", "--resume"]);
    assert!(refused.stderr.contains("leave `--resume` and `--stop-after-cycles` out"), "{}", refused.stderr);
}
