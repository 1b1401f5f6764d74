//! The branch of periodic motions of a gearbox over its speed, beside its motions in time.
#![allow(clippy::print_stdout, reason = "the figures are what the tests are for")]

use std::{f64::consts::TAU, ops::ControlFlow, time::Instant};

use gearbox::{
    Disc, GearMesh, GearboxError, Torque,
    motion::{Drive, GearboxBranch, GearboxMechanism, MotionOptions, MotionPlan, PitchErrors, Speed, SpringMesh},
};
use geometry::Sense;
use integrate::{Scheme, Settle, State};
use lumped::Fourier;
use periodic::{BalanceOptions, Bifurcation, BranchPlan, FourierSeries, Loss, PeriodicMotion};

use crate::{
    motion::train,
    pairs::{operation, pair, shaft, single, two_stages},
};

const RPM: f64 = TAU / 60.0;
/// Steps of a cycle in time.
const STEPS: u64 = 160;

/// A pair on stiff shafts in stiff bearings, with pitch errors of its `teeth`. Its stiffness may vary so much that flanks lose
/// contact at resonance.
pub fn one_stage(vary: f64, teeth: [Vec<f64>; 2]) -> GearboxMechanism {
    let gears = pair([23, 31], 12.0);
    let mut structure = single(&gears, 0.3);
    for (i, (name, origin)) in [("in", [0.0; 3]), ("out", structure.shafts[1].origin)].into_iter().enumerate() {
        structure.shafts[i] = shaft(name, origin, 150.0, 60.0);
    }
    for bearing in &mut structure.bearings {
        bearing.stiffness *= 10.0;
    }
    for (i, outer) in [66.0, 90.0].into_iter().enumerate() {
        let d = &structure.discs[i];
        structure.discs[i] = Disc::ring(d.name.clone(), d.shaft, d.position, [outer, 30.0], 20.0, 7.85e-9);
    }
    let operation = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: 1.5e5 }]);
    let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: gears }];
    let drive = Drive::Speed(Speed::Constant(1500.0));
    let asked = MotionOptions { drive, modal_damping: DAMPING, limit: TAU * 6000.0 };
    let stiffness = Fourier { mean: 4e5, cosine: vec![vary], sine: vec![2e4, 1e4] };
    GearboxMechanism::new(structure, meshes, operation, &asked, |_, mesh, meshing| {
        let spring = SpringMesh::new(mesh, meshing, stiffness.clone())?.with_damping(0.5);
        let errors = PitchErrors::new(teeth.clone())?;
        Ok(Box::new(spring.with_coast_flanks(mesh, meshing)?.with_errors(errors)))
    })
    .unwrap()
}

pub const DAMPING: f64 = 0.015;

pub fn plan(from: f64, to: f64) -> BranchPlan {
    let balance = BalanceOptions {
        harmonics: 12,
        most_harmonics: 96,
        tail: 1e-4,
        samples_per_harmonic: 8,
        least_samples: 512,
        tolerance: 1e-9,
    };
    BranchPlan { from, to, balance, longest_step: 0.05, most: 1000 }
}

pub fn branch(mechanism: &mut GearboxMechanism, plan: &BranchPlan) -> GearboxBranch {
    let rest = mechanism.start(DAMPING).unwrap();
    let begin = Instant::now();
    let found = mechanism.branch(&rest, (plan, 1), |_| ControlFlow::Continue(())).unwrap_or_else(|e| panic!("{e}"));
    let (seconds, motions) = (begin.elapsed().as_secs_f64(), found.motions.len());
    println!("{:?} coordinates, {motions} motions, {seconds:.2} s", found.coordinates);
    assert!(found.branch.broken.is_none(), "{:?}", found.branch.broken);
    for [known, all] in &found.with_all_modes {
        assert!((known - all).abs() < 0.02 * all.max(1.0), "multiplier {known}, {all} with all modes");
    }
    found
}

/// Peak to peak of the transmission error of a mesh over the last cycles of a motion that has settled, um; and its last state.
fn settled(mechanism: &mut GearboxMechanism, speed: f64, start: &State, mesh: usize) -> (f64, State) {
    mechanism.set_speed(speed);
    let settle = Some(Settle { tolerance: 1e-5, most: 400 });
    let plan = MotionPlan { settle, shoots: true, ..crate::motion::steps(Scheme::Energy, [2, STEPS]) };
    let mut extent = [f64::INFINITY, f64::NEG_INFINITY];
    let run = mechanism.run(&State { time: 0.0, ..start.clone() }, &plan, |instant| {
        let x = 1e3 * instant.meshes[mesh].transmission_error;
        extent = [extent[0].min(x), extent[1].max(x)];
    });
    let [_, end] = run.unwrap().states;
    (extent[1] - extent[0], State { time: 0.0, ..end })
}

fn peak_to_peak(mechanism: &mut GearboxMechanism, motion: &PeriodicMotion, whole: &FourierSeries, mesh: usize) -> f64 {
    let rows = mechanism.instants((motion.parameter * RPM, motion.period), whole, 512).unwrap();
    let errors = rows.iter().map(|row| 1e3 * row.meshes[mesh].transmission_error);
    let [low, high] = errors.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    high - low
}

/// Flanks lose contact at the resonance, and the branch folds: where it does, a sweep in time jumps, down from above at the one
/// fold and up from below at the other. Between them is a branch that no sweep shows.
#[test]
fn sweeps_in_time_jump_at_the_folds() {
    let mut mechanism = one_stage(1.6e5, [const { Vec::new() }; 2]);
    let found = branch(&mut mechanism, &plan(15_000.0, 13_800.0));
    for (fold, jump) in folds_and_jumps(&mut mechanism, &found) {
        assert!((jump / fold - 1.0).abs() < 2e-3, "fold at {fold:.2} 1/min, jump in time at {jump:.2}");
    }
}

/// The two folds of a branch that bends to lower speeds, and where sweeps in time jump, down along the upper part and up along the
/// lower one in steps of a thousandth, 1/min.
pub fn folds_and_jumps(mechanism: &mut GearboxMechanism, found: &GearboxBranch) -> Vec<(f64, f64)> {
    let folds: Vec<&Bifurcation> = found.branch.bifurcations.iter().filter(|b| b.loss == Loss::Fold).collect();
    let at: Vec<f64> = folds.iter().map(|b| b.motion.parameter).collect();
    assert_eq!(at.len(), 2, "folds at {at:.3?}");
    assert!(at[1] > 1.005 * at[0], "folds at {at:.2?}, the lower one first on the way down");
    let inside = |m: &&PeriodicMotion| m.parameter > at[0] * 1.002 && m.parameter < at[1] * 0.998;
    let unstable = found.branch.motions.iter().filter(inside).filter(|m| !m.floquet.is_stable()).count();
    assert!(unstable > 0, "no unstable motion between the folds");
    let [upper_end, lower_begin] = [folds[0].after, folds[1].after];
    let nearest = |speed: f64, is_upper: bool| {
        let own = |i: &usize| if is_upper { *i <= upper_end } else { *i > lower_begin };
        let off = |i: &usize| (found.branch.motions[*i].parameter - speed).abs();
        (0..found.motions.len()).filter(own).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap()
    };
    let mut jumps = Vec::new();
    for (fold, way, is_upper) in [(at[0], -1.0, true), (at[1], 1.0, false)] {
        let first = nearest(fold * (1.0 - 0.003 * way), is_upper);
        let (motion, whole) = (&found.branch.motions[first], &found.motions[first]);
        let mut state = GearboxMechanism::state_of(whole, motion.period, 0.0);
        let (mut speed, mut before) = (motion.parameter, peak_to_peak(mechanism, motion, whole, 0));
        let jump = (0..24).find_map(|_| {
            let (now, end) = settled(mechanism, speed * RPM, &state, 0);
            println!("{} {speed:.2} 1/min: {now:.3} um", if is_upper { "down" } else { "up" });
            let jumped = (now / before - 1.0).abs() > 0.15;
            let here = speed;
            (state, before) = (end, now);
            speed *= 1.0 + 1e-3 * way;
            jumped.then_some(here * (1.0 - 0.5e-3 * way))
        });
        jumps.push(jump.expect("the sweep never jumps"));
    }
    println!("folds at {at:.2?}, jumps at {jumps:.2?} 1/min");
    at.into_iter().zip(jumps).collect()
}

/// All coordinates come back from what the meshes see: the motion of the branch is the settled one in time, with two meshes whose
/// frequencies are as 2 to 1 as well, in their common period.
#[test]
fn motions_of_the_branch_are_those_in_time() {
    let mut one = one_stage(8e4, [const { Vec::new() }; 2]);
    let mut two = two_to_one();
    for (mechanism, from, to, cycles) in
        [(&mut one, 15_900.0, 15_500.0, vec![1]), (&mut two, 1900.0, 2000.0, vec![2, 1])]
    {
        let found = branch(mechanism, &plan(from, to));
        assert_eq!(found.mesh_cycles, cycles);
        let (motion, whole) = (found.branch.motions.last().unwrap(), found.motions.last().unwrap());
        assert!(motion.floquet.is_stable(), "multiplier of {}", motion.floquet.largest());
        for mesh in 0..cycles.len() {
            let wanted = peak_to_peak(mechanism, motion, whole, mesh);
            // From another motion of the branch, not from itself.
            let start = GearboxMechanism::state_of(&found.motions[0], motion.period, 0.0);
            let (in_time, _) = settled(mechanism, motion.parameter * RPM, &start, mesh);
            println!("mesh {mesh} at {:.1} 1/min: {wanted:.4} um, in time {in_time:.4} um", motion.parameter);
            assert!((in_time / wanted - 1.0).abs() < 4e-3, "{wanted} um on the branch, {in_time} um in time");
        }
    }
}

/// Two stages of 20 to 40 teeth.
fn two_to_one() -> GearboxMechanism {
    let (mut structure, mut meshes) = two_stages();
    for (mesh, helix) in meshes.iter_mut().zip([15.0, -12.0]) {
        mesh.pair = pair([20, 40], helix);
    }
    let [a1, a2] = [0, 1].map(|i| meshes[i].pair.centre_distance());
    structure.shafts[1].origin = [a1, 0.0, 0.0];
    structure.shafts[2].origin = [a1 + a2 * 1.1f64.cos(), a2 * 1.1f64.sin(), 0.0];
    for (i, outer) in [60.0, 120.0, 60.0, 120.0, 80.0, 120.0].into_iter().enumerate() {
        let d = &structure.discs[i];
        structure.discs[i] = Disc::ring(d.name.clone(), d.shaft, d.position, [outer, 30.0], 20.0, 7.85e-9);
    }
    let operation = operation(&structure, 4, Sense::Cw, vec![Torque { disc: 5, torque: 4e5 }]);
    let drive = Drive::Speed(Speed::Constant(200.0));
    let options = MotionOptions { drive, modal_damping: DAMPING, limit: TAU * 4000.0 };
    let stiffness = Fourier { mean: 4e5, cosine: vec![5e4], sine: vec![2e4, 1e4] };
    GearboxMechanism::new(structure, meshes, operation, &options, |_, mesh, meshing| {
        Ok(Box::new(SpringMesh::new(mesh, meshing, stiffness.clone())?.with_damping(1.0)))
    })
    .unwrap()
}

/// A gearbox that a torque drives has no branch over its speed, and one whose meshes come back together after hundreds of cycles has
/// none with these harmonics, be it for teeth that differ: all are told.
#[test]
fn what_has_no_branch_is_refused() {
    let asked = |drive: Drive| {
        let mut mechanism = train(drive, Sense::Ccw, 0.0);
        let rest = mechanism.start(0.01).unwrap();
        mechanism.branch(&rest, (&plan(900.0, 1000.0), 1), |_| ControlFlow::Continue(())).map(|_| ()).unwrap_err()
    };
    let torque = asked(Drive::Torque { start: 100.0, torque: None });
    assert!(matches!(torque, GearboxError::NoBranch { .. }) && torque.hint().is_some(), "{torque}");
    let long = asked(Drive::Speed(Speed::Constant(100.0)));
    assert!(matches!(long, GearboxError::LongPeriod { most: 10, .. }) && long.hint().is_some(), "{long}");
    // Teeth that differ meet again after a turn.
    let mut own_teeth = one_stage(5e4, [(0..23).map(|i| 1e-4 * f64::from(i % 5)).collect(), Vec::new()]);
    let rest = own_teeth.start(DAMPING).unwrap();
    let turn =
        own_teeth.branch(&rest, (&plan(14000.0, 15000.0), 1), |_| ControlFlow::Continue(())).map(|_| ()).unwrap_err();
    assert!(matches!(turn, GearboxError::LongPeriod { period: Some(23), most: 10, per_cycle: 43 }), "{turn}");
}
