//! Every failure mode has a scene, fails the naive way and passes the robust one.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

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

/// All of them; `ENVELOPE_ONLY` names one.
#[test]
fn every_mode_is_shown() {
    let only = std::env::var("ENVELOPE_ONLY").ok();
    let chosen = |m: &&FailureMode| only.as_ref().is_none_or(|o| o.split(',').any(|o| o == m.label()));
    let missed: Vec<String> = MODES.iter().filter(chosen).filter_map(examine).collect();
    assert!(missed.is_empty(), "{} of {} modes: {}", missed.len(), MODES.len(), missed.join("\n"));
}
