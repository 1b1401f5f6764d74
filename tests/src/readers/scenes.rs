//! What users write: scenes, words of `--set`, studies, and pairs out of other programs.

use std::path::{Path, PathBuf};

use scene::{Scene, SceneError, Setting, Starter, gearbox::Gearbox, read_gearbox, read_pair, read_shaft, study::Study};

/// A scene that runs as it is, for what is set beside it.
const SMALL: &str = "[pinion]\nteeth = 23\nhelix_angle_deg = 15.0\n[wheel]\nteeth = 41\n\
                     [pair]\nnormal_module_mm = 2.5\nface_width_mm = 18.0\n[operation]\ntorque_nm = 80.0\n";

/// A file that is not there, beside the repository's scenes: what an input names is looked for from there.
fn beside_scenes(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(name)
}

/// A scene as far as its exact pair, and the scene again that it writes.
pub fn scene(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    go_on(Scene::parse(text, &beside_scenes("fuzz.toml")));
}

/// Words of `--set`, one a line.
pub fn setting(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let Ok(settings) = text.lines().map(Setting::parse).collect::<Result<Vec<_>, _>>() else { return };
    go_on(Scene::parse_with(SMALL, &beside_scenes("fuzz.toml"), &settings));
}

fn go_on(read: Result<Scene, SceneError>) {
    match read {
        Ok(scene) => {
            let _ = scene.gear_pair().map_err(|e| (e.to_string(), e.hint()));
            let _ = Scene::parse(&scene.to_toml(), &scene.file);
        }
        Err(e) => drop((e.to_string(), e.hint())),
    }
}

/// A study, with the scenes of the repository that it names.
pub fn study(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let columns = |scene: &Scene| scene.motion.is_some().then(|| store::checkpoint::motion_column_names(scene));
    match Study::parse(text, &beside_scenes("fuzz_study.toml"), &[], &columns) {
        Ok(study) => (0..study.cases.len()).for_each(|case| drop(study.folder(case))),
        Err(e) => drop((e.to_string(), e.hint())),
    }
}

/// A gearbox file, with the pairs of the repository that it names.
pub fn gearbox(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match Gearbox::parse(text, &beside_scenes("gearbox/fuzz.toml")) {
        Ok(gearbox) => drop(gearbox.meshes.iter().map(|mesh| mesh.scene.gear_pair()).collect::<Vec<_>>()),
        Err(e) => drop((e.to_string(), e.hint())),
    }
}

/// The first pair of a REXS file, the scene of it, the whole gearbox, and the file's only shaft.
pub fn rexs(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Err(e) = read_shaft(text, None) {
        drop((e.to_string(), e.hint()));
    }
    match read_pair(text, 1, 1, &Starter::default()) {
        Ok(pair) => go_on(Scene::parse(&pair.starter.text("fuzz.toml"), &beside_scenes("fuzz.toml"))),
        Err(e) => drop((e.to_string(), e.hint())),
    }
    match read_gearbox(text, "fuzz", 1) {
        Ok(Some(own)) => {
            if let Err(e) = own.check(&beside_scenes("fuzz.toml")) {
                drop((own.blamed(&e).map(|e| (e.to_string(), e.hint())), e.to_string(), e.hint()));
            }
        }
        Ok(None) => {}
        Err(e) => drop((e.to_string(), e.hint())),
    }
}
