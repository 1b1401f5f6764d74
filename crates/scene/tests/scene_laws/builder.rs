//! A scene made in code is the scene that a text of the same keys makes.

use std::path::{Path, PathBuf};

use scene::{MesherScene, ModesScene, MotionScene, Place, Scene, SceneBuilder, SceneError, Value};

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().to_owned()
}

/// Every scene file below `folder`.
fn scene_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(scene_files(&path));
        } else if path.extension().is_some_and(|e| e == "toml")
            && std::fs::read_to_string(&path).unwrap().contains("[pinion]")
        {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The keys of a text one by one, each with all its tables before it.
fn set_all(mut builder: SceneBuilder, before: &str, value: &Value) -> SceneBuilder {
    match value {
        Value::Table(table) => {
            for (key, value) in table {
                let key = if before.is_empty() { key.clone() } else { format!("{before}.{key}") };
                builder = set_all(builder, &key, value);
            }
            builder
        }
        value => builder.set(before, value.clone()),
    }
}

/// All scenes that are shipped: at rest and in time, of every model. Code and text give the same scene but for the
/// file's name.
#[test]
fn code_and_text_give_the_same_scene() {
    let (mut seen, mut models) = (0, Vec::new());
    for file in scene_files(&repository().join("scenes")) {
        let of_text = Scene::read(&file).unwrap_or_else(|e| panic!("{e}"));
        let values: Value = toml::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
        let builder = set_all(Scene::builder(), "", &values).relative_to(file.parent().unwrap());
        let of_code = builder.set("name", of_text.name.as_str()).build().unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(of_code.to_toml(), of_text.to_toml(), "{}", file.display());
        assert_eq!(Scene { file, ..of_code }, of_text);
        seen += 1;
        models.push(of_text.analysis.model);
    }
    assert!(seen >= 10, "only {seen} scenes");
    for model in ["Iso", "Reduced", "Lumped8", "Lumped12", "Shaft18", "Impact"] {
        assert!(models.iter().any(|m| format!("{m:?}") == model), "no scene of the model {model}");
    }
}

/// The six keys without a default have methods; what is not set is named.
#[test]
fn the_keys_without_a_default_are_named_when_they_are_missing() {
    let least = Scene::builder().pinion(30, 20.0).wheel(30).normal_module_mm(3.0).face_width_mm(20.0);
    let error = least.build().unwrap_err();
    assert!(matches!(&error, SceneError::Missing { keys, .. } if keys == &["`[operation] torque_nm`"]), "{error}");
    let scene = least.torque_nm(150.0).build().unwrap();
    let text = "[pinion]\nteeth = 30\nhelix_angle_deg = 20\n[wheel]\nteeth = 30\n[pair]\nnormal_module_mm = 3\n\
                face_width_mm = 20\n[operation]\ntorque_nm = 150\n";
    assert_eq!(scene, Scene::parse(text, Path::new("scene")).unwrap());
    let all = Scene::builder().build().unwrap_err().to_string();
    for key in ["[pinion] teeth", "helix_angle_deg", "[wheel] teeth", "normal_module_mm", "face_width_mm", "torque_nm"]
    {
        assert!(all.contains(key), "{key}: {all}");
    }
}

/// The errors are those of a file, with the key where a file has its line.
#[test]
fn errors_name_the_key() {
    let with = |key: &str, value: Value| {
        let scene =
            Scene::builder().pinion(30, 20.0).wheel(30).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(1.0);
        scene.set(key, value).build().expect_err(key)
    };
    let error = with("pair.normal_pressure_angle_deg", 50.0.into());
    assert!(
        matches!(&error, SceneError::OutOfRange { place: Place::Setting { label }, key, value, .. }
            if label.as_ref() == "pair.normal_pressure_angle_deg" && key == "normal_pressure_angle_deg" && value == "50"),
        "{error:?}"
    );
    let wrong_type = with("pinion.teeth", "many".into());
    assert!(
        matches!(&wrong_type, SceneError::WrongType { expected, .. } if **expected == *"a whole number"),
        "{wrong_type}"
    );
    assert!(matches!(with("operation.torque", 1.0.into()), SceneError::UnknownKey { .. }));
    assert!(matches!(with("modes.count", 3.into()), SceneError::Conflict { .. }));
    assert!(matches!(with("a b", 1.into()), SceneError::NoKey { .. }));
    let both = with("pinion.modification.tip_relief_um", 10.0.into());
    assert_eq!(both.to_string(), "pinion.modification.tip_relief_um: `tip_relief_um` has no start");
}

/// Places of keys are known for complaints that come later.
#[test]
fn a_complaint_of_the_geometry_names_the_key() {
    let scene = Scene::builder().pinion(30, 20.0).wheel(30).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(1.0);
    let scene = scene.set("pair.centre_distance_mm", 80.0).build().unwrap();
    let error = scene.gear_pair().unwrap_err();
    assert!(matches!(error, SceneError::Geometry { .. }), "{error:?}");
    assert!(error.to_string().starts_with("pair.centre_distance_mm: [pair]: "), "{error}");
}

/// Tables of a scene that says nothing of them are the tables' defaults, without the keys that the energy method, a
/// massless boundary and the width of the gear decide.
#[test]
fn tables_that_are_not_written_are_their_defaults() {
    let base = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(300.0);
    let scene = base.set("analysis.kind", "dynamic").set("analysis.model", "reduced+modes").build().unwrap();
    assert_eq!(scene.motion, Some(MotionScene { spectral_radius: None, ..MotionScene::default() }));
    assert_eq!(scene.modes, Some(ModesScene { fixed_modes: None, ..ModesScene::default() }));
    let mesher = scene.pinion.mesher.unwrap();
    assert_eq!(mesher, MesherScene { elements_face: mesher.elements_face, ..MesherScene::default() });
}
