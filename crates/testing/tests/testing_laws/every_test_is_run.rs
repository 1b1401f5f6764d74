//! No test is lost: cargo finds every program, and every file of tests is part of one.

use std::collections::BTreeMap;
use std::fs;

use crate::program::{Kind, manifest, packages, programs, read_by_none};

/// A file that no `mod` line names compiles with nothing, and its tests would never be run.
#[test]
fn every_rust_file_is_read_by_a_program() {
    let lost: Vec<String> = packages().iter().flat_map(|p| read_by_none(p)).map(|f| f.display().to_string()).collect();
    assert!(lost.is_empty(), "no `mod` line of a program of its package leads to\n{}", lost.join("\n"));
}

#[test]
fn a_file_without_a_mod_line_is_found() {
    let package = tempfile::tempdir().unwrap();
    let laws = package.path().join("tests/laws");
    fs::create_dir_all(laws.join("keys")).unwrap();
    fs::create_dir_all(laws.join("pair")).unwrap();
    let files = [
        ("main.rs", "//! mod lost;\nmod kept;\n#[path = \"other/name.rs\"]\nmod keys;\npub mod pair;\n"),
        ("kept.rs", "mod inner;\n#[test]\n#[ignore = \"a minute\"]\nfn holds() {}\n"),
        ("lost.rs", "#[test]\nfn is_never_run() {}\n"),
        ("keys/rows.rs", ""),
        ("pair/mod.rs", "mod half;\n"),
        ("pair/half.rs", "#[test]\nfn fits() {}\n"),
    ];
    for (name, text) in files {
        fs::write(laws.join(name), text).unwrap();
    }
    assert_eq!(read_by_none(package.path()), [laws.join("keys/rows.rs"), laws.join("lost.rs")]);
    let [program] = &programs(package.path())[..] else { panic!("one program") };
    assert_eq!((program.kind, &program.name[..]), (Kind::Test, "laws"));
    assert_eq!(program.tests(), ["kept::holds", "pair::half::fits"]);
}

/// `cargo test --workspace --test NAME` runs one program.
#[test]
fn test_programs_have_names_of_their_own() {
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for package in packages() {
        for program in programs(&package).into_iter().filter(|p| p.kind == Kind::Test) {
            places.entry(program.name).or_default().push(package.display().to_string());
        }
    }
    places.retain(|_, places| places.len() > 1);
    assert!(places.is_empty(), "{places:#?}");
}

/// Cargo makes no test program of what a manifest says `test = false` of.
#[test]
fn what_has_no_test_program_has_no_tests() {
    let is_off = |table: &toml::Value| table.get("test").and_then(toml::Value::as_bool) == Some(false);
    for package in packages() {
        let manifest = manifest(&package);
        let library = manifest.get("lib").is_some_and(is_off);
        let binaries = manifest.get("bin").and_then(toml::Value::as_array).cloned().unwrap_or_default();
        let off = |kind: Kind, name: &str| match kind {
            Kind::Library => library,
            Kind::Binary => binaries.iter().any(|b| is_off(b) && b["name"].as_str() == Some(name)),
            _ => false,
        };
        for program in programs(&package).iter().filter(|p| off(p.kind, &p.name)) {
            assert_eq!(program.tests(), [""; 0], "{}: {:?} has `test = false`", package.display(), program.kind);
        }
    }
}
