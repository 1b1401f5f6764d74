//! Documents whose tables stand in other documents: the pair of a mesh, the scene of a case.

use std::path::{Path, PathBuf};

use scene::{
    Document, Setting,
    gearbox::Gearbox,
    plan::{Plan, Start, StartedPlan},
    study::Study,
};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox")
}

fn text(name: &str) -> String {
    std::fs::read_to_string(folder().join(name)).unwrap()
}

/// The tables of a scene below the name that another document has for it.
fn below(name: &str, scene: &str) -> String {
    let line = |line: &str| match line.strip_prefix('[') {
        Some(table) if !table.starts_with('[') => format!("[{name}.{table}\n"),
        _ => format!("{line}\n"),
    };
    format!("[{name}]\n{}", scene.lines().map(line).collect::<String>())
}

/// Two stages with both pairs in the file itself.
fn in_one_file() -> String {
    let mut all = text("two_stages.toml");
    for (file, name) in [("first_stage.toml", "first"), ("second_stage.toml", "second")] {
        let path = format!("scene = \"{file}\"\n");
        assert!(all.contains(&path), "no {path}");
        all = all.replacen(&path, "", 1);
        let head = format!("[[mesh]]\nname = \"{name}\"\n");
        let start = all.find(&head).unwrap() + head.len();
        let end = start + all[start..].find("\n[").unwrap() + 1;
        all.insert_str(end, &below("mesh.scene", &text(file)));
    }
    all
}

/// A gearbox with its pairs in its own file is the gearbox with the pairs in theirs, also where keys are set beside it; only
/// where they stand differs.
#[test]
fn pairs_may_stand_in_the_gearbox_file() {
    let file = folder().join("two_stages.toml");
    let set = ["mesh.first.scene.pinion.modification.lead_slope_um=7", "mesh.1.scene.contact.slices=12"]
        .map(|word| Setting::parse(word).unwrap());
    for settings in [&[][..], &set] {
        let apart = Gearbox::parse_with(&text("two_stages.toml"), &file, settings).unwrap();
        let mut one = Gearbox::parse_with(&in_one_file(), &file, settings).unwrap();
        for (own, other) in one.meshes.iter_mut().zip(&apart.meshes) {
            assert_eq!(own.scene.file, file, "what it names is relative to the folder of the gearbox");
            assert_ne!(other.scene.file, file);
            own.scene.file.clone_from(&other.scene.file);
        }
        assert_eq!(one, apart);
    }
}

/// Tables below a document that has no heading of its own, `[mesh.scene.pinion]` alone, and one in braces are told apart: each
/// mesh has its own pair.
#[test]
fn pairs_need_no_heading_of_their_own() {
    let file = folder().join("two_stages.toml");
    let apart = Gearbox::parse(&in_one_file(), &file).unwrap();
    // What stands above the first table of a scene is its name alone.
    let bare: String = {
        let all = in_one_file();
        let mut lines = all.lines().peekable();
        let mut kept = String::new();
        while let Some(line) = lines.next() {
            if line == "[mesh.scene]" {
                while lines.peek().is_some_and(|next| !next.starts_with('[')) {
                    lines.next();
                }
            } else {
                kept += line;
                kept.push('\n');
            }
        }
        kept
    };
    assert!(!bare.contains("[mesh.scene]") && bare.contains("[mesh.scene.pinion]"));
    let mut one = Gearbox::parse(&bare, &file).unwrap();
    assert_ne!(one.meshes[0].scene.pinion.teeth, one.meshes[1].scene.pinion.teeth);
    for (own, other) in one.meshes.iter_mut().zip(&apart.meshes) {
        assert_eq!(own.scene.name, "two_stages", "without a name it is called as its file");
        own.scene.name.clone_from(&other.scene.name);
    }
    assert_eq!(one, apart);
}

/// What is wrong with a pair that stands in a gearbox file is told at its line there.
#[test]
fn what_is_wrong_with_a_pair_is_told_at_its_line() {
    let file = folder().join("two_stages.toml");
    let good = in_one_file();
    for (old, new, said) in [
        ("teeth = 17", "teeth = 1", "allowed is 5 .. 2000"),
        ("teeth = 17", "teeth = \"17\"", "must be a whole number"),
        ("helix_angle_deg = 15.0", "helix_angel_deg = 15.0", "unknown key `helix_angel_deg`"),
        ("teeth = 17\nhelix_angle_deg = 15.0", "helix_angle_deg = 15.0", "teeth"),
    ] {
        assert!(good.contains(old), "no {old}");
        let wrong = good.replacen(old, new, 1);
        let complaint = Gearbox::parse(&wrong, &file).unwrap_err().to_string();
        assert!(complaint.contains(said), "{new}: {complaint}");
        let line = 1 + wrong[..wrong.find(new).unwrap()].matches('\n').count();
        let place = format!("two_stages.toml:{line}");
        assert!(complaint.contains(&place) || said == "teeth", "{new}: no {place} in {complaint}");
    }
    let neither = text("two_stages.toml").replacen("scene = \"first_stage.toml\"", "scene = 3", 1);
    let complaint = Gearbox::parse(&neither, &file).unwrap_err().to_string();
    assert!(complaint.contains("must be a path in quotes, or the tables of a document"), "{complaint}");
}

/// The scene of a case may stand in the study.
#[test]
fn a_case_of_a_study_may_stand_in_its_file() {
    let file = folder().join("study.toml");
    let rest = "[[quantity]]\ncolumn = \"ste_um\"\n";
    let case = |scene: &str| format!("[[case]]\nlabel = \"a\"\nvalue = 1.0\n{scene}{rest}");
    let columns = &|_: &scene::Scene| Some(vec!["ste_um".to_owned()]);
    let apart = Study::parse(&case("scene = \"first_stage.toml\"\n"), &file, &[], columns).unwrap();
    let one = Study::parse(&case(&below("case.scene", &text("first_stage.toml"))), &file, &[], columns).unwrap();
    let mut own = one.cases[0].scene.clone();
    own.file.clone_from(&apart.cases[0].scene.file);
    assert_eq!(own, apart.cases[0].scene);
}

/// What a plan says of values that do not each start alone, with what goes with which start.
#[test]
fn a_plan_says_how_the_next_value_starts() {
    let file = folder().join("first_stage.toml");
    let of = |vary: &str| Document::new(format!("{}\n[vary]\n{vary}", text("first_stage.toml")), &file);
    let keys = "keys = [\"operation.speed_rpm=1000:2000:3\"]\n";
    let each = of(&format!("{keys}output = [\"peak_to_peak_ste_um\"]\n"));
    assert!(StartedPlan::of(&each, &[]).unwrap().is_none());
    assert_eq!(Plan::of(&each, &[]).unwrap().cases.count(), 3);

    let carry = of(&format!("{keys}start = \"carry\"\nways = [\"down\"]\nonce = \"pinion-turn\"\ncycles = 8\n"));
    let plan = StartedPlan::of(&carry, &[]).unwrap().unwrap();
    assert_eq!((plan.start, plan.cycles, plan.settle), (Start::Carry, Some(8), None));
    assert_eq!(plan.keys, ["operation.speed_rpm=1000:2000:3"]);
    assert_eq!(plan.ways.iter().map(|way| way.word()).collect::<Vec<_>>(), ["down"]);
    let refused = Plan::of(&carry, &[]).unwrap_err().to_string();
    assert!(refused.contains("start = \"carry\""), "{refused}");

    for (vary, said) in [
        ("start = \"carry\"\noutput = [\"x\"]\n", "`output` does not go with `start = \"carry\"`"),
        ("start = \"branch\"\ncycles = 8\n", "`cycles` does not go with `start = \"branch\"`"),
        ("ways = [\"up\"]\n", "`ways` does not go with `start = \"each\"`"),
        ("start = \"cary\"\n", "start"),
        ("start = \"carry\"\ncycles = 0\n", "allowed is 1 .. 100000"),
        ("start = \"carry\"\nonce = \"turn\"\n", "once"),
    ] {
        let complaint = StartedPlan::of(&of(&format!("{keys}{vary}")), &[]).unwrap_err().to_string();
        assert!(complaint.contains(said), "{vary}: {complaint}");
    }
}
