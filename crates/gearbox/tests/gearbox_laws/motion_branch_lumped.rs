//! The branch of a gearbox of held shafts beside the curve of the lumped pair with the same springs.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{convert::Infallible, f64::consts::TAU, ops::ControlFlow};

use dynamics::RigidBody;
use gearbox::{
    GearMesh, Torque,
    motion::{Drive, GearboxMechanism, MotionOptions, Speed, SpringMesh},
};
use geometry::{Driver, GearPair, Sense};
use integrate::{Forces, Mechanism};
use lumped::{
    Fourier, LumpedModel, LumpedPair, MeshClock, MeshCycle, Operation,
    lumped8::{Lumped8, MeshLaw, Motion8, Support8},
};
use nalgebra::{DMatrix, DVector};
use periodic::{Branch, FourierSeries, Loss, PeriodicFamily, Tracer};

use crate::{
    motion_branch::{DAMPING, branch, plan},
    pairs::{operation, pair, single},
};

const RPM: f64 = TAU / 60.0;
const TORQUE: f64 = 1.5e5;
/// Stiffness of what holds the lumped gears in place, N/mm; about an axis N mm.
const HELD: f64 = 1e10;

/// Stiffness along the normal, N/mm.
fn stiffness() -> Fourier {
    Fourier { mean: 4e5, cosine: vec![5e4], sine: vec![2e4, 1e4] }
}

fn gearbox(gears: &GearPair) -> GearboxMechanism {
    let structure = single(gears, 0.3);
    let mut operation = operation(&structure, 2, Sense::Ccw, vec![Torque { disc: 3, torque: TORQUE }]);
    operation.held = vec![0, 1];
    let meshes = vec![GearMesh { name: "pair".into(), discs: [0, 1], pair: gears.clone() }];
    let drive = Drive::Speed(Speed::Constant(1500.0));
    let options = MotionOptions { drive, modal_damping: DAMPING, limit: TAU * 6000.0 };
    GearboxMechanism::new(structure, meshes, operation, &options, |_, mesh, meshing| {
        Ok(Box::new(SpringMesh::new(mesh, meshing, stiffness())?.with_coast_flanks(mesh, meshing)?))
    })
    .unwrap()
}

/// A lumped pair over the speed of its driver, 1/min.
struct LumpedCurve {
    model: Lumped8,
    motion: Motion8,
}

impl Mechanism for LumpedCurve {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        self.motion.mass()
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        self.motion.forces(t, q, v, out)
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        self.motion.potential(t, q)
    }
}

impl PeriodicFamily for LumpedCurve {
    fn set_parameter(&mut self, value: f64) -> Result<(), Infallible> {
        let clock = self.model.pair.clock.at_speed(value * RPM);
        self.model.pair.clock = clock;
        self.motion = self.model.motion().unwrap();
        Ok(())
    }

    fn period(&self) -> f64 {
        1.0 / self.model.pair.clock.mesh_frequency()
    }

    fn scale(&self) -> DVector<f64> {
        self.motion.scale()
    }
}

/// The lumped pair whose driver and axes nothing moves, with the wheel's inertia and damping about its axis; `start`: mesh
/// cycles at t = 0.
fn lumped_pair(gears: &GearPair, [inertia, damping]: [f64; 2], start: f64) -> LumpedCurve {
    let cos = gears.base_helix_angle().cos();
    // On the transverse line of action.
    let along = |all: &[f64]| all.iter().map(|x| x * cos * cos).collect();
    let normal = stiffness();
    let transverse =
        Fourier { mean: normal.mean * cos * cos, cosine: along(&normal.cosine), sine: along(&normal.sine) };
    let body = |polar_inertia: f64| RigidBody { mass: 1e-3, transverse_inertia: polar_inertia, polar_inertia };
    let asked = Operation { driver: Driver::Pinion, sense: Sense::Ccw, speed: 1500.0, torque: TORQUE, friction: 0.0 };
    let cycle = MeshCycle::new(transverse, Fourier::constant(0.0));
    let mut own = LumpedPair::new(gears, &asked, [body(1.0), body(inertia)], cycle).unwrap();
    own.clock = MeshClock { start, ..own.clock };
    let critical = 2.0 * (HELD * 1e-3f64).sqrt();
    let axes = Support8 { stiffness: [HELD; 3], damping: [critical; 3], turning_stiffness: 0.0, turning_damping: 0.0 };
    // The driver's turn deflects by some millionths of the mesh: levers are some 35 mm.
    let turning = 1e4 * HELD;
    let driver = Support8 { turning_stiffness: turning, turning_damping: 2.0 * turning.sqrt(), ..axes };
    let driven = Support8 { turning_damping: damping, ..axes };
    let backlash = MeshLaw::Normal.half_backlash(gears);
    let model = Lumped8::new(own, [driver, driven], 0.0, backlash, MeshLaw::Normal).unwrap();
    let motion = model.motion().unwrap();
    LumpedCurve { model, motion }
}

fn folds<E>(of: &Branch<E>) -> Vec<f64> {
    of.bifurcations.iter().filter(|b| b.loss == Loss::Fold).map(|b| b.motion.parameter).collect()
}

/// A gearbox of held shafts and the lumped pair whose axes are as good as held have the same springs, backlash and damping of
/// the wheel: the two programs find the same folds, the same amplitudes and the same multipliers, stable and unstable, with
/// loss of contact. What is left is by what the lumped pair's axes give way, some 1e-4 of the mesh.
#[test]
fn held_shafts_have_the_curve_of_the_lumped_pair() {
    let gears = pair([23, 31], 12.0);
    let mut mechanism = gearbox(&gears);
    assert_eq!(mechanism.count(), 1);
    let rest = mechanism.start(DAMPING).unwrap();
    let mut at_rest = Forces::zeros(1);
    at_rest.tangents = true;
    mechanism.forces(0.0, &rest.q, &DVector::zeros(1), &mut at_rest).unwrap();
    let inertia = mechanism.mass()[(0, 0)];
    let lever = gears.wheel.base_radius() * gears.base_helix_angle().cos();
    let resonance = (stiffness().mean * lever * lever / inertia).sqrt() / TAU * 60.0 / 23.0;
    let begun = mechanism.instant(&rest).unwrap().meshes[0];
    let plan = plan(1.15 * resonance, 0.7 * resonance);
    let found = branch(&mut mechanism, &plan);
    let mut curve = lumped_pair(&gears, [inertia, at_rest.damping[(0, 0)]], begun.cycles);
    let start = FourierSeries::at_rest(&curve.motion.quasi_static(begun.cycles).unwrap(), 1);
    let wanted = plan.follow(&mut curve, &start, |_| ControlFlow::Continue(())).unwrap();
    let [a, b] = [folds(&found.branch), folds(&wanted)];
    let broken = wanted.broken.as_ref().map(ToString::to_string);
    println!("{} motions of the lumped pair, {broken:?}", wanted.motions.len());
    println!("resonance at {resonance:.1} 1/min, folds at {a:.4?}, of the lumped pair at {b:.4?}");
    assert!(a.len() == 2 && b.len() == 2, "folds at {a:?} and {b:?}");
    assert!(a.iter().zip(&b).all(|(a, b)| (a / b - 1.0).abs() < 2e-4), "folds at {a:?}, of the lumped pair {b:?}");
    // The wheel lags where its flanks are pressed.
    let (one, radius) = (DVector::from_element(1, 1.0), gears.wheel.base_radius());
    let turned = radius * rest.q[0].signum() * begun.transmission_error.signum();
    let at = |z: f64| (turned * z + curve.model.clearance()) / radius;
    let guesses: Vec<FourierSeries> = found
        .motions
        .iter()
        .map(|whole| {
            let samples = DMatrix::from_fn(8, 512, |i, k| match i {
                7 => at(whole.at(TAU * k as f64 / 512.0)[0]),
                _ => start.at(0.0)[i],
            });
            FourierSeries::of_samples(&samples, whole.harmonics()).unwrap()
        })
        .collect();
    let (mut worst, mut unstable) = ([0.0f64; 2], 0);
    for ((motion, whole), guess) in found.branch.motions.iter().zip(&found.motions).zip(&guesses).step_by(3) {
        let mut tracer = Tracer::new(&mut curve, plan.balance, 1.0).unwrap();
        let own = tracer.motion_at(motion.parameter, guess).unwrap();
        let wheel = DVector::from_fn(8, |i, _| f64::from(u8::from(i == 7)));
        let sizes = [whole.peak_to_peak(&one), own.series.peak_to_peak(&wheel)];
        let multipliers = [&motion.floquet, &own.floquet].map(|f| f.largest());
        for (worst, [a, b]) in worst.iter_mut().zip([sizes, multipliers]) {
            *worst = worst.max((a / b - 1.0).abs());
        }
        unstable += usize::from(!motion.floquet.is_stable());
    }
    println!("peak to peak {:.1e}, multipliers {:.1e} apart; {unstable} of them unstable", worst[0], worst[1]);
    assert!(unstable > 0, "no unstable motion");
    assert!(worst[0] < 2e-3 && worst[1] < 5e-3, "{worst:?} apart");
}
