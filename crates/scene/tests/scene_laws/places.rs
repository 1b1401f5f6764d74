//! Where keys stand is known from the reading on: nothing later reads a scene's text.

use std::{fs, path::Path};

use scene::{Document, Scene, Setting};

const TEXT: &str = "# a remark that no key has\n[pinion]\nteeth = 21\nhelix_angle_deg = 0.0\n[pinion.modification]\n\
                    lead_crowning_um = 5.0\n[wheel]\nteeth = 32\n[pair]\nnormal_module_mm = 3.0\n\
                    face_width_mm = 30.0\n[operation]\ntorque_nm = 100.0 # at full load\n";

fn set(words: &[&str]) -> Vec<Setting> {
    words.iter().map(|word| Setting::parse(word).unwrap()).collect()
}

/// A scene whose file is gone still shows its lines, and holds nothing of the text but lines with keys.
#[test]
fn a_scene_holds_places_and_no_text() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.toml");
    fs::write(&file, TEXT).unwrap();
    let scene = Scene::read(&file).unwrap();
    fs::remove_file(&file).unwrap();
    let place = scene.place_of(&["motion.cycles", "operation.torque_nm", "pair"]).unwrap();
    assert_eq!(place.to_string(), format!("{}:13", file.display()));
    assert_eq!(place.excerpt().unwrap(), "  13 | torque_nm = 100.0 # at full load\n     |             ^^^^^");
    assert_eq!(scene.place_of(&["pinion.modification"]).unwrap().to_string(), format!("{}:5", file.display()));
    assert_eq!(scene.place_of(&["pinion.bore_diameter_mm", "motion"]), None);
    let all = format!("{scene:?}");
    assert!(all.contains("at full load") && !all.contains("a remark that no key has"), "{all}");
}

/// A setting is the place of its key, of what it says below it, and of tables that it makes; the last one holds.
#[test]
fn what_is_set_beside_the_file_has_its_own_place() {
    let document = Document::new(TEXT.to_owned(), Path::new("a.toml"));
    let words = [
        "operation.torque_nm=1",
        "pinion.modification={ tip_relief_um = 9.0, tip_relief_start_roll_deg = 25 }",
        "contact.slices=20",
        "operation.torque_nm=2",
    ];
    let settings: Vec<Setting> = set(&words).into_iter().zip(["A", "B", "C", "D"]).map(|(s, l)| s.called(l)).collect();
    let scene = document.scene(&settings).unwrap();
    let place = |key: &str| scene.place_of(&[key]).map(|place| place.to_string());
    for (key, wanted) in [
        ("operation.torque_nm", Some("D")),
        ("operation", Some("a.toml:12")),
        ("pinion", Some("a.toml:2")),
        ("pinion.modification", Some("B")),
        ("pinion.modification.tip_relief_um", Some("B")),
        ("pinion.modification.lead_crowning_um", None),
        ("contact", Some("C")),
        ("contact.slices", Some("C")),
        ("wheel.teeth", Some("a.toml:8")),
    ] {
        assert_eq!(place(key).as_deref(), wanted, "{key}");
    }
    assert_eq!(document.scene(&[]).unwrap().place_of(&["operation.torque_nm"]).unwrap().to_string(), "a.toml:13");
}

/// A document with values set is the scene that a text with these values makes; complaints name value, place and range.
#[test]
fn values_are_set_on_the_document_that_was_read() {
    let document = Document::new(TEXT.to_owned(), Path::new("a.toml"));
    for torque in [1.0, 250.0, 0.1 + 0.2] {
        let of_text = Scene::parse(&TEXT.replace("100.0", &torque.to_string()), Path::new("a.toml")).unwrap();
        let of_document = document.scene(&[Setting::number("operation.torque_nm", torque).unwrap()]).unwrap();
        assert_eq!(Scene { set: Vec::new(), ..of_document }, of_text);
    }
    for (word, said) in [
        ("operation.torque_nm=-1", "--set operation.torque_nm: `torque_nm` is -1, allowed is 0 .. 1000000000"),
        ("pinion.teeth=many", "--set pinion.teeth: `pinion.teeth` must be a whole number, found string \"many\""),
        ("pinion={teeth=\"x\"}", "--set pinion: `teeth` must be a whole number, found string \"x\""),
        ("pinion.teeth.x=3", "--set pinion.teeth.x: `pinion.teeth.x` must be a whole number, found a table or a date"),
        ("pair.torque=3", "--set pair.torque: unknown key `torque`"),
        ("operation=3", "--set operation: `operation` must be a table, found integer 3"),
    ] {
        assert_eq!(document.scene(&set(&[word])).unwrap_err().to_string(), said, "{word}");
    }
}
