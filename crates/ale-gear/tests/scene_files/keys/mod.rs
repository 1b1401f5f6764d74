//! The scene file's keys: schema and program agree, and none is read and ignored.

mod effect;
mod fits;
mod rows;

use crate::util::{repository, scenes};
use ale_gear::scene::{gearbox::Gearbox, json_schema};
use fits::fits;

fn as_json(toml: &str) -> serde_json::Value {
    toml::from_str(toml).unwrap_or_else(|e| panic!("{e}\n{toml}"))
}

/// Every scene that is shipped fits the schema, and so does what `init` writes.
#[test]
fn shipped_scenes_fit_the_schema() {
    let schema = json_schema();
    let mut seen = 0;
    for path in scenes() {
        let text = std::fs::read_to_string(&path).unwrap();
        // Studies and plans stand beside scenes; a scene is what has a pinion.
        if !text.contains("[pinion]") {
            continue;
        }
        fits(&schema, &as_json(&text)).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        seen += 1;
    }
    assert!(seen >= 10, "{seen} scenes only");
    let starter = scene::Starter::default().text("a.toml");
    fits(&schema, &as_json(&starter)).unwrap();
}

/// The gearbox files that are shipped: of `scenes/gearbox` those that have meshes.
fn gearboxes() -> Vec<std::path::PathBuf> {
    let all = std::fs::read_dir(repository().join("scenes/gearbox")).unwrap().map(|entry| entry.unwrap().path());
    let is_box = |path: &std::path::PathBuf| {
        path.extension().is_some_and(|e| e == "toml") && std::fs::read_to_string(path).unwrap().contains("[[mesh]]")
    };
    all.filter(is_box).collect()
}

/// Every gearbox file that is shipped fits its schema, which is what the command prints; a scene does not.
#[test]
fn shipped_gearboxes_fit_their_schema() {
    let scratch = crate::util::Scratch::new();
    let printed = scratch.ale_gear(["print", "schema", "gearbox"]);
    assert_eq!(printed.code, Some(0), "{}", printed.stderr);
    let schema: serde_json::Value = serde_json::from_str(&printed.stdout).unwrap();
    assert_eq!(schema, Gearbox::json_schema());
    let all = gearboxes();
    assert!(all.len() >= 6, "{} gearboxes only", all.len());
    for path in all {
        let text = std::fs::read_to_string(&path).unwrap();
        fits(&schema, &as_json(&text)).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    }
    fits(&schema, &as_json(crate::util::ISO_SCENE)).unwrap_err();
    let scene = scratch.ale_gear(["print", "schema"]);
    assert_eq!(serde_json::from_str::<serde_json::Value>(&scene.stdout).unwrap(), json_schema());
}

/// What the reader refuses of a gearbox file does not fit its schema either: unknown keys of every table, wrong types,
/// values out of range, words that are none, missing keys.
#[test]
fn wrong_gearboxes_do_not_fit_their_schema() {
    let schema = Gearbox::json_schema();
    let file = repository().join("scenes/gearbox/two_stages.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    for (old, new, said) in [
        ("young_mpa", "yuong_mpa", "yuong_mpa"),
        ("outer_diameter_mm = 25.0", "outer_diameter_mm = 0.0", "minimum"),
        ("speeds = 57", "speeds = 57.5", "integer"),
        ("speeds = 57", "speeds = 5700", "maximum"),
        ("from_rpm = 400.0", "from_rpm = \"400\"", "number"),
        ("mesh = \"spring\"", "mesh = \"sprung\"", "enum"),
        ("input = \"free\"", "input = \"loose\"", "enum"),
        ("rotation = \"cw\"", "rotation = \"left\"", "enum"),
        ("torque_nm = 740.0\n", "", "torque_nm"),
        ("[analysis]", "[analyses]", "analyses"),
        ("steps_per_cycle = 40", "steps_a_cycle = 40", "steps_a_cycle"),
    ] {
        assert!(text.contains(old), "no `{old}`");
        let wrong = text.replacen(old, new, 1);
        let error = fits(&schema, &as_json(&wrong)).expect_err(new);
        assert!(error.contains(said), "{new}: {error}");
        assert!(Gearbox::parse(&wrong, &file).is_err(), "{new} is read");
    }
}

/// What the program refuses does not fit: unknown keys, wrong types, values out of range, words that are none, missing
/// keys.
#[test]
fn wrong_scenes_do_not_fit_the_schema() {
    let schema = json_schema();
    let wrong = |old: &str, new: &str, said: &str| {
        assert!(crate::util::ISO_SCENE.contains(old), "no `{old}`");
        let error = fits(&schema, &as_json(&crate::util::ISO_SCENE.replacen(old, new, 1))).expect_err(new);
        assert!(error.contains(said), "{new}: {error}");
    };
    wrong("face_width_mm", "face_widht_mm", "face_widht_mm");
    wrong("teeth = 30", "teeth = 3", "minimum");
    wrong("teeth = 30", "teeth = 30.5", "integer");
    wrong("torque_nm = 150.0", "torque_nm = \"150\"", "number");
    wrong("model = \"iso\"", "model = \"isu\"", "enum");
    wrong("torque_nm = 150.0", "", "torque_nm");
}
