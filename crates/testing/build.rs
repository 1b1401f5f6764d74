//! Makes the folder of the records beside those of all builds of this profile, and in it the file that the doc examples
//! include, still empty.

use std::path::{Path, PathBuf};

fn main() {
    let own = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets it"));
    let build = own.ancestors().find(|a| a.file_name().is_some_and(|name| name == "build"));
    let folder = build.and_then(Path::parent).unwrap_or(&own).join("left-out");
    std::fs::create_dir_all(&folder).expect("the target folder is written to");
    let examples = folder.join("examples.rs");
    if !examples.exists() {
        std::fs::write(examples, "").expect("the target folder is written to");
    }
    println!("cargo::rustc-env=ALE_GEAR_RECORDS={}", folder.display());
    println!("cargo::rerun-if-changed=build.rs");
}
