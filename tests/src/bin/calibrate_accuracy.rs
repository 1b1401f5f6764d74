//! Makes the table of bounds from measured pairs, and says how it does on pairs that it has not seen.
//!
//! `cargo run --release -p verification --bin calibrate_accuracy -- OUT.json FILE...`, the files of `measure_accuracy`.
//! Every fifth pair is kept back for the check.
#![allow(clippy::print_stdout, reason = "the figures are what it is for")]

use std::{error::Error, fs};

use analysis::accuracy::{Calibration, Law, MeshLaw, PositionsLaw, Quantity, QuantityLaws, Rung};
use serde_json::Value;
use verification::measured_pair::MeasuredPair;

/// Share of the pairs that a bound holds for.
const COVERAGE: f64 = 0.95;
/// Every so manieth pair is kept back.
const KEPT_BACK: usize = 5;

/// Pairs that a law is made of, at least.
const LEAST_PAIRS: usize = 10;

/// What was seen of a pair, what the error was, and what both are measured against.
#[derive(Debug, Clone, Copy)]
struct Case {
    difference: f64,
    error: f64,
    scale: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [out, files @ ..] = &words[..] else { return Err("OUT.json FILE... are wanted".into()) };
    let mut lines: Vec<Value> = Vec::new();
    for file in files {
        for line in fs::read_to_string(file)?.lines() {
            lines.push(serde_json::from_str(line)?);
        }
    }
    let all = lines.len();
    let pairs: Vec<MeasuredPair> = lines.into_iter().filter_map(MeasuredPair::new).collect();
    println!("{} pairs, {} without a result", pairs.len(), all - pairs.len());
    let laws = |&q: &Quantity| QuantityLaws {
        quantity: q.key().to_owned(),
        mesh: Rung::ALL.into_iter().filter_map(|rung| mesh_law(&pairs, q, rung)).collect(),
        slices: fit(&format!("{} slices", q.key()), &cases(&pairs, q, slices), &pulls()),
        positions: [8, 16, 32, 64]
            .map(|p| {
                let cases = cases(&pairs, q, |pair, q| positions(pair, q, p));
                let law = fit(&format!("{} {p} positions", q.key()), &cases, &pulls());
                PositionsLaw { positions: p, law, usual: usual(law, &cases) }
            })
            .to_vec(),
    };
    let at_rest = Quantity::ALL.iter().filter(|q| !q.is_of_motion());
    let quantities = at_rest.map(laws).collect();
    let table = Calibration { pairs: pairs.len(), coverage: COVERAGE, quantities };
    fs::write(out, serde_json::to_string_pretty(&table)? + "\n")?;
    Ok(())
}

fn cases(pairs: &[MeasuredPair], q: Quantity, of: impl Fn(&MeasuredPair, Quantity) -> Option<[f64; 2]>) -> Vec<Case> {
    let case = |pair: &MeasuredPair| {
        let [difference, error] = of(pair, q)?;
        Some(Case { difference, error, scale: pair.scale(q)? })
    };
    pairs.iter().filter_map(case).collect()
}

fn mesh_law(pairs: &[MeasuredPair], q: Quantity, rung: Rung) -> Option<MeshLaw> {
    let n = rung.elements_profile;
    let own = format!("mesh {n}");
    let alone = || {
        let of = |pair: &MeasuredPair, q: Quantity| {
            let scale = pair.scale(q)?;
            Some([scale, pair.settled(q)? - pair.value(&own, q)?])
        };
        let cases = cases(pairs, q, of);
        (cases.len() > LEAST_PAIRS).then(|| fit(&format!("{} {own} alone", q.key()), &cases, &shares()))
    };
    let from = |name: &str, other: String| {
        let of = |pair: &MeasuredPair, q: Quantity| {
            let sparse = pair.value(&format!("{own} sparse"), q)?;
            Some([sparse - pair.value(&other, q)?, pair.settled(q)? - pair.value(&own, q)?])
        };
        let cases = cases(pairs, q, of);
        (cases.len() > LEAST_PAIRS).then(|| {
            let law = fit(&format!("{} {own} {name}", q.key()), &cases, &pulls());
            (law, usual(law, &cases))
        })
    };
    let alone = alone()?;
    let by_order = from("by order", format!("linear {n} sparse"));
    let by_size = rung.coarser().and_then(|c| from("by size", format!("mesh {} sparse", c.elements_profile)));
    Some(MeshLaw {
        elements_profile: n,
        by_order: by_order.map(|(law, _)| law),
        by_size: by_size.map(|(law, _)| law),
        alone,
        usual: by_order.or(by_size)?.1,
    })
}

/// What known part and bound together come to in three of five cases, over the scale.
fn usual(law: Law, cases: &[Case]) -> f64 {
    let of = |c: &Case| law.of(c.difference, c.scale).iter().map(|x| x.abs()).sum::<f64>() / c.scale;
    let mut all: Vec<f64> = cases.iter().map(of).collect();
    all.sort_unstable_by(f64::total_cmp);
    all.get(all.len() * 3 / 5).copied().unwrap_or(f64::INFINITY)
}

/// From half the slices against four times as many.
fn slices(pair: &MeasuredPair, q: Quantity) -> Option<[f64; 2]> {
    let n = pair.slices()?;
    let of = |n: u64| pair.value(&format!("slices {n} sparse"), q);
    let own = pair.value("mesh 2 sparse", q)?;
    Some([own - of(n / 2)?, of(4 * n)? - own])
}

fn positions(pair: &MeasuredPair, q: Quantity, positions: u32) -> Option<[f64; 2]> {
    let of = |p: u32| pair.value(&format!("positions {p}"), q);
    let all = of(128)?;
    let own = of(positions)?;
    let coarser = if positions == 8 { 0.0 } else { own - of(positions / 2)? };
    Some([coarser, all - own])
}

/// Shares of a difference that are tried as the known part of an error.
fn pulls() -> Vec<f64> {
    (-10..=60).map(|i| 0.05 * f64::from(i)).collect()
}

/// Shares of the scale, where no difference is seen.
fn shares() -> Vec<f64> {
    (-80..=160).map(|i| 0.0005 * f64::from(i)).collect()
}

/// The law with the least bounds, on average of their logarithms, that holds for the share of the pairs.
fn fit(name: &str, cases: &[Case], pulls: &[f64]) -> Law {
    let kept_back = |i: usize| i.is_multiple_of(KEPT_BACK);
    let fitted: Vec<Case> = cases.iter().enumerate().filter(|(i, _)| !kept_back(*i)).map(|(_, c)| *c).collect();
    let checked: Vec<Case> = cases.iter().enumerate().filter(|(i, _)| kept_back(*i)).map(|(_, c)| *c).collect();
    let floors = [1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 2e-3, 5e-3, 1e-2, 3e-2];
    let mut best: Option<(f64, Law)> = None;
    for &pull in pulls {
        for floor in floors {
            let law = Law { pull, floor, factor: 1.0 };
            let factor = conformal(&fitted, law);
            let law = Law { factor, ..law };
            let cost = fitted.iter().map(|c| (law.of(c.difference, c.scale)[1] / c.scale).ln()).sum::<f64>();
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, law));
            }
        }
    }
    let law = best.map_or(Law { pull: 0.0, floor: 1.0, factor: 1.0 }, |(_, law)| law);
    tell(name, law, &fitted, &checked);
    law
}

/// The factor with which the law holds for the share of the cases, one more than there are counted as worst of all.
fn conformal(cases: &[Case], law: Law) -> f64 {
    let mut ratios: Vec<f64> = cases
        .iter()
        .map(|c| {
            let [known, bound] = law.of(c.difference, c.scale);
            if bound > 0.0 { (c.error - known).abs() / bound } else { 0.0 }
        })
        .collect();
    ratios.sort_unstable_by(f64::total_cmp);
    let rank = (COVERAGE * (ratios.len() + 1) as f64).ceil() as usize;
    ratios.get(rank.min(ratios.len()).saturating_sub(1)).copied().unwrap_or(1.0).max(1e-6)
}

fn tell(name: &str, law: Law, fitted: &[Case], checked: &[Case]) {
    let holds = |c: &Case| {
        let [known, bound] = law.of(c.difference, c.scale);
        (c.error - known).abs() <= bound
    };
    let share = |cases: &[Case]| 100.0 * cases.iter().filter(|c| holds(c)).count() as f64 / cases.len().max(1) as f64;
    let median = |mut all: Vec<f64>| {
        all.sort_unstable_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(f64::NAN)
    };
    let raw = median(fitted.iter().map(|c| 100.0 * c.error / c.scale).collect());
    let bound = median(fitted.iter().map(|c| 100.0 * law.of(c.difference, c.scale)[1] / c.scale).collect());
    let sharp = median(
        fitted
            .iter()
            .map(|c| {
                let [known, bound] = law.of(c.difference, c.scale);
                (known.abs() + bound) / c.error.abs().max(1e-12)
            })
            .collect(),
    );
    println!(
        "{name:45} pull {:5.2} floor {:.0e} factor {:7.3}: error {raw:+7.3} %, bound {bound:7.3} %, raw bound over error {sharp:5.1}, \
         holds {:5.1} %, unseen {:5.1} % of {}",
        law.pull,
        law.floor,
        law.factor,
        share(fitted),
        share(checked),
        checked.len()
    );
}
