//! Ledgers of every model: they close in every step, on the scale of the vibration; what dampers and friction take never
//! comes back; one row of energy stands beside each row of the history.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::path::Path;

use analysis::{
    lumped::LumpedAnalysis,
    motion::{EnergyRow, MotionAnalysis},
};
use scene::{Model, Scene};
use testing::small_scenes;

use crate::scaled;

/// What a motion says of its energy.
struct Told {
    rows: usize,
    energy: Vec<EnergyRow>,
    open_over_vibration: f64,
    held: bool,
}

fn told(name: &str, text: &str) -> Told {
    let scene = Scene::parse(text, Path::new(name)).unwrap_or_else(|e| panic!("{name}: {e}\n{text}"));
    if matches!(scene.analysis.model, Model::Reduced | Model::ReducedModes) {
        let found = MotionAnalysis::new(&scene).solve().unwrap_or_else(|e| panic!("{name}: {e}"));
        Told {
            rows: found.rows.len(),
            energy: found.rows.to_vec().unwrap().iter().map(|r| r.energy).collect(),
            open_over_vibration: found.headline.certificate.energy_open_over_vibration,
            held: analysis::certificate::verdict(&found.facts.certificate, &scene).is_ok(),
        }
    } else {
        let found = LumpedAnalysis::new(&scene).solve().unwrap_or_else(|e| panic!("{name}: {e}"));
        Told {
            rows: found.rows.len(),
            held: analysis::certificate::verdict(found.certificate(), &scene).is_ok(),
            open_over_vibration: found.headline.certificate.energy_open_over_vibration,
            energy: found.energy.to_vec().unwrap(),
        }
    }
}

/// Largest less least of an entry over the rows.
fn range(energy: &[EnergyRow], of: fn(&EnergyRow) -> f64) -> f64 {
    let (low, high) = energy.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
    high - low
}

/// A steady motion far off resonance, whose vibration is light beside the work that goes through the pair.
fn light(model: &str, drive: &str) -> String {
    scaled::text(
        1.0,
        scaled::FLANKS[0],
        &format!(
            "[contact]\nslices = 8\n[analysis]\nkind = \"dynamic\"\nmodel = \"{model}\"\npositions_per_cycle = 4\ncycles = 2\n\
             [drive]\nby = \"{drive}\"\n[motion]\nrun = \"steady\"\nwarm_up_cycles = 60\nsteps_per_mesh_cycle = 16\n"
        ),
    )
}

/// A driver that balances the load does work on the vibration, on a map as on the contact itself.
#[test]
fn a_balancing_driver_is_in_the_ledger_of_every_model() {
    for drive in ["torque", "speed"] {
        let [reduced, mapped] = ["reduced", "mapped"].map(|model| told(model, &light(model, drive)));
        let supplied = [&reduced, &mapped].map(|t| range(&t.energy, |e| e.supplied_mj));
        let residual = range(&mapped.energy, |e| e.residual_mj);
        println!("{drive}: supplied {supplied:?} mJ, residual {residual:.1e} mJ");
        assert!((supplied[1] / supplied[0] - 1.0).abs() < 0.05, "{drive}: {supplied:?} mJ supplied");
        assert!(residual < 1e-6 * supplied[1], "{drive}: {residual:e} mJ open of {} mJ", supplied[1]);
        for (told, most) in [(&reduced, 1e-6), (&mapped, 1e-9)] {
            assert!(told.held && told.open_over_vibration < most, "{drive}: open by {:e}", told.open_over_vibration);
        }
    }
}

/// Motions of all models, with and without friction.
fn motions() -> Vec<(String, String)> {
    let small = small_scenes::scenes().into_iter();
    let kept =
        ["motion_steady", "motion_free", "motion_modes", "motion_mapped", "lumped8", "lumped12", "shaft18", "impact"];
    let mut all: Vec<(String, String)> =
        small.filter(|(name, _)| kept.contains(name)).map(|(name, text)| (name.to_owned(), text)).collect();
    assert_eq!(all.len(), kept.len());
    let with_friction = |name: &str, mu: f64| {
        let (_, text) = small_scenes::scenes().into_iter().find(|(known, _)| *known == name).expect("a known scene");
        (format!("{name} with friction {mu}"), text.replace("slices = 6\n", &format!("slices = 6\nfriction = {mu}\n")))
    };
    all.extend([
        with_friction("motion_steady", 0.3),
        with_friction("motion_free", 0.05),
        with_friction("motion_modes", 0.1),
    ]);
    let impact = all.iter().find(|(name, _)| name == "impact").expect("impact").1.clone();
    let rough = "[impact]\nstatic_friction = 0.1\ndynamic_friction = 0.08\n";
    all.push(("impact with friction".to_owned(), format!("{impact}{rough}")));
    all
}

/// Dampers and friction only take; a ledger closes in every step, and has a row beside each row of the history.
#[test]
fn what_is_dissipated_never_comes_back() {
    let mut missed = Vec::new();
    for (name, text) in motions() {
        let told = told(&name, &text);
        let taken: Vec<f64> = told.energy.iter().map(|e| e.dissipated_mj).collect();
        let falls = taken.windows(2).map(|w| w[0] - w[1]).fold(0.0, f64::max);
        let last = taken.last().copied().unwrap_or(f64::NAN);
        println!(
            "{name}: {} rows, {last:.3e} mJ taken, falls by {falls:.1e} mJ, open by {:.1e} of the vibration",
            told.rows, told.open_over_vibration
        );
        if told.rows != told.energy.len() || told.rows == 0 {
            missed.push(format!("{name}: {} rows, {} of energy", told.rows, told.energy.len()));
        }
        // To round-off of what has been taken.
        if !(last > 0.0 && falls <= 1e-12 * last && taken[0] >= 0.0) {
            missed.push(format!("{name}: {last} mJ taken at the end, falls by {falls:e} mJ"));
        }
        if !told.held {
            missed.push(format!("{name}: open by {:e} of the vibration", told.open_over_vibration));
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}
