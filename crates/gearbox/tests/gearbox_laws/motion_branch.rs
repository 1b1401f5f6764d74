//! The branch of periodic motions of a gearbox over its speed, beside its motions in time.
#![allow(clippy::print_stdout, reason = "the figures are what the tests are for")]

use std::{f64::consts::TAU, ops::ControlFlow, time::Instant};

use gearbox::{
    Disc, GearMesh, GearboxError, Torque,
    motion::{Drive, GearboxBranch, GearboxMechanism, MotionOptions, MotionPlan, Speed, SpringMesh},
};
use geometry::Sense;
use integrate::{Forces, Mechanism, Scheme, Settle, State};
use lumped::Fourier;
use nalgebra::{DMatrix, DVector};
use periodic::{
    BalanceOptions, Bifurcation, Branch, BranchPlan, FourierSeries, Loss, PeriodicFamily, PeriodicMotion, Tracer,
};

use crate::{
    motion::train,
    pairs::{operation, pair, shaft, single, two_stages},
};

const RPM: f64 = TAU / 60.0;
/// Steps of a cycle in time.
const STEPS: u64 = 160;

/// A pair on stiff shafts in stiff bearings. Its stiffness varies so much that flanks lose contact at resonance.
fn one_stage(vary: f64) -> GearboxMechanism {
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
        Ok(Box::new(spring.with_coast_flanks(mesh, meshing)?))
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
    let fastest = mechanism.mesh_frequencies().into_iter().fold(0.0, f64::max);
    let plan = MotionPlan {
        scheme: Scheme::Energy,
        step: 1.0 / (fastest * STEPS as f64),
        cycles: 2,
        steps_per_cycle: STEPS,
        steps_per_row: 1,
        tolerance: None,
        stop_at_events: false,
        settle: Some(Settle { tolerance: 1e-5, most: 400 }),
        shoots: true,
    };
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
    let mut mechanism = one_stage(1.6e5);
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
        let first = nearest(fold * (1.0 - 0.006 * way), is_upper);
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
    let mut one = one_stage(8e4);
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

/// All coordinates of a gearbox, as the search for periodic motions takes those of any mechanism.
struct AllCoordinates {
    mechanism: GearboxMechanism,
    scale: DVector<f64>,
}

impl Mechanism for AllCoordinates {
    type Error = GearboxError;

    fn mass(&self) -> &DMatrix<f64> {
        self.mechanism.mass()
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), GearboxError> {
        self.mechanism.forces(t, q, v, out)
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, GearboxError> {
        self.mechanism.potential(t, q)
    }
}

impl PeriodicFamily for AllCoordinates {
    fn set_parameter(&mut self, value: f64) -> Result<(), GearboxError> {
        self.mechanism.set_speed(value * RPM);
        Ok(())
    }

    fn period(&self) -> f64 {
        1.0 / self.mechanism.mesh_frequencies()[0]
    }

    fn scale(&self) -> DVector<f64> {
        self.scale.clone()
    }
}

/// A pair of held shafts is one coordinate: its branch by what the mesh sees is that by its coordinate, around both folds, and so
/// are the multipliers.
#[test]
fn held_shafts_have_the_branch_of_their_coordinate() {
    let make = || {
        let gears = pair([23, 31], 12.0);
        let structure = single(&gears, 0.3);
        let mut operation = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: 1.5e5 }]);
        operation.held = vec![0, 1];
        let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: gears }];
        let drive = Drive::Speed(Speed::Constant(1500.0));
        let options = MotionOptions { drive, modal_damping: 0.0, limit: TAU * 6000.0 };
        let stiffness = Fourier { mean: 4e5, cosine: vec![5e4], sine: vec![2e4] };
        GearboxMechanism::new(structure, meshes, operation, &options, |_, mesh, meshing| {
            let spring = SpringMesh::new(mesh, meshing, stiffness.clone())?.with_damping(0.5);
            Ok(Box::new(spring.with_coast_flanks(mesh, meshing)?))
        })
        .unwrap()
    };
    let mut mechanism = make();
    assert_eq!(mechanism.count(), 1);
    let rest = mechanism.start(0.0).unwrap();
    // Its natural frequency is that of the wheel on the mesh.
    let mut at_rest = Forces::zeros(1);
    at_rest.tangents = true;
    mechanism.forces(0.0, &rest.q, &rest.v, &mut at_rest).unwrap();
    let natural = (at_rest.stiffness[(0, 0)] / mechanism.mass()[(0, 0)]).sqrt() / TAU;
    let resonance = natural * 60.0 / 23.0;
    let mut plan = plan(1.3 * resonance, 0.7 * resonance);
    (plan.balance.harmonics, plan.balance.most_harmonics, plan.balance.tail) = (32, 32, 0.1);
    let found = branch(&mut mechanism, &plan);
    let mut all = AllCoordinates { mechanism: make(), scale: rest.q.map(f64::abs) };
    all.mechanism.start(0.0).unwrap();
    let start = FourierSeries::at_rest(&rest.q, 1);
    let wanted = plan.follow(&mut all, &start, |_| ControlFlow::Continue(())).unwrap();
    let folds = |of: &Branch<GearboxError>| -> Vec<f64> {
        of.bifurcations.iter().filter(|b| b.loss == Loss::Fold).map(|b| b.motion.parameter).collect()
    };
    let [a, b] = [folds(&found.branch), folds(&wanted)];
    let largest =
        found.motions.iter().map(|m| 1e6 * m.peak_to_peak(&DVector::from_element(1, 1.0))).fold(0.0, f64::max);
    println!("resonance at {resonance:.1} 1/min, folds at {a:.4?}, {largest} urad, at rest {} urad", 1e6 * rest.q[0]);
    for (m, w) in found.branch.motions.iter().zip(&found.motions) {
        println!(
            "M {:.1} {:.4} {:.4} {}",
            m.parameter,
            1e6 * w.peak_to_peak(&DVector::from_element(1, 1.0)),
            m.floquet.largest(),
            m.series.harmonics()
        );
    }
    assert!(a.len() == 2 && b.len() == 2, "folds at {a:?} and {b:?}");
    assert!(a.iter().zip(&b).all(|(a, b)| (a / b - 1.0).abs() < 1e-7), "folds at {a:?}, not {b:?}");
    for (motion, whole) in found.branch.motions.iter().zip(&found.motions).step_by(4) {
        let mut tracer = Tracer::new(&mut all, plan.balance, 1.0).unwrap();
        let own = tracer.motion_at(motion.parameter, whole).unwrap();
        assert!(own.iterations <= 1, "{} Newton steps from what is a solution", own.iterations);
        let one = DVector::from_element(1, 1.0);
        let [a, b] = [whole.peak_to_peak(&one), own.series.peak_to_peak(&one)];
        assert!((a / b - 1.0).abs() < 1e-8, "{:.1} 1/min: {a} rad, not {b} rad", motion.parameter);
        let [a, b] = [&motion.floquet, &own.floquet].map(|f| f.largest());
        assert!((a / b - 1.0).abs() < 1e-7, "{:.1} 1/min: multiplier {a}, not {b}", motion.parameter);
    }
    for [known, all] in found.with_all_modes {
        assert!((known - all).abs() < 1e-9, "one mode is all there is: {known}, {all}");
    }
}

/// A gearbox that a torque drives has no branch over its speed, and one whose meshes come back together after hundreds of cycles has
/// none with these harmonics: both are told.
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
}
