//! Every failure mode has a scene, fails the naive way and passes the robust one.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

mod maps;
mod patch_test;

use envelope::{FailureMode, MODES};

fn examine(mode: &FailureMode) -> Option<String> {
    let examined = mode.examine();
    println!("{} {}: {:.1} s, holds: {}", mode.label(), mode.name, examined.seconds, examined.holds());
    match &examined.figures {
        Err(error) => println!("    {error}"),
        Ok(figures) => figures.iter().for_each(|f| {
            println!("    {} {}: {:?}", if f.holds() { "   " } else { "NOT" }, f.what, f.robust.value);
            if let Some(naive) = &f.naive {
                println!(
                    "        naive ({}): {:?}",
                    if naive.holds() { "fails" } else { "DOES NOT FAIL" },
                    naive.value
                );
            }
        }),
    }
    (!examined.holds()).then(|| format!("{}: {:?}", mode.label(), examined.figures))
}

fn examine_all(chosen: impl Fn(&&FailureMode) -> bool) {
    let missed: Vec<String> = MODES.iter().filter(chosen).filter_map(examine).collect();
    assert!(missed.is_empty(), "{} of {} modes: {}", missed.len(), MODES.len(), missed.join("\n"));
}

/// Those that take seconds.
#[test]
fn quick_modes_are_shown() {
    examine_all(|mode| mode.is_quick());
}

/// All of them; `ENVELOPE_ONLY` names some, as `F7,F12`.
#[test]
#[ignore = "minutes; `ale-gear envelope` looks at all"]
fn every_mode_is_shown() {
    let only = std::env::var("ENVELOPE_ONLY").ok();
    examine_all(|mode| only.as_ref().is_none_or(|o| o.split(',').any(|word| mode.is_named(word))));
}

/// Numbers ascend, every mode has a file of its own, and the text that is built in is the file's.
#[test]
fn modes_are_numbered_and_have_their_scenes() {
    assert!(MODES.windows(2).all(|w| w[0].number < w[1].number), "numbers do not ascend");
    for mode in MODES {
        assert!(mode.file.starts_with(&format!("F{:02}-", mode.number)), "{}: {}", mode.label(), mode.file);
        let path = format!("{}/../../scenes/envelope/{}.toml", env!("CARGO_MANIFEST_DIR"), mode.file);
        let document = scene::Document::read(path.as_ref()).unwrap_or_else(|e| panic!("{}: {e}", mode.label()));
        let name = match document.kind() {
            Some(scene::DocumentKind::Gearbox) => document.gearbox(&[]).map(|own| own.name),
            _ => scene::Scene::read(path.as_ref()).map(|own| own.name),
        };
        let name = name.unwrap_or_else(|e| panic!("{}: {e}", mode.label()));
        assert!(name.starts_with(&format!("F{} ", mode.number)), "{}: named {name}", mode.label());
        assert_eq!(std::fs::read_to_string(&path).unwrap(), mode.scene, "{path}");
    }
    assert_eq!(MODES.len(), 41);
}
