//! The table of motions.

use std::collections::BTreeSet;

use analysis::accuracy::{
    Law,
    motion::{MotionCalibration, MotionLaws, MotionModel, SpeedLaw, UsualBound},
};
use scene::Quantity;
use serde_json::Value;
use verification::{
    law_fit::{COVERAGE, Case, fit, told_fit},
    measured_motion::MeasuredMotion,
};

/// The table of measured motions, one a line.
pub(super) fn table(lines: Vec<Value>) -> MotionCalibration {
    let all = lines.len();
    let motions: Vec<MeasuredMotion> = lines.into_iter().filter_map(MeasuredMotion::new).collect();
    let pairs = motions.iter().map(|m| (m.seed, m.index)).collect::<BTreeSet<_>>().len();
    println!("{} motions of {pairs} pairs, {} without a result", motions.len(), all - motions.len());
    let quantities = Quantity::OF_MOTION.map(|q| laws(&motions, q)).to_vec();
    MotionCalibration { motions: motions.len(), pairs, coverage: COVERAGE, quantities }
}

/// Laws of the causes.
struct Causes {
    step: Law,
    elasticity: Law,
    lumped12: Vec<SpeedLaw>,
}

impl Causes {
    /// `fit`: what makes a law of cases that have a name.
    fn new<'a>(
        motions: impl Iterator<Item = &'a MeasuredMotion> + Clone,
        q: Quantity,
        fit: impl Fn(&str, &[Case]) -> Law,
    ) -> Self {
        let key = q.key();
        let all = |of: &dyn Fn(&MeasuredMotion) -> Option<Case>| motions.clone().filter_map(of).collect::<Vec<_>>();
        let law = |[from, to]: [f64; 2]| {
            let cases = all(&|m| m.lumped12(q).filter(|_| m.speed > from && m.speed <= to));
            let law = fit(&format!("{key} lumped12 to {to}"), &cases);
            SpeedLaw { speed_to: to, motions: cases.len(), law }
        };
        Self {
            step: fit(&format!("{key} step"), &all(&|m| m.step(q))),
            elasticity: fit(&format!("{key} elasticity"), &all(&|m| m.elasticity(q))),
            lumped12: strata(&MotionCalibration::SPEEDS).map(law).collect(),
        }
    }

    /// Known part of the error of a run and the bound of the rest, in the unit of the number, meshes left aside.
    fn of(&self, m: &MeasuredMotion, q: Quantity, model: MotionModel) -> Option<[f64; 2]> {
        let of = |law: Law, case: Case| law.of(case.difference, case.scale);
        // Where steps were not compared nothing was seen of them.
        let own = m.value("reduced 16", q)?;
        let mut all = vec![of(self.step, m.step(q).unwrap_or(Case { difference: 0.0, error: 0.0, scale: own }))];
        if model != MotionModel::ReducedModes {
            all.push(of(self.elasticity, m.elasticity(q)?));
        }
        if model == MotionModel::Lumped12 {
            let law = self.lumped12.iter().find(|l| m.speed <= l.speed_to)?.law;
            all.push(of(law, m.lumped12(q)?));
        }
        Some([0, 1].map(|i| all.iter().map(|x| x[i]).sum()))
    }
}

fn laws(motions: &[MeasuredMotion], q: Quantity) -> MotionLaws {
    let key = q.key();
    let causes = Causes::new(motions.iter(), q, told_fit);
    left_out(motions, q);
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
                let share = |m: &MeasuredMotion| {
                    let [known, bound] = causes.of(m, q, model)?;
                    Some((known.abs() + bound) / m.value("reduced 16", q)?)
                };
                let mut shares: Vec<f64> = motions.iter().filter(inside).filter_map(share).collect();
                shares.sort_unstable_by(f64::total_cmp);
                let Some(&share) = shares.get(shares.len() * 3 / 5) else { continue };
                let (model, count) = (model.name(), shares.len());
                println!(
                    "{key:18} {model:14} speed <= {speed_to:4}, elastic > {elastic_from:3}: usual bound {:6.2} % of {count}",
                    100.0 * share
                );
                usual.push(UsualBound { model: model.to_owned(), speed_to, elastic_to, motions: count, share });
            }
        }
    }
    let Causes { step, elasticity, lumped12 } = causes;
    MotionLaws { quantity: key.to_owned(), step, elasticity, lumped12, usual }
}

/// How bounds do on pairs that their laws have not seen: each pair is left out in turn.
fn left_out(motions: &[MeasuredMotion], q: Quantity) {
    let pairs: BTreeSet<(u64, u64)> = motions.iter().map(|m| (m.seed, m.index)).collect();
    for (model, run) in [(MotionModel::Lumped12, "lumped12 16"), (MotionModel::Reduced, "reduced 16")] {
        let (mut within, mut all, mut sharpness) = (0usize, 0u32, Vec::new());
        for pair in &pairs {
            let others = motions.iter().filter(|m| (m.seed, m.index) != *pair);
            let causes = Causes::new(others, q, |_, cases| fit(cases));
            for m in motions.iter().filter(|m| (m.seed, m.index) == *pair) {
                let (Some([known, bound]), Some(own)) = (causes.of(m, q, model), m.value(run, q)) else { continue };
                let Some(exact) = m.value("reduced+modes 6", q) else { continue };
                all += 1;
                within += usize::from((exact - own - known).abs() <= bound);
                sharpness.push((known.abs() + bound) / (exact - own).abs().max(1e-6 * exact));
            }
        }
        sharpness.sort_unstable_by(f64::total_cmp);
        println!(
            "{:18} {:14} pairs left out: within {within} of {all} ({:.1} %), median bound over error {:.1}",
            q.key(),
            model.name(),
            100.0 * within as f64 / f64::from(all.max(1)),
            sharpness.get(sharpness.len() / 2).copied().unwrap_or(f64::NAN)
        );
    }
}

fn strata(ends: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    ends.iter().scan(0.0, |from, to| Some([std::mem::replace(from, *to), *to]))
}
