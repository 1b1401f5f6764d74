//! The JSON Schema of scenes in another's validator.

use std::process::Command;

use ale_gear::scene::{gearbox::Gearbox, json_schema};

use super::util::{Scratch, repository, scenes};

/// It finds every shipped scene and gearbox file valid, and the schemas ones of the draft that they name.
pub fn validator(_: ()) {
    for (mark, schema) in [("[pinion]", json_schema()), ("[[mesh]]", Gearbox::json_schema())] {
        let scratch = Scratch::new().file("schema.json", schema.to_string());
        let is_one = |path: &std::path::PathBuf| std::fs::read_to_string(path).is_ok_and(|text| text.contains(mark));
        let files: Vec<_> = scenes().into_iter().filter(is_one).collect();
        assert!(!files.is_empty(), "no file with {mark}");
        let script = repository().join("tests/scripts/scene_schema.py");
        let mut command = Command::new("python3");
        let run = command.arg(script).arg(scratch.path().join("schema.json")).args(&files).output().unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        assert_eq!(String::from_utf8_lossy(&run.stdout).trim(), files.len().to_string());
    }
}
