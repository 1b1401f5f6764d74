//! The JSON Schema of scenes in another's validator.

use std::process::Command;

use ale_gear::scene::json_schema;

use super::util::{Scratch, repository, scenes};

/// It finds every shipped scene valid, and the schema one of the draft that it names.
pub fn validator(_: ()) {
    let scratch = Scratch::new().file("schema.json", json_schema().to_string());
    let is_scene = |text: String| text.contains("[pinion]");
    let files: Vec<_> = scenes().into_iter().filter(|path| std::fs::read_to_string(path).is_ok_and(is_scene)).collect();
    let script = repository().join("tests/scripts/scene_schema.py");
    let run =
        Command::new("python3").arg(script).arg(scratch.path().join("schema.json")).args(&files).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    assert_eq!(String::from_utf8_lossy(&run.stdout).trim(), files.len().to_string());
}
