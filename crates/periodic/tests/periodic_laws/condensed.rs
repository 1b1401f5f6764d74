//! A chain of masses with forces at few places: the balance of those places alone is that of all coordinates.
#![allow(clippy::print_stdout, reason = "the figures are what the tests are for")]

use std::{convert::Infallible, f64::consts::TAU, ops::ControlFlow};

use integrate::{Forces, Mechanism};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use periodic::{
    BalanceOptions, Branch, BranchPlan, Condensed, CondensedFamily, FourierSeries, LinearMachine, Loss, PeriodicFamily,
    PeriodicMotion, PeriodicMotionOf, Tracer,
};

/// Contact with clearance between the ends of two chains, stiffer and softer over the period; nothing else holds the second one.
#[derive(Clone)]
struct Contact {
    frequency: f64,
}

impl Contact {
    /// f and -df/ds, -df/ds' at a share of the period.
    fn at(&self, share: f64, [s, rate]: [f64; 2]) -> [f64; 3] {
        let k = 4.0 + 0.6 * (TAU * share).cos();
        if s > 0.0 { [-k * s - 0.05 * rate, k, 0.05] } else { [0.0; 3] }
    }
}

/// Four masses: 1 and 2 on springs to a wall, 3 and 4 on springs to each other, pressed against 2 by a load.
fn machine() -> LinearMachine {
    let stiffness = dmatrix![
        30.0, -20.0, 0.0, 0.0;
        -20.0, 20.0, 0.0, 0.0;
        0.0, 0.0, 25.0, -25.0;
        0.0, 0.0, -25.0, 25.0
    ];
    let mass = DMatrix::from_diagonal(&dvector![1.0, 0.7, 1.2, 0.5]);
    LinearMachine {
        damping: &stiffness * 4e-3 + DMatrix::from_diagonal(&dvector![0.02, 0.0, 0.0, 0.01]),
        gyroscopic: dmatrix![0.0, 0.1, 0.0, 0.0; -0.1, 0.0, 0.0, 0.0; 0.0, 0.0, 0.0, -0.05; 0.0, 0.0, 0.05, 0.0],
        load: dvector![0.0, 0.0, 0.0, 1.0],
        levers: dmatrix![0.0; -1.0; 1.0; 0.0],
        reference: dmatrix![4.0],
        highest: f64::INFINITY,
        mass,
        stiffness,
    }
}

/// The contact as what the balance of few places sees.
struct Few(Contact);

impl CondensedFamily for Few {
    type Error = Infallible;

    fn frequency_slope(&self) -> f64 {
        1.0
    }

    fn scale(&self) -> DVector<f64> {
        dvector![0.25]
    }

    fn forces(
        &mut self,
        share: f64,
        _: f64,
        s: &DVector<f64>,
        rate: &DVector<f64>,
        out: &mut Forces,
    ) -> Result<(), Infallible> {
        let [f, k, d] = self.0.at(share, [s[0], rate[0]]);
        (out.other[0], out.stiffness[(0, 0)], out.damping[(0, 0)]) = (f, k, d);
        Ok(())
    }
}

/// All coordinates at once.
struct All {
    contact: Contact,
    machine: LinearMachine,
}

impl Mechanism for All {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.machine.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let (m, levers) = (&self.machine, &self.machine.levers);
        let [s, rate] = [q, v].map(|x| levers.tr_mul(x)[0]);
        let [f, k, d] = self.contact.at(t / PeriodicFamily::period(self), [s, rate]);
        let damping = &m.damping + &m.gyroscopic * self.contact.frequency;
        out.other += &m.load + levers * f - &m.stiffness * q - &damping * v;
        out.stiffness += &m.stiffness + levers * k * levers.transpose();
        out.damping += damping + levers * d * levers.transpose();
        Ok(())
    }

    fn potential(&mut self, _: f64, _: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.0)
    }
}

impl PeriodicFamily for All {
    fn set_parameter(&mut self, value: f64) -> Result<(), Infallible> {
        self.contact.frequency = value;
        Ok(())
    }

    fn period(&self) -> f64 {
        TAU / self.contact.frequency
    }

    fn scale(&self) -> DVector<f64> {
        DVector::from_element(4, 0.25)
    }
}

fn plan() -> BranchPlan {
    let balance = BalanceOptions {
        harmonics: 24,
        most_harmonics: 24,
        tail: 1e-2,
        samples_per_harmonic: 16,
        least_samples: 1024,
        tolerance: 1e-11,
    };
    BranchPlan { from: 1.6, to: 0.8, balance, longest_step: 0.05, most: 400 }
}

fn few(machine: &LinearMachine) -> (Condensed<Few>, Branch<Infallible>) {
    let mut system = Condensed::new(Few(Contact { frequency: 1.0 }), machine).unwrap();
    let start = system.rest();
    let branch = plan().follow(&mut system, &start, |_| ControlFlow::Continue(())).unwrap();
    (system, branch)
}

/// Motion by motion through loss of contact and around folds: all coordinates that follow from the contact's own solve the equations
/// of all of them, with the same multipliers.
#[test]
fn few_places_stand_for_all_coordinates() {
    let machine = machine();
    let (mut system, branch) = few(&machine);
    let folds = branch.bifurcations.iter().filter(|b| b.loss == Loss::Fold).count();
    assert!(branch.broken.is_none() && folds >= 2, "{folds} folds, {:?}", branch.broken);
    let mut all = All { contact: Contact { frequency: 1.0 }, machine: machine.clone() };
    let unstable = branch.motions.iter().filter(|m| !m.floquet.is_stable()).count();
    assert!(unstable > 2, "{unstable} unstable motions");
    for motion in branch.motions.iter().step_by(5) {
        let of = PeriodicMotionOf { parameter: motion.parameter, series: &motion.series, samples: 1024 };
        let whole = system.whole(&of).unwrap();
        let mut tracer = Tracer::new(&mut all, plan().balance, 1.0).unwrap();
        let wanted = tracer.motion_at(motion.parameter, &whole).unwrap();
        assert!(wanted.iterations <= 2, "{} Newton steps from what is a solution", wanted.iterations);
        let size = wanted.series.peak_to_peak(&dvector![0.0, 0.0, 1.0, 0.0]);
        for phase in [0.0, 1.0, 2.5, 4.0] {
            let off = (wanted.series.at(phase) - whole.at(phase)).amax();
            assert!(off < 1e-8 * size, "w {}: off by {off:e} of {size}", motion.parameter);
        }
        let [found, right] = [motion, &wanted].map(|m| m.floquet.largest());
        assert!((found - right).abs() < 1e-6 * right, "w {}: multiplier {found}, not {right}", motion.parameter);
    }
}

/// The motion of a machine at the value of another one that is near.
fn beside(machine: &LinearMachine, options: BalanceOptions, motion: &PeriodicMotion) -> PeriodicMotion {
    let mut system = Condensed::new(Few(Contact { frequency: 1.0 }), machine).unwrap();
    Tracer::new(&mut system, options, 1.0).unwrap().motion_at(motion.parameter, &motion.series).unwrap()
}

/// Whether a motion is stable and away from folds, where it moves by many times what it is pushed by.
fn far_from_folds(motion: &&PeriodicMotion) -> bool {
    motion.parameter > 1.07 && motion.floquet.is_stable()
}

/// k_0 is added to the machine and taken off the forces: motions, multipliers and folds are the same whatever it is.
#[test]
fn the_reference_stiffness_changes_nothing() {
    let machine = machine();
    let other = LinearMachine { reference: dmatrix![1.3], ..machine.clone() };
    let [a, b] = [&machine, &other].map(|machine| few(machine).1);
    for motion in a.motions.iter().step_by(4) {
        let same = beside(&other, plan().balance, motion);
        assert!(same.iterations <= 1, "w {}: {} Newton steps", motion.parameter, same.iterations);
        let [found, wanted] = [&same, motion].map(|m| m.floquet.largest());
        assert!((found / wanted - 1.0).abs() < 1e-7, "w {}: multiplier {found}, not {wanted}", motion.parameter);
    }
    let folds = |of: &Branch<Infallible>| -> Vec<f64> {
        of.bifurcations.iter().filter(|b| b.loss == Loss::Fold).map(|b| b.motion.parameter).collect()
    };
    let [a, b] = [folds(&a), folds(&b)];
    assert_eq!(a.len(), 2, "{a:?}: where the branch turns, and nowhere else");
    assert!(a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| (a / b - 1.0).abs() < 1e-7), "{a:?}, {b:?}");
}

/// Modes above the highest frequency that is known follow as if at rest: motions and multipliers are nearly those of the whole
/// machine, and what is left out of the multipliers is what those of all modes say.
#[test]
fn modes_beyond_the_highest_frequency_follow() {
    let machine = machine();
    let fewer = LinearMachine { highest: 5.0, ..machine.clone() };
    let (_, branch) = few(&machine);
    for motion in branch.motions.iter().filter(far_from_folds).step_by(6) {
        let found = beside(&fewer, plan().balance, motion);
        let size = motion.series.peak_to_peak(&dvector![1.0]);
        let off = (0..8).map(|i| (found.series.at(f64::from(i)) - motion.series.at(f64::from(i)))[0].abs());
        let off = off.fold(0.0, f64::max) / size;
        assert!(off < 5e-3, "w {}: off by {off:e}", motion.parameter);
        let mut system = Condensed::new(Few(Contact { frequency: 1.0 }), &fewer).unwrap();
        let of = PeriodicMotionOf { parameter: motion.parameter, series: &found.series, samples: 1024 };
        let all = system.with_all_modes(&of).unwrap();
        assert!(all.multipliers.len() == 8 && found.floquet.multipliers.len() == 4, "{all:?}, {found:?}");
        let [known, all, exact] = [&found.floquet, &all, &motion.floquet].map(|f| f.largest());
        println!("w {:.4}: off {off:.1e}, multiplier {exact:.5}, {all:.5}, {known:.5}", motion.parameter);
        assert!((all - exact).abs() < 1e-3 * exact && (known - exact).abs() < 2e-2 * exact);
    }
}

/// What few harmonics say that they leave out is what more of them add, in root mean square over the vibration.
#[test]
fn the_tail_is_what_more_harmonics_add() {
    let (_, branch) = few(&machine());
    let off = |a: &PeriodicMotion, b: &PeriodicMotion| {
        let at = |i: usize| TAU * i as f64 / 256.0;
        let square = |of: &dyn Fn(f64) -> f64| (0..256).map(|i| of(at(i)).powi(2)).sum::<f64>();
        let mean = b.series.amplitude(0, 0);
        (square(&|t| (a.series.at(t) - b.series.at(t))[0]) / square(&|t| b.series.at(t)[0] - mean)).sqrt()
    };
    let mut seen = 0;
    for motion in branch.motions.iter().filter(far_from_folds).filter(|m| m.tail > 1e-6).step_by(3) {
        let fewer = BalanceOptions { harmonics: 8, most_harmonics: 8, tail: 1.0, ..plan().balance };
        let found = beside(&machine(), fewer, motion);
        let (left, added) = (found.tail, off(&found, motion));
        println!("w {:.4}: tail {left:.2e}, added {added:.2e}", motion.parameter);
        assert!(added < 2.0 * left && left < 2.0 * added, "w {}: tail {left:e}, added {added:e}", motion.parameter);
        seen += 1;
    }
    assert!(seen > 3, "{seen} motions");
}

/// A plan that ends too early says where, and what it left out.
#[test]
fn a_branch_cut_short_is_told() {
    let short = BranchPlan { most: 3, ..plan() };
    let mut system = Condensed::new(Few(Contact { frequency: 1.0 }), &machine()).unwrap();
    let start = FourierSeries::at_rest(&dvector![0.25], 1);
    let branch = short.follow(&mut system, &start, |_| ControlFlow::Continue(())).unwrap();
    let last = branch.motions.last().unwrap().parameter;
    assert_eq!(short.cut_short(&branch), Some(last));
    let left = short.left_out(&branch);
    assert!((left - (1.0 - (1.6 - last) / 0.8)).abs() < 1e-12 && left > 0.5, "{left} left out, last at {last}");
    assert_eq!(plan().left_out(&few(&machine()).1), 0.0);
}
