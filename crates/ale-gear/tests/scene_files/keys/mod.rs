//! The scene file's keys: schema, page and program agree, and none is read and ignored.

mod effect;
mod fits;
mod rows;

use std::collections::BTreeSet;

use crate::util::{repository, scenes};
use ale_gear::scene::{Document, DocumentKind, all_keys, gearbox::Gearbox, json_schema};
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
    wrong("teeth = 30", "teeth = 3", "minimum");
    wrong("teeth = 30", "teeth = 30.5", "integer");
    wrong("torque_nm = 150.0", "torque_nm = \"150\"", "number");
    wrong("model = \"iso\"", "model = \"isu\"", "enum");
    wrong("torque_nm = 150.0", "", "torque_nm");
}

/// Words in backticks that look like keys.
fn keys_on(page: &str) -> BTreeSet<String> {
    let code = page.split('`').skip(1).step_by(2);
    let is_key = |w: &&str| {
        !w.is_empty() && w.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_' || c == '.')
    };
    code.filter(is_key).map(|w| w.rsplit('.').next().unwrap_or(w).to_owned()).collect()
}

/// Every key of the schema is on `docs/scene.md`, and every key in the first column of its tables is in the schema.
#[test]
fn the_page_and_the_schema_list_the_same_keys() {
    let page = std::fs::read_to_string(repository().join("docs/scene.md")).unwrap();
    let named = keys_on(&page);
    let known: BTreeSet<String> = all_keys().iter().map(|k| k.rsplit('.').next().unwrap_or(k).to_owned()).collect();
    let missing: Vec<_> = known.iter().filter(|key| !named.contains(*key)).collect();
    assert!(missing.is_empty(), "not on docs/scene.md: {missing:?}");
    let mut wrong = Vec::new();
    let mut in_scene = true;
    for line in page.lines() {
        // Sections about other files and about command lines have tables of their own.
        if line.starts_with("# The ") {
            in_scene = line.contains("scene file");
        }
        if let Some(title) = line.strip_prefix("## ") {
            in_scene = title.starts_with("`[") || title.starts_with("Motion") || title.starts_with("Cheaper");
        }
        let Some(first) = line.strip_prefix("| ").and_then(|rest| rest.split('|').next()).filter(|_| in_scene) else {
            continue;
        };
        wrong.extend(keys_on(first).into_iter().filter(|key| !known.contains(key)));
    }
    // Models are listed in a table of what they take.
    wrong.retain(|w| !["mapped", "lumped8", "lumped12", "shaft18", "impact"].contains(&w.as_str()));
    assert!(wrong.is_empty(), "on docs/scene.md, but no keys: {wrong:?}");
}
