//! Keys set beside the file: `--set key=value`.

use std::path::Path;

use crate::util::{ISO_SCENE, Scratch};
use ale_gear::scene::{
    Scene, SceneError, Setting,
    gearbox::{Gearbox, MeshModel},
};

fn with(words: &[&str]) -> Result<Scene, SceneError> {
    let settings = words.iter().map(|w| Setting::parse(w)).collect::<Result<Vec<_>, _>>()?;
    Scene::parse_with(ISO_SCENE, Path::new("a.toml"), &settings)
}

fn said(words: &[&str]) -> String {
    let error = with(words).expect_err("it is taken");
    format!("{error}|{}", error.hint().unwrap_or_default())
}

/// What is set is what a file with that value says: keys that the file has, keys that it has not, tables that it has
/// not, lists and words.
#[test]
fn a_setting_is_as_if_the_file_said_so() {
    let say = |old: &str, new: &str| {
        assert!(ISO_SCENE.contains(old), "no `{old}`");
        Scene::parse(&ISO_SCENE.replacen(old, new, 1), Path::new("a.toml")).unwrap()
    };
    for (word, wanted) in [
        ("operation.torque_nm=200", say("torque_nm = 150.0", "torque_nm = 200")),
        ("operation.speed_rpm = 1.5e3", say("torque_nm", "speed_rpm = 1500.0\ntorque_nm")),
        ("operation.driver=wheel", say("torque_nm", "driver = \"wheel\"\ntorque_nm")),
        ("material.poisson=0.28", say("[analysis]", "[material]\npoisson = 0.28\n[analysis]")),
        ("pinion.material.poisson=0.28", say("[wheel]", "[pinion.material]\npoisson = 0.28\n[wheel]")),
        ("name=again", say("[pinion]", "name = \"again\"\n[pinion]")),
        ("pinion.material={ poisson = 0.28 }", say("[wheel]", "[pinion.material]\npoisson = 0.28\n[wheel]")),
    ] {
        let mut found = with(&[word]).unwrap_or_else(|e| panic!("{word}: {e}"));
        assert_eq!(found.set.len(), 1);
        found.set.clear();
        assert_eq!(found, wanted, "{word}");
    }
    let last = with(&["operation.torque_nm=1", "operation.torque_nm=2"]).unwrap();
    assert_eq!(last.operation.torque_nm, 2.0, "the last one holds");
    let number = Setting::number("pair.face_width_mm", 0.1 + 0.2).unwrap();
    let scene = Scene::parse_with(ISO_SCENE, Path::new("a.toml"), &[number]).unwrap();
    assert_eq!(scene.pair.face_width_mm.to_bits(), (0.1f64 + 0.2).to_bits());
}

/// Entries of lists by their number, and only those that are there.
#[test]
fn entries_of_lists_are_counted_from_0() {
    let text = std::fs::read_to_string(crate::util::repository().join("scenes/seeds/002.toml")).unwrap();
    let read = |word: &str| Scene::parse_with(&text, Path::new("a.toml"), &[Setting::parse(word).unwrap()]);
    let stiff = |scene: &Scene| scene.pinion.shaft.as_ref().unwrap().supports[1].stiffness_x_n_per_mm;
    let scene = read("pinion.shaft.supports.1.stiffness_x_n_per_mm=12345").unwrap();
    assert_eq!(stiff(&scene), 12345.0);
    let beyond = read("pinion.shaft.supports.9.stiffness_x_n_per_mm=1").unwrap_err().to_string();
    assert!(beyond.starts_with("--set pinion.shaft.supports.9.stiffness_x_n_per_mm: "), "{beyond}");
}

/// Settings get the messages of a file, naming the setting in place of file and line; places in the file stay right.
#[test]
fn complaints_name_the_setting() {
    for (word, text) in [
        ("pair.face_widht_mm=3", "--set pair.face_widht_mm: unknown key `face_widht_mm`|did you mean `face_width_mm`?"),
        ("operatoin.torque_nm=3", "--set operatoin.torque_nm: unknown key `operatoin`|did you mean `operation`?"),
        (
            "pinion.teeth=-3",
            "--set pinion.teeth: `teeth` is -3, allowed is 5 .. 2000|`teeth` means: number of teeth, negative of an internal gear (ISO 21771: z = -93)",
        ),
        (
            "pinion.teeth=many",
            "--set pinion.teeth: `pinion.teeth` must be a whole number, found string \"many\"|write numbers without quotes and without a unit: the \
             unit is in the key",
        ),
        (
            "motion.method=leapfrog",
            "--set motion.method: [motion] belongs to an analysis in time|leave it out, or say `kind = \"dynamic\"` in [analysis]",
        ),
        (
            "operation",
            "--set operation: has no `=`|write `--set operation.torque_nm=200`: tables and key with dots between them, then the value",
        ),
        (
            "a b=3",
            "--set a b: unknown key `a b`; a name with blanks or commas stands in quotes, as `bearing.\"fast, loose\".position_mm`, or is given by its number, as `bearing.1.position_mm`|write `--set operation.torque_nm=200`: tables and key with dots between them, then the value",
        ),
    ] {
        assert_eq!(said(&[word]), text);
    }
    // The file's own mistake keeps its line.
    let wrong = ISO_SCENE.replace("face_width_mm = 20.0", "face_width_mm = -1.0");
    let setting = Setting::parse("operation.torque_nm=3").unwrap();
    let error = Scene::parse_with(&wrong, Path::new("a.toml"), &[setting]).unwrap_err();
    assert!(error.to_string().starts_with("a.toml:12: "), "{error}");
}

/// A gearbox file with some keys set otherwise.
fn gearbox_with(words: &[&str]) -> Result<Gearbox, SceneError> {
    let file = crate::util::repository().join("scenes/gearbox/two_stages.toml");
    let settings = words.iter().map(|w| Setting::parse(w)).collect::<Result<Vec<_>, _>>()?;
    Gearbox::parse_with(&std::fs::read_to_string(&file).unwrap(), &file, &settings)
}

/// Every table of a gearbox file is set as one of a scene: entries of lists by their number, keys and tables that the
/// file has or has not, lists, words; and the settings of the pair of a mesh.
#[test]
fn a_gearbox_is_set_as_a_scene_is() {
    let set = |word: &str| gearbox_with(&[word]).unwrap_or_else(|e| panic!("{word}: {e}"));
    assert_eq!(set("shaft.1.young_mpa=2.0e5").shafts[1].young_mpa, 2e5);
    assert_eq!(set("shaft.0.section.0.outer_diameter_mm=26").shafts[0].sections[0].outer, 26.0);
    assert_eq!(set("gear.2.position_mm=141.5").gears[2].position, 141.5);
    assert_eq!(set("bearing.0.stiffness_n_per_mm=[1e5, 2e5, 3e5]").bearings[0].stiffness[1][1], 2e5);
    assert_eq!(set("torque.0.torque_nm=700").torques[0].torque, 7e5);
    assert_eq!(set("name=set beside").name, "set beside");
    assert_eq!(set("vibration.speeds=7").vibration.unwrap().speeds, 7);
    assert_eq!(set("motion.mesh=spring").motion.unwrap().mesh, MeshModel::Spring);
    assert_eq!(set("analysis.cycles=3").cycles, 3);
    let pair = set("mesh.1.set=[\"contact.slices=9\"]");
    assert_eq!(pair.meshes[1].scene.contact.slices, Some(9));
    let all = gearbox_with(&["motion.cycles=3", "motion.cycles=4"]).unwrap();
    assert_eq!((all.motion.unwrap().cycles, all.set.len()), (4, 2), "the last one holds");
}

/// The messages are those of scenes.
#[test]
fn complaints_about_a_gearbox_name_the_setting() {
    for (word, text) in [
        ("gear.0.positoin_mm=3", "--set gear.0.positoin_mm: unknown key `positoin_mm`|did you mean `position_mm`?"),
        ("geer.0.position_mm=3", "--set geer.0.position_mm: unknown key `geer`|did you mean `gear`?"),
        ("gear.0.torque_nm=3", "--set gear.0.torque_nm: unknown key `torque_nm`|`torque_nm` belongs to [[torque]]"),
        (
            "motion.cycles=0",
            "--set motion.cycles: `cycles` is 0, allowed is 1 .. 1000000|`cycles` means: cycles of the fastest mesh",
        ),
        (
            "motion.method=RK4",
            "--set motion.method: `method` is \"RK4\", allowed is \"energy\" or \"generalised-alpha\" or \"newmark\" or \"dormand-prince\" or \"rk4\"|did you mean \"rk4\"?",
        ),
        (
            "motion.mesh=maped",
            "--set motion.mesh: `mesh` is \"maped\", allowed is \"mapped\" or \"spring\" or \"exact\"|did you mean \"mapped\"?",
        ),
        (
            "vibration.speeds=many",
            "--set vibration.speeds: `vibration.speeds` must be a whole number, found string \"many\"|write numbers without quotes and \
             without a unit: the unit is in the key",
        ),
    ] {
        let error = gearbox_with(&[word]).expect_err(word);
        assert_eq!(format!("{error}|{}", error.hint().unwrap_or_default()), text);
    }
    let beyond = gearbox_with(&["gear.9.position_mm=3"]).unwrap_err().to_string();
    assert!(beyond.starts_with("--set gear.9.position_mm: "), "{beyond}");
    // The gear that it names is none.
    let other = gearbox_with(&["mesh.0.pinion=7"]).unwrap_err().to_string();
    assert!(other.starts_with("--set mesh.0.pinion: "), "{other}");
}

/// On the command line, and in the results.
#[test]
fn a_run_says_what_was_set() {
    let scratch = Scratch::new().file("a.toml", ISO_SCENE);
    let run = scratch.ale_gear([
        "run",
        "a.toml",
        "--out",
        "o",
        "--set",
        "operation.torque_nm=200",
        "--set",
        "name=set beside",
    ]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    assert_eq!(summary["inputs"]["operation"]["torque_nm"], 200.0);
    assert_eq!(summary["inputs"]["name"], "set beside");
    let report = scratch.read("o/report.html");
    assert!(report.contains("operation.torque_nm=200"), "the command that makes it again");
    let run = scratch.ale_gear(["run", "a.toml", "--out", "p", "--set", "operation.torque=5"]);
    assert_eq!(run.stderr, "ale-gear: --set operation.torque: unknown key `torque`\nhint: did you mean `torque_nm`?\n");
    assert_eq!(run.code, Some(2));
}
