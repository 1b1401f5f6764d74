//! The ladder: lumped models of one pair agree where they must (linear, no friction, the same stiffness).
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use crate::{
    common::{bodies_004, gears_004, operation, relative},
    recording::{RunPlan, run},
};
use integrate::{Mechanism, Scheme};
use lumped::{
    LumpedError, LumpedModel, LumpedPair, MeshClock, MeshCycle,
    lumped8::{Lumped8, MeshLaw, Support8},
    lumped12::{Lumped12, Support12},
    modes::{Mode, linearised, undamped_modes},
};
use nalgebra::DVector;

const TORQUE: f64 = 900e3;

/// Samples as a quasi-static analysis would hand them on: smooth, not sines.
fn samples() -> [Vec<f64>; 3] {
    let of = |f: &dyn Fn(f64) -> f64| (0..32).map(|k| f(TAU * f64::from(k) / 32.0)).collect();
    [
        of(&|p| 1.2e6 * (1.0 + 0.06 * p.cos() - 0.02 * (2.0 * p).sin())),
        of(&|p| 103.9 + 2.9 * p.cos()),
        of(&|p| 6e-3 + 4e-4 * (p + 0.4).sin() + 1e-4 * (3.0 * p).cos()),
    ]
}

fn fed(speed: f64) -> LumpedPair {
    let gears = gears_004();
    let [k, length, ste] = samples();
    let force = TORQUE / gears.wheel.base_radius();
    let cycle = MeshCycle::fed(&k, &length, &ste, force).unwrap();
    let operation = lumped::Operation { speed, ..operation(TORQUE, 0.0) };
    LumpedPair::new(&gears, &operation, bodies_004(&gears), cycle).unwrap()
}

/// Both models with the same translational supports, tilting held; stiffness of supports in N/mm.
fn models(pair: &LumpedPair, support: f64) -> (Lumped8, Lumped12) {
    let eight = Support8 { stiffness: [support; 3], ..Support8::default() };
    let mut twelve = [support; 6];
    (twelve[3], twelve[4], twelve[5]) = (1e15, 1e15, 0.0);
    let omega = pair.natural_frequency();
    (
        Lumped8::new(pair.clone(), [eight; 2], 0.05, 0.0, MeshLaw::Normal).unwrap(),
        Lumped12::new(pair.clone(), [Support12 { stiffness: twelve }; 2], 0.05, [0.5 * omega, 2.0 * omega]).unwrap(),
    )
}

fn at(pair: &LumpedPair, phase: f64) -> LumpedPair {
    LumpedPair { clock: MeshClock { start: phase, ..MeshClock::steady(30, 1e-9) }, ..pair.clone() }
}

/// Share of the turning against each other in a mode's kinetic energy, and its frequency in Hz: the torsional one has
/// the most.
fn torsional(modes: &[Mode], mass: &nalgebra::DMatrix<f64>, turns: [usize; 2]) -> f64 {
    let share = |m: &Mode| turns.iter().map(|&i| mass[(i, i)] * m.shape[i].norm_sqr()).sum::<f64>();
    modes.iter().filter(|m| m.frequency_hz > 1.0).max_by(|a, b| share(a).total_cmp(&share(b))).unwrap().frequency_hz
}

/// Same static deflection within 1 % at every phase, the same torsional resonance within 2 %, which with stiff supports
/// is sqrt(k / m_e) / (2 pi).
#[test]
fn static_deflection_and_torsional_resonance_agree() {
    let pair = fed(100.0);
    let [_, _, ste] = samples();
    for (support, stiff) in [(1e12, true), (5e5, false)] {
        for k in (0..32).step_by(5) {
            let phase = k as f64 / 32.0;
            let (eight, twelve) = models(&at(&pair, phase), support);
            let (m8, m12) = (eight.motion().unwrap(), twelve.motion().unwrap());
            let te8 = m8.row(0.0, &m8.quasi_static(phase).unwrap(), &DVector::zeros(8)).transmission_error;
            let te12 = m12.row(0.0, &m12.quasi_static(phase).unwrap(), &DVector::zeros(12)).transmission_error;
            assert!((te12 / te8 - 1.0).abs() < 1e-4, "phase {phase}: {te8} and {te12} mm");
            if stiff {
                for te in [te8, te12] {
                    assert!((te / ste[k] - 1.0).abs() < 1e-4, "phase {phase}: {te} mm, fed {}", ste[k]);
                }
            } else {
                assert!(te8 > 1.5 * ste[k], "soft supports give way too: {te8}");
            }
        }
        let (eight, twelve) = models(&at(&pair, 0.0), support);
        let (mut m8, m12) = (eight.motion().unwrap(), twelve.motion().unwrap());
        let q = m8.quasi_static(0.0).unwrap();
        let (k, _) = linearised(&mut m8, 0.0, &q).unwrap();
        let f8 = torsional(&undamped_modes(m8.mass(), &k).unwrap(), m8.mass(), [3, 7]);
        let f12 = torsional(&m12.modes(0.0).unwrap(), m12.mass(), [5, 11]);
        let [now, ..] = pair.excitation(0.0);
        let wanted = (now / pair.reduced_mass()).sqrt() / TAU;
        println!("supports {support:e} N/mm: {f8:.2} and {f12:.2} Hz, sqrt(k/m_e) {wanted:.2} Hz");
        assert!((f12 / f8 - 1.0).abs() < 1e-3, "{f8} and {f12} Hz");
        assert!(!stiff || (f8 / wanted - 1.0).abs() < 1e-3, "{f8} Hz, not {wanted}");
    }
}

/// The resonance in time: steady vibration is largest where the eigenvalues say (within 2 %), in both models alike.
#[test]
fn resonance_in_time_is_where_the_eigenvalue_is() {
    let mut pair = fed(100.0);
    pair.cycle.stiffness.cosine.clear();
    pair.cycle.stiffness.sine.clear();
    (pair.cycle.error.cosine, pair.cycle.error.sine) = (vec![1e-4], vec![]);
    let omega = pair.natural_frequency();
    let swing = |model: &mut dyn FnMut(&RunPlan) -> Vec<f64>| {
        let plan = RunPlan {
            scheme: Scheme::GeneralisedAlpha { rho: 0.95 },
            rows_per_cycle: 40,
            steps_per_row: 1,
            settling_cycles: 30,
            cycles: 1,
        };
        let te = model(&plan);
        te.iter().copied().fold(f64::NEG_INFINITY, f64::max) - te.iter().copied().fold(f64::INFINITY, f64::min)
    };
    let ratios: Vec<f64> = (0..13).map(|i| 0.94 + 0.01 * f64::from(i)).collect();
    let mut best = [(0.0, 0.0); 2];
    for &w in &ratios {
        pair.clock = MeshClock::steady(30, w * omega / 30.0);
        let (eight, twelve) = models(&pair, 1e12);
        // Damping alike: stiffness-proportional ratio 0.05 is the mesh damper alone.
        let twelve = Lumped12 { rayleigh: [0.0, 0.1 / omega], ..twelve };
        let te = |rows: Vec<lumped::HistoryRow>| rows.iter().map(|r| r.transmission_error).collect::<Vec<f64>>();
        let both = [
            swing(&mut |plan| te(run(&mut eight.motion().unwrap(), plan, None).unwrap().rows)),
            swing(&mut |plan| te(run(&mut twelve.motion().unwrap(), plan, None).unwrap().rows)),
        ];
        assert!((both[1] / both[0] - 1.0).abs() < 0.01, "W {w}: {both:?}");
        for (best, now) in best.iter_mut().zip(both) {
            if now > best.1 {
                *best = (w, now);
            }
        }
    }
    println!(
        "largest at {:.2} and {:.2} of omega_n, peak to peak {:.3} and {:.3} um",
        best[0].0,
        best[1].0,
        1e3 * best[0].1,
        1e3 * best[1].1
    );
    assert!(best.iter().all(|(w, _)| (w - 1.0).abs() <= 0.02), "{best:?}");
    // A tenth of damping ratio 0.05 of the swing 2e-4 mm: 1 / (2 zeta) times, and the direct share beside it.
    let wanted = 2e-4 * (1.0 + 1.0 / (0.1f64 * 0.1)).sqrt();
    assert!((best[0].1 / wanted - 1.0).abs() < 0.05, "{} mm, not {wanted}", best[0].1);
}

/// Speed to zero: both tend to the fed STE, and the difference falls with the speed (damping; inertia with its square).
#[test]
fn slow_running_is_quasi_static() {
    let [_, _, ste] = samples();
    let mut off = [[0.0; 2]; 2];
    for (i, share) in [0.02, 0.01].into_iter().enumerate() {
        let pair = fed(100.0);
        let speed = share * pair.natural_frequency() / 30.0;
        let (eight, twelve) = models(&LumpedPair { clock: MeshClock::steady(30, speed), ..pair }, 1e12);
        let plan = RunPlan {
            scheme: Scheme::GeneralisedAlpha { rho: 0.5 },
            rows_per_cycle: 32,
            steps_per_row: 40,
            settling_cycles: 1,
            cycles: 1,
        };
        let te = |rows: Vec<lumped::HistoryRow>| rows.iter().map(|r| r.transmission_error).collect::<Vec<f64>>();
        let all = [
            te(run(&mut eight.motion().unwrap(), &plan, None).unwrap().rows),
            te(run(&mut twelve.motion().unwrap(), &plan, None).unwrap().rows),
        ];
        for (model, te) in all.iter().enumerate() {
            off[model][i] = relative(&ste, te);
        }
    }
    println!("off the STE at 2 % and 1 % of the resonance: {off:?}");
    for [fast, slow] in off {
        assert!(slow < 1e-3 && slow < 0.6 * fast, "{fast:e}, {slow:e}");
    }
}

/// Fed with samples that do not belong together: named.
#[test]
fn bad_samples_are_refused() {
    let [k, length, ste] = samples();
    assert!(matches!(MeshCycle::fed(&k, &length[1..], &ste, 1.0), Err(LumpedError::Lengths { .. })));
    assert!(matches!(MeshCycle::fed(&[], &[], &[], 1.0), Err(LumpedError::Empty { .. })));
    let mut holed = k.clone();
    holed[7] = f64::NAN;
    assert!(matches!(MeshCycle::fed(&holed, &length, &ste, 1.0), Err(LumpedError::NotFinite { .. })));
    let negative: Vec<f64> = k.iter().map(|k| k - 1.2e6).collect();
    assert!(MeshCycle::fed(&negative, &length, &ste, 1.0).is_err());
    assert!(matches!(MeshCycle::fed(&k, &length, &ste, f64::NAN), Err(LumpedError::NotFinite { .. })));
}
