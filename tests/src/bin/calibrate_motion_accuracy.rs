//! Makes the table of bounds of motions from measured ones.
//!
//! `cargo run --release -p verification --bin calibrate_motion_accuracy -- OUT.json FILE...`, the files of
//! `measure_motion_accuracy`. The check is of other pairs: `check_motion_accuracy`.
#![allow(clippy::print_stdout, reason = "the figures are what it is for")]

use std::{collections::BTreeSet, error::Error, fs};

use analysis::accuracy::{
    Law,
    motion::{MotionCalibration, MotionLaws, MotionModel, SpeedLaw, UsualBound},
};
use scene::Quantity;
use serde_json::Value;
use verification::{
    law_fit::{COVERAGE, Case, fit},
    measured_motion::MeasuredMotion,
};

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [out, files @ ..] = &words[..] else { return Err("OUT.json FILE... are wanted".into()) };
    let mut motions = Vec::new();
    let mut all = 0;
    for file in files {
        for line in fs::read_to_string(file)?.lines() {
            all += 1;
            motions.extend(MeasuredMotion::new(serde_json::from_str::<Value>(line)?));
        }
    }
    let pairs = motions.iter().map(|m| (m.seed, m.index)).collect::<BTreeSet<_>>().len();
    println!("{} motions of {pairs} pairs, {} without a result", motions.len(), all - motions.len());
    let quantities = Quantity::OF_MOTION.map(|q| laws(&motions, q)).to_vec();
    let table = MotionCalibration { motions: motions.len(), pairs, coverage: COVERAGE, quantities };
    fs::write(out, serde_json::to_string_pretty(&table)? + "\n")?;
    Ok(())
}

fn laws(motions: &[MeasuredMotion], q: Quantity) -> MotionLaws {
    let key = q.key();
    let step = fit(&format!("{key} step"), &cases(motions, |m| m.step(q)));
    let elasticity = fit(&format!("{key} elasticity"), &cases(motions, |m| m.elasticity(q)));
    let lumped12: Vec<SpeedLaw> = strata(&MotionCalibration::SPEEDS)
        .map(|[from, to]| {
            let of = |m: &MeasuredMotion| m.lumped12(q).filter(|_| m.speed > from && m.speed <= to);
            let cases = cases(motions, of);
            let law = fit(&format!("{key} lumped12 to {to}"), &cases);
            SpeedLaw { speed_to: to, motions: cases.len(), law }
        })
        .collect();
    let mut usual = Vec::new();
    for model in MotionModel::ALL {
        for [speed_from, speed_to] in strata(&MotionCalibration::SPEEDS) {
            for [elastic_from, elastic_to] in strata(&MotionCalibration::ELASTIC) {
                let inside = |m: &&MeasuredMotion| {
                    m.speed > speed_from
                        && m.speed <= speed_to
                        && m.elastic_ratio > elastic_from
                        && m.elastic_ratio <= elastic_to
                };
                let of_model = lumped12.iter().find(|l| l.speed_to == speed_to).map(|l| l.law);
                let share = |m: &MeasuredMotion| total(m, q, model, step, elasticity, of_model);
                let mut shares: Vec<f64> = motions.iter().filter(inside).filter_map(share).collect();
                shares.sort_unstable_by(f64::total_cmp);
                let Some(&share) = shares.get(shares.len() * 3 / 5) else { continue };
                let model = model.name();
                println!(
                    "{key:18} {model:14} speed <= {speed_to:4}, elastic > {elastic_from}: usual bound {:6.2} % of {}",
                    100.0 * share,
                    shares.len()
                );
                usual.push(UsualBound { model: model.to_owned(), speed_to, elastic_to, motions: shares.len(), share });
            }
        }
    }
    MotionLaws { quantity: key.to_owned(), step, elasticity, lumped12, usual }
}

fn strata(ends: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    ends.iter().scan(0.0, |from, to| Some([std::mem::replace(from, *to), *to]))
}

fn cases(motions: &[MeasuredMotion], of: impl Fn(&MeasuredMotion) -> Option<Case>) -> Vec<Case> {
    motions.iter().filter_map(of).collect()
}

/// What known parts and bounds together come to, over the number itself.
fn total(
    m: &MeasuredMotion,
    q: Quantity,
    model: MotionModel,
    step: Law,
    elasticity: Law,
    lumped12: Option<Law>,
) -> Option<f64> {
    let of =
        |law: Law, case: Case| law.of(case.difference, case.scale).iter().map(|x| x.abs()).sum::<f64>() / case.scale;
    // Where steps were not compared nothing was seen of them.
    let own = m.value("reduced 16", q)?;
    let steps = of(step, m.step(q).unwrap_or(Case { difference: 0.0, error: 0.0, scale: own }));
    Some(match model {
        MotionModel::Lumped12 => steps + of(elasticity, m.elasticity(q)?) + of(lumped12?, m.lumped12(q)?),
        MotionModel::Reduced => steps + of(elasticity, m.elasticity(q)?),
        MotionModel::ReducedModes => steps,
    })
}
