//! The scene file's keys: schema and program agree, and none is read and ignored.

mod effect;
mod fits;
mod rows;

use crate::util::{repository, scenes};
use ale_gear::scene::{Document, DocumentKind, gearbox::Gearbox, json_schema};
use fits::fits;

fn as_json(toml: &str) -> serde_json::Value {
    toml::from_str(toml).unwrap_or_else(|e| panic!("{e}\n{toml}"))
}

/// Every document that is shipped fits the one schema, which is what the command prints: pairs, gearboxes, plans,
/// optimisations, studies, and what `init` writes. What it is told for by its keys alone fits none of the others.
#[test]
fn shipped_documents_fit_the_schema() {
    let printed = crate::util::Scratch::new().ale_gear(["print", "schema"]);
    assert_eq!(printed.code, Some(0), "{}", printed.stderr);
    let schema = json_schema();
    assert_eq!(serde_json::from_str::<serde_json::Value>(&printed.stdout).unwrap(), schema);
    let mut seen = std::collections::BTreeMap::<&str, usize>::new();
    for path in scenes() {
        let text = std::fs::read_to_string(&path).unwrap();
        let kind = Document::new(text.clone(), &path).kind().unwrap_or_else(|| panic!("{}", path.display()));
        let name = match kind {
            DocumentKind::Scene => "pair",
            DocumentKind::Gearbox => "gearbox",
            DocumentKind::Plan => "plan",
            DocumentKind::Study => "study",
            DocumentKind::Optimisation => "optimisation",
        };
        let value = as_json(&text);
        fits(&schema, &value).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let others = ["pair", "gearbox", "study"].into_iter().filter(|other| *other != name);
        for other in
            others.filter(|_| matches!(kind, DocumentKind::Scene | DocumentKind::Gearbox | DocumentKind::Study))
        {
            let of_other = fits(&schema["$defs"][other], &value);
            assert!(of_other.is_err(), "{}, {name}, fits {other}", path.display());
        }
        *seen.entry(name).or_default() += 1;
    }
    assert!(seen["pair"] >= 10 && seen["gearbox"] >= 6 && seen["study"] >= 1, "{seen:?}");
    let starter = scene::Starter::default().text("a.toml");
    fits(&schema, &as_json(&starter)).unwrap();
    let plan = "scene = \"a.toml\"\n[vary]\nkeys = [\"a=1\"]\noutput = [\"b\"]\n";
    fits(&schema, &as_json(plan)).unwrap();
    fits(&schema, &as_json(&plan.replace("output", "outputs"))).unwrap_err();
    fits(&schema, &as_json(&format!("{starter}\n[vary]\nkeys = [\"a=1\"]\nstart = \"branch\"\n"))).unwrap();
    let goal = "scene = \"a.toml\"\n[optimise]\ngoal = [\"b\"]\n";
    fits(&schema, &as_json(goal)).unwrap();
    fits(&schema, &as_json(&goal.replace("scene = \"a.toml\"", ""))).unwrap_err();
}

/// What the reader refuses of a gearbox file does not fit its schema either: unknown keys of every table, wrong types,
/// values out of range, words that are none, missing keys.
#[test]
fn wrong_gearboxes_do_not_fit_their_schema() {
    let schema = json_schema();
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
    // Of the ranges of external and internal gears the last one is told.
    wrong("teeth = 30", "teeth = 3", "maximum");
    wrong("teeth = 30", "teeth = 30.5", "integer");
    wrong("torque_nm = 150.0", "torque_nm = \"150\"", "number");
    wrong("model = \"iso\"", "model = \"isu\"", "enum");
    wrong("torque_nm = 150.0", "", "torque_nm");
}
