//! `NOTICES.txt`: licences of everything that the program carries.

use std::{collections::BTreeMap, fs, process::Command};

use serde_json::Value;

use crate::util::{Scratch, repository};

const AGAIN: &str = "write it again: `cargo fetch && .ci/notices`";

/// Name and version of every package of a lock file.
fn locked(file: &str) -> Vec<String> {
    let lock: toml::Table = fs::read_to_string(repository().join(file)).unwrap().parse().unwrap();
    let packages = lock["package"].as_array().unwrap().iter();
    packages.map(|p| format!("{} {}", p["name"].as_str().unwrap(), p["version"].as_str().unwrap())).collect()
}

/// Packages of others that the program is linked with on this machine, and their licences.
fn linked() -> BTreeMap<String, String> {
    let version = Command::new(env!("CARGO")).args(["-vV"]).output().unwrap().stdout;
    let version = String::from_utf8(version).unwrap();
    let host = version.lines().find_map(|line| line.strip_prefix("host: ")).unwrap().to_owned();
    let words = ["metadata", "--format-version", "1", "--offline", "--locked", "--filter-platform", &host];
    let found = Command::new(env!("CARGO")).args(words).current_dir(repository()).output().unwrap();
    assert!(found.status.success(), "{}", String::from_utf8_lossy(&found.stderr));
    let found: Value = serde_json::from_slice(&found.stdout).unwrap();
    let list = |value: &Value| value.as_array().unwrap().clone();
    let id = |value: &Value| value["id"].as_str().unwrap().to_owned();
    let packages: BTreeMap<String, Value> = list(&found["packages"]).into_iter().map(|p| (id(&p), p)).collect();
    let nodes: BTreeMap<String, Value> = list(&found["resolve"]["nodes"]).into_iter().map(|n| (id(&n), n)).collect();
    let mut open: Vec<String> =
        packages.iter().filter(|(_, p)| p["name"] == "ale-gear").map(|(id, _)| id.clone()).collect();
    let mut all = BTreeMap::new();
    while let Some(at) = open.pop() {
        let package = &packages[&at];
        let licence = package["license"].as_str().unwrap_or("none").to_owned();
        let name = format!("{} {}", package["name"].as_str().unwrap(), package["version"].as_str().unwrap());
        let source = package["source"].as_str().unwrap_or("here");
        if all.insert(format!("{name} {source}"), licence).is_none() {
            for of in list(&nodes[&at]["deps"]) {
                if list(&of["dep_kinds"]).iter().any(|kind| kind["kind"].is_null()) {
                    open.push(of["pkg"].as_str().unwrap().to_owned());
                }
            }
        }
    }
    let ours = |name: &String, _: &mut String| !name.ends_with(" here");
    all.retain(ours);
    all.into_iter().map(|(name, licence)| (name.rsplit_once(' ').unwrap().0.to_owned(), licence)).collect()
}

/// Every package has a line with its licence and a text; no other has.
#[test]
fn everything_that_is_carried_is_named_with_its_licence() {
    let notices = fs::read_to_string(repository().join("NOTICES.txt")).unwrap();
    let (list, texts) = notices.split_once(&"-".repeat(80)).unwrap();
    let linked = linked();
    assert!(linked.len() > 100 && linked.keys().any(|name| name.starts_with("metis-sys ")), "{linked:?}");
    let of: Vec<&str> = texts.lines().filter(|line| line.starts_with("Of ") && line.ends_with(':')).collect();
    for (package, licence) in linked {
        assert!(list.lines().any(|line| line == format!("{package}: {licence}")), "{package}, {licence}: {AGAIN}");
        let named = |line: &&str| line[3..line.len() - 1].split(", ").any(|name| name == package);
        assert!(of.iter().any(named), "no text of {package}: {AGAIN}");
    }
    let known = locked("Cargo.lock");
    let lines = list.lines().filter(|line| !line.ends_with("in the pages of reports"));
    let packages = lines.filter_map(|line| line.split_once(": ")).map(|(name, _)| name);
    for package in packages.filter(|name| name.split(' ').count() == 2) {
        assert!(known.iter().any(|name| name == package), "{package} is no longer used: {AGAIN}");
    }
    for (what, text) in [
        ("METIS", "Copyright 1995-2013, Regents of the University of Minnesota"),
        ("the MPL", "Mozilla Public License Version 2.0"),
        ("Apache-2.0", "END OF TERMS AND CONDITIONS"),
        ("three.js", "three.js authors"),
        ("uPlot", "Leon Sorokin"),
    ] {
        assert!(texts.contains(text), "{what} is not there");
    }
}

/// The program prints it, and the package for Python has it.
#[test]
fn notices_go_with_what_is_handed_on() {
    let notices = fs::read_to_string(repository().join("NOTICES.txt")).unwrap();
    let run = Scratch::new().ale_gear(["print", "licences"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stdout == notices, "other notices than the file");
    let python = fs::read_to_string(repository().join("python/src/ale_gear/NOTICES.txt")).unwrap();
    assert!(python == notices, "python/src/ale_gear/NOTICES.txt: {AGAIN}");
}

/// Who is no longer maintained stands in the document with what keeps it.
#[test]
fn what_nobody_maintains_is_named() {
    let text = fs::read_to_string(repository().join("docs/decisions.md")).unwrap();
    for package in locked("Cargo.lock").iter().filter(|p| p.starts_with("paste ")) {
        assert!(text.contains(&package.replacen("paste ", "`paste` ", 1)), "{package}");
    }
}
