//! The JSON Schema of documents in another's validator.

use std::process::Command;

use ale_gear::scene::json_schema;

use super::util::{Scratch, repository, scenes};

/// It finds every shipped document valid, and the schema one of the draft that it names.
pub fn validator(_: ()) {
    let scratch = Scratch::new().file("schema.json", json_schema().to_string());
    let files = scenes();
    assert!(files.len() >= 20, "{} documents only", files.len());
    let script = repository().join("tests/scripts/scene_schema.py");
    let mut command = Command::new("python3");
    let run = command.arg(script).arg(scratch.path().join("schema.json")).args(&files).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    assert_eq!(String::from_utf8_lossy(&run.stdout).trim(), files.len().to_string());
}
