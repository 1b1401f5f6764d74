//! Scenes built so that the estimate should fail: each is caught by its bound, or said not to be covered.
//!
//! The exact values are of `exact_values_are_those_of_the_table`, on a mesh of eight elements along the profile and as
//! fine in every other direction, with four times the slices and positions of the scene:
//! `cargo test --release --workspace --test accuracy_bounds -- --ignored --nocapture exact_values`.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

mod body;
mod scenes;

use analysis::accuracy::{Bound, Rung};

use scene::Model;
use scenes::{Adversary, beyond_ranges, flanks_and_resolution, meshes_and_models};
use verification::judged::{JUDGED, accurate, bound, exact, holds, sharpness};

/// Mesh of the exact values.
const FINE: Rung = Rung::ALL[4];
/// How far a run may be off the table, relative: digits of the table.
const WRITTEN: f64 = 2e-4;

#[test]
fn meshes_and_models_are_caught_or_said_not_to_be_covered() {
    let folder = tempfile::tempdir().unwrap();
    all_are_caught(meshes_and_models(folder.path()));
}

#[test]
fn flanks_and_resolution_are_caught_or_said_not_to_be_covered() {
    let folder = tempfile::tempdir().unwrap();
    all_are_caught(flanks_and_resolution(folder.path()));
}

#[test]
fn what_is_beyond_the_ranges_is_caught_or_said_not_to_be_covered() {
    all_are_caught(beyond_ranges());
}

/// The pairs on the lowest rung of the ladder, which an accuracy of 50 % asks for, are caught as well.
#[test]
fn on_the_lowest_rung_they_are_caught_as_well() {
    let folder = tempfile::tempdir().unwrap();
    let all = [flanks_and_resolution(folder.path()), beyond_ranges()].concat();
    let auto = |adversary: Adversary| {
        let mut scene = adversary.scene;
        scene.analysis.model = Model::Auto;
        Adversary { scene, ..adversary }
    };
    all_are_caught(all.into_iter().step_by(testing::cases(4, 1)).map(auto).collect());
}

/// Mean and peak-to-peak STE lie inside of their bounds, or the result says in words why they need not.
fn all_are_caught(adversaries: Vec<Adversary>) {
    let mut missed = Vec::new();
    for adversary in adversaries {
        let Adversary { name, scene, inside: wanted, said, exact } = &adversary;
        let accuracy = match accurate(scene) {
            Ok((accuracy, _)) => accuracy,
            Err(e) => {
                missed.push(format!("{name}: {e}"));
                continue;
            }
        };
        let told = said.is_none_or(|words| accuracy.not_covered.iter().any(|line| line.contains(words)));
        // Of a body that the ladder has no mesh of, nothing finer is known.
        let all = || JUDGED.iter().zip(exact.iter().flatten()).map(|(q, exact)| (bound(&accuracy, *q), *exact));
        let inside = exact.is_some() && all().all(|(bound, exact)| holds(bound, exact));
        let one = |(bound, exact): (&Bound, f64)| {
            format!("{} (exact {exact:.4}, bound over error {:.1})", bound.words(), sharpness(bound, exact))
        };
        let figures: Vec<String> = all().map(one).collect();
        println!("{name}: {}; inside {inside}, {said:?} {told}", figures.join(", "));
        if !(told && (inside || !wanted)) {
            missed.push(format!("{name}: {}; {:?}", figures.join(", "), accuracy.not_covered));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}

/// The finer runs behind the table.
#[test]
#[ignore = "minutes: the finer runs behind the table"]
fn exact_values_are_those_of_the_table() {
    let folder = tempfile::tempdir().unwrap();
    let mut off = Vec::new();
    let all = [meshes_and_models(folder.path()), flanks_and_resolution(folder.path()), beyond_ranges()].concat();
    for Adversary { name, scene, exact: table, .. } in all {
        let Some(table) = table else { continue };
        let found =
            accurate(&scene).and_then(|(_, solved)| exact(&solved, FINE)).unwrap_or_else(|e| panic!("{name}: {e}"));
        println!("{name}: [{:.4}, {:.4}]", found[0], found[1]);
        let close = |(found, table): (&f64, &f64)| (found - table).abs() <= WRITTEN * found.abs() + 5e-5;
        if !found.iter().zip(&table).all(close) {
            off.push(format!("{name}: [{:.4}, {:.4}]", found[0], found[1]));
        }
    }
    assert!(off.is_empty(), "{}", off.join("\n"));
}
