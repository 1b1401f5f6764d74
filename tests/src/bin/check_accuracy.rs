//! How do bounds and the choice of the cheapest rung do on measured pairs that the calibration has not seen?
//!
//! `cargo run --release -p verification --bin check_accuracy -- TOLERANCE_PERCENT COUNT FILE...`, the files of
//! `measure_accuracy`. Every pair is solved with `model = "auto"` and with the program's default settings.
#![allow(clippy::print_stdout, reason = "the figures are what it is for")]

use std::{collections::BTreeMap, error::Error, fs, time::Instant};

use analysis::{
    StaticAnalysis,
    accuracy::{Quantity, Rung},
};
use scene::{AccuracyScene, Model, Tolerance};
use serde_json::Value;
use verification::{measured_pair::MeasuredPair, random_scene::random_scene};

/// Bounds and errors of a quantity over all pairs.
#[derive(Debug, Default)]
struct Tally {
    pairs: usize,
    within: usize,
    /// Bound over error.
    sharpness: Vec<f64>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [percent, count, files @ ..] = &words[..] else { return Err("TOLERANCE COUNT FILE... are wanted".into()) };
    let (share, count): (f64, usize) = (1e-2 * percent.parse::<f64>()?, count.parse()?);
    let mut pairs = Vec::new();
    for file in files {
        for line in fs::read_to_string(file)?.lines() {
            pairs.extend(MeasuredPair::new(&serde_json::from_str::<Value>(line)?));
        }
    }
    let pairs: Vec<MeasuredPair> = pairs.into_iter().take(count).collect();
    let mut tallies: BTreeMap<&str, Tally> = BTreeMap::new();
    let (mut met, mut kept, mut cheapest, mut costs) = (0, 0, 0, Vec::new());
    for pair in &pairs {
        let mut scene = random_scene(pair.seed, pair.index);
        let start = Instant::now();
        if let Err(e) = StaticAnalysis::new(&scene).solve() {
            println!("pair {}: default settings: {e}", pair.index);
            continue;
        }
        let default_s = start.elapsed().as_secs_f64();
        scene.analysis.model = Model::Auto;
        scene.accuracy = AccuracyScene::new([(Quantity::MeanSte, Tolerance::Relative(share))]);
        let start = Instant::now();
        let solved = match StaticAnalysis::new(&scene).solve() {
            Ok(solved) => solved,
            Err(e) => {
                println!("pair {}: {e}", pair.index);
                continue;
            }
        };
        let cost = start.elapsed().as_secs_f64() / default_s;
        costs.push(cost);
        let Some(accuracy) = &solved.facts.accuracy else { continue };
        for bound in &accuracy.bounds {
            let Some(exact) = pair.exact(bound.quantity) else { continue };
            let error = exact - bound.value;
            let tally = tallies.entry(bound.quantity.key()).or_default();
            tally.pairs += 1;
            tally.within += usize::from(-bound.below <= error && error <= bound.above);
            tally.sharpness.push(bound.largest() / error.abs().max(1e-9 * exact.abs()));
        }
        let mean = accuracy.bounds.iter().find(|b| b.quantity == Quantity::MeanSte);
        let exact = pair.exact(Quantity::MeanSte).unwrap_or(f64::NAN);
        let error = mean.map_or(f64::NAN, |b| b.value / exact - 1.0);
        met += usize::from(accuracy.is_met());
        kept += usize::from(error.abs() <= share);
        let taken = Rung::of(&solved.scene).map_or(0, |r| r.elements_profile);
        let least = pair.cheapest(Quantity::MeanSte, share);
        cheapest += usize::from(least == Some(taken));
        println!(
            "pair {:4}: rung {taken} (least {least:?}), {} positions, {} slices, error {:+.3} %, bound {:.3} %, {:.2} of {default_s:.2} s, tried {}",
            pair.index,
            solved.scene.analysis.positions_per_cycle,
            solved.scene.contact.slices.unwrap_or(0),
            100.0 * error,
            mean.map_or(f64::NAN, |b| 100.0 * b.largest() / b.value),
            cost,
            accuracy.rungs.len(),
        );
    }
    let run = costs.len();
    println!(
        "{percent} %: {run} pairs, said to be kept {met}, kept {kept}, on the cheapest rung {cheapest}, median cost {:.2}",
        median(&mut costs)
    );
    for (key, mut tally) in tallies {
        println!(
            "  {key:24} within {:3} of {:3} ({:.1} %), median bound over error {:.1}",
            tally.within,
            tally.pairs,
            100.0 * tally.within as f64 / tally.pairs as f64,
            median(&mut tally.sharpness)
        );
    }
    Ok(())
}

fn median(all: &mut [f64]) -> f64 {
    all.sort_unstable_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
}
