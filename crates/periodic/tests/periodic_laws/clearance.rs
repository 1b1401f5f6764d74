//! The clearance oscillator of the reference cases: zeta 0.05, F_m 0.1, F_ah 0.05, half-width 1.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{convert::Infallible, ops::ControlFlow};

use nalgebra::dvector;
use periodic::{BalanceOptions, Branch, BranchOptions, Loss, PeriodicMotion, Tracer};

use crate::oscillator::Oscillator;

fn curve() -> (Oscillator, Branch<Infallible>) {
    curve_in_steps(0.03)
}

fn curve_in_steps(longest_step: f64) -> (Oscillator, Branch<Infallible>) {
    let of = Oscillator::new(0.05, 1.0, 0.1, 0.05);
    let mut system = of.clone();
    let mut tracer = Tracer::new(&mut system, BalanceOptions::default(), 1.0).unwrap();
    let options = BranchOptions { range: [0.5, 1.1], first_step: 0.01, longest_step, most: 4000 };
    let branch = tracer.branch(0.5, &of.at_rest(), &options, |_| ControlFlow::Continue(())).unwrap();
    (of, branch)
}

fn peak_to_peak(motion: &PeriodicMotion) -> f64 {
    motion.series.peak_to_peak(&dvector![1.0])
}

/// Two folds. The lower one is that of the reference (0.70804, peak to peak 0.6558). The upper one is where shooting
/// with Runge and Kutta's method ends: multipliers of 0.842 at 0.8284 and 0.967 at 0.82846. (The reference says 0.82631
/// with 0.2576; at 0.8264 shooting finds a motion with 0.2146 and multipliers of 0.68, far from any fold.)
#[test]
fn folds_are_where_they_must_be() {
    let (_, branch) = curve();
    let folds: Vec<[f64; 2]> =
        branch.bifurcations.iter().map(|b| [b.motion.parameter, peak_to_peak(&b.motion)]).collect();
    println!("{folds:.5?}, {} motions, {} Newton steps", branch.motions.len(), branch.iterations);
    assert!(branch.bifurcations.iter().all(|b| b.loss == Loss::Fold));
    for (found, wanted) in folds.iter().zip([[0.82846, 0.2339], [0.70804, 0.6558]]) {
        assert!((found[0] - wanted[0]).abs() < 1e-4, "fold at {}, not {}", found[0], wanted[0]);
        assert!((found[1] / wanted[1] - 1.0).abs() < 5e-3, "peak to peak {}, not {}", found[1], wanted[1]);
    }
    assert_eq!(folds.len(), 2);
    let last = branch.motions.last().unwrap();
    assert_eq!(last.parameter, 1.1, "the branch ends where its range does");
    // Between the folds the branch is unstable, and nowhere else.
    for pair in branch.motions.windows(2) {
        let backwards = pair[1].parameter < pair[0].parameter;
        let inside = pair.iter().all(|m| m.parameter > 0.72 && m.parameter < 0.82);
        assert!(!inside || pair[1].floquet.is_stable() != backwards, "at {}: {:?}", pair[1].parameter, pair[1].floquet);
    }
}

/// A stable motion is what waiting from it shows; from an unstable one waiting leads away.
#[test]
fn waiting_confirms_every_verdict() {
    let (of, branch) = curve();
    for motion in branch.motions.iter().step_by(3) {
        let system = Oscillator { frequency: motion.parameter, ..of.clone() };
        let rate = std::f64::consts::TAU / motion.period;
        let start = [1.001 * motion.series.at(0.0)[0], rate * motion.series.rate(0.0)[0]];
        let waited = system.waited(start, 150);
        let off = (waited / peak_to_peak(motion) - 1.0).abs();
        // Samples of a step do not hit the extremes exactly.
        let stays = off < 1e-3;
        let near = (motion.floquet.largest() - 1.0).abs() < 0.05;
        assert!(
            near || stays == motion.floquet.is_stable(),
            "W {}: {:.6} waited, {:.6} balanced, multiplier {:.4}",
            motion.parameter,
            waited,
            peak_to_peak(motion),
            motion.floquet.largest()
        );
        assert!(!motion.floquet.is_stable() || near || off < 1e-4, "W {}: off by {off:.1e}", motion.parameter);
    }
}

/// At twenty places of the branch, stable or not, amplitudes equal those of shooting within 1e-4, and the largest
/// multipliers within two hundredths: next to a fold they change by that over 6e-5 of the frequency.
#[test]
fn amplitudes_are_those_of_shooting() {
    let (of, branch) = curve();
    let count = branch.motions.len();
    let mut unstable = 0;
    for motion in (0..20).map(|k| &branch.motions[k * (count - 1) / 19]) {
        let system = Oscillator { frequency: motion.parameter, ..of.clone() };
        let rate = std::f64::consts::TAU / motion.period;
        let [amplitude, multiplier] = system.shot([motion.series.at(0.0)[0], rate * motion.series.rate(0.0)[0]]);
        let off = (peak_to_peak(motion) / amplitude - 1.0).abs();
        assert!(off < 1e-4, "W {}: {} by balance, {amplitude} by shooting", motion.parameter, peak_to_peak(motion));
        let verdict = motion.floquet.largest();
        assert!(
            (verdict - multiplier).abs() < 2e-2 * multiplier,
            "W {}: {verdict}, not {multiplier}",
            motion.parameter
        );
        unstable += usize::from(!motion.floquet.is_stable());
    }
    assert!(unstable > 0, "none of them is unstable");
}

/// Fifty motions of the branch, drawn at random: those that are called stable stay when they are disturbed by a
/// thousandth and run in time, those that are called unstable do not.
#[test]
fn fifty_random_verdicts_are_those_of_time() {
    let (of, branch) = curve_in_steps(0.004);
    let mut drawn = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        drawn ^= drawn << 13;
        drawn ^= drawn >> 7;
        drawn ^= drawn << 17;
        drawn as usize % branch.motions.len()
    };
    let (mut stable, mut unstable) = (0, 0);
    while stable + unstable < 50 {
        let motion = &branch.motions[next()];
        // On the edge neither has a verdict within two hundred periods.
        if (motion.floquet.largest() - 1.0).abs() < 0.04 {
            continue;
        }
        let system = Oscillator { frequency: motion.parameter, ..of.clone() };
        let rate = std::f64::consts::TAU / motion.period;
        let start = [1.001 * motion.series.at(0.0)[0], rate * motion.series.rate(0.0)[0]];
        let stays = (system.waited(start, 200) / peak_to_peak(motion) - 1.0).abs() < 1e-3;
        let verdict = motion.floquet.is_stable();
        assert_eq!(stays, verdict, "W {}: multiplier {}", motion.parameter, motion.floquet.largest());
        if verdict { stable += 1 } else { unstable += 1 }
    }
    println!("{} motions, of fifty {stable} stable and {unstable} unstable", branch.motions.len());
    assert!(unstable >= 5, "{unstable} unstable");
}
