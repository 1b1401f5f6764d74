//! What was left out is told at the end, by whatever means tests are run.

use std::fs;
use std::path::Path;
use std::process::Command;

use testing::{Record, note, summary};

use crate::program::{Kind, manifest, package_name, packages, programs, repository};

/// Tests, each with the reason why it was left out, or nothing.
fn keep(folder: &Path, source: &str, part: &str, tests: &[(&str, &str)]) {
    let record = |(test, reason): &(&str, &str)| Record {
        test: (*test).to_owned(),
        reason: Some(*reason).filter(|r| !r.is_empty()).map(str::to_owned),
    };
    note(folder, source, part, &tests.iter().map(record).collect::<Vec<_>>()).unwrap();
}

#[test]
fn the_last_line_names_what_was_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let last = || summary(folder).lines().last().unwrap().to_owned();
    let (ccx, chrome) = ("no `ccx` in PATH", "no browser (chrome)");
    assert_eq!(last(), "tests that need programs of others: none has been run yet");
    keep(folder, file!(), "", &[("draws", ""), ("reads", "")]);
    assert_eq!(last(), "tests that need programs of others: all 2 were run");
    // Of the same file and of another one; what a program said the last time is replaced.
    keep(folder, "Cargo.toml", "", &[("balances", ccx), ("weighs", ccx)]);
    keep(folder, file!(), "part", &[("plots", "")]);
    keep(folder, file!(), "", &[("draws", chrome), ("reads", "")]);
    assert_eq!(
        summary(folder),
        "no `ccx` in PATH: left out balances, weighs\nno browser (chrome): left out draws\n\
         tests that need programs of others: 3 of 5 LEFT OUT (no `ccx` in PATH; no browser (chrome))\n"
    );
    // A test program that is no more has nothing to say.
    keep(folder, "crates/testing/tests/gone.rs", "", &[("once", "no time")]);
    assert!(last().contains("3 of 5"), "{}", last());
    // The program that `.ci/run` ends with says the same.
    let said = Command::new(env!("CARGO_BIN_EXE_left_out")).env(testing::FOLDER, folder).output().unwrap();
    assert_eq!((said.status.code(), String::from_utf8(said.stdout).unwrap()), (Some(0), summary(folder)));
    // And so do the examples that rustdoc is to ignore.
    let examples = fs::read_to_string(folder.join("examples.rs")).unwrap();
    assert_eq!(examples.matches("```ignore").count(), 3, "{examples}");
    for named in [
        "pub mod no_ccx_in_path {",
        "pub fn balances()",
        "pub fn weighs()",
        "pub mod no_browser_chrome {",
        "pub fn draws()",
    ] {
        assert!(examples.contains(named), "no `{named}` in\n{examples}");
    }
}

/// Cargo tests the examples in the documentation after all else, package by package in the order of the alphabet; the
/// last one is this package's.
#[test]
fn no_package_has_its_examples_tested_later() {
    let mut names = Vec::new();
    for package in packages() {
        let tested = |table: &toml::Value| table.get("doctest").and_then(toml::Value::as_bool) != Some(false);
        if has_library(&package) && manifest(&package).get("lib").is_none_or(tested) {
            names.push(package_name(&package));
        }
    }
    assert_eq!(names.iter().max().map(String::as_str), Some(env!("CARGO_PKG_NAME")), "{names:?}");
}

fn has_library(package: &Path) -> bool {
    programs(package).iter().any(|p| p.kind == Kind::Library)
}

#[test]
fn the_check_of_a_change_ends_with_it() {
    let script = fs::read_to_string(repository().join(".ci/run")).unwrap();
    let last = script.lines().rev().map(str::trim).find(|l| !l.is_empty() && !l.starts_with('#'));
    assert_eq!(last, Some("cargo run --quiet --profile test --bin left_out"));
}
