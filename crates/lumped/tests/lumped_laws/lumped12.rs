//! Twelve coordinates (seed 003): mirrors, friction off the line of action, modes and flutter.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use crate::{
    common::{pair_004, relative, seed_003},
    recording::{RunPlan, run},
};
use geometry::Sense;
use integrate::{Forces, Integrator, Mechanism, Scheme, State, StepControl};
use lumped::{
    FourierTorque, HistoryRow, LineSharing, LumpedError, LumpedModel, MeshClock,
    lumped12::{Lumped12, Motion12, Support12},
    modes::damped_modes,
};
use nalgebra::DVector;

fn plan(scheme: Scheme) -> RunPlan {
    RunPlan { scheme, rows_per_cycle: 32, steps_per_row: 2, settling_cycles: 60, cycles: 8 }
}

fn rows(model: &Lumped12) -> Vec<HistoryRow> {
    run(&mut model.motion().unwrap(), &plan(Scheme::Newmark), None).unwrap().rows
}

/// Vibration of gear i along, across and along the axis: root mean square about the mean, mm.
fn vibration(model: &Lumped12) -> [f64; 3] {
    let frame = model.pair.frame;
    let all = rows(model);
    [frame.along(), frame.across(), geometry::Vec3::z()].map(|axis| {
        let x: Vec<f64> = all.iter().map(|r| (0..3).map(|i| axis[i] * r.displacement[i]).sum()).collect();
        let mean = x.iter().sum::<f64>() / x.len() as f64;
        (x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / x.len() as f64).sqrt()
    })
}

/// Seed 003's finding: mu = 0.1 lifts vibration off the line of action most. The tables are not reproduced (masses,
/// supports, error and load are not given).
///
/// Load 100 N m on the driven gear; supports that differ by a fiftieth between x and y, so that there is vibration
/// across without friction to compare with. The growth takes the seed's way of sharing load, line by line: with load
/// spread evenly over the whole length of the lines, friction before and after the pitch line cancels in this pair
/// (eps_alpha 2.00).
#[test]
fn friction_lifts_vibration_across_the_line_of_action_most() {
    let of = |sharing, mu, round: bool| {
        let mut model = seed_003(30.25, Sense::Ccw, mu);
        model.pair.plane.sharing = sharing;
        let [r, big_r] = model.pair.base_radii;
        model.pair.torques = [1e5 * r / big_r, 1e5].map(FourierTorque::constant);
        // A motor, against the torque of friction.
        model.supports[0].stiffness[5] = 1e9;
        if round {
            model.supports.iter_mut().for_each(|s| s.stiffness[0] = s.stiffness[1]);
        }
        vibration(&model)
    };
    for (sharing, least) in [(LineSharing::ByLine, 1.5), (LineSharing::ByLength, 0.9)] {
        let [without, with] = [0.0, 0.1].map(|mu| of(sharing, mu, false));
        let ratio: Vec<f64> = (0..3).map(|i| with[i] / without[i]).collect();
        let plane = lumped::PlaneOfAction { sharing, ..seed_003(30.25, Sense::Ccw, 0.1).pair.plane };
        let split: Vec<f64> = (0..400).map(|k| plane.at(f64::from(k) / 400.0).split[0]).collect();
        let [low, high] = [f64::min, f64::max].map(|f| split.iter().copied().reduce(f).unwrap());
        println!("{sharing:?}: lambda_1 - lambda_2 from {low:.4} to {high:.4}");
        for (i, name) in ["along", "across", "axial"].into_iter().enumerate() {
            let [a, b] = [without[i], with[i]].map(|x| 1e3 * x);
            println!("  {name}: {a:.4} um without, {b:.4} um with friction, ratio {:.3}", ratio[i]);
        }
        assert!(ratio[1] > least, "{sharing:?}: {ratio:?}");
        assert!(sharing == LineSharing::ByLength || (ratio[1] > ratio[0] && ratio[1] > ratio[2]), "{ratio:?}");
        // With supports alike in all directions nothing but friction moves the gears across the line of action.
        let [without, with] = [0.0, 0.1].map(|mu| of(sharing, mu, true));
        assert!(without[1] < 1e-9 * without[0] && with[1] > 1e-5 * with[0], "{without:?}, {with:?}");
    }
}

/// Mirror images: the other hand in the plane z = 0, the other hand and sense in y = 0, the other sense by half a turn
/// about x. With friction and load.
#[test]
fn mirrors_of_hand_and_sense() {
    let loaded = |helix, sense| {
        let mut model = seed_003(helix, sense, 0.1);
        model.pair.frame.orientation = 0.0;
        let [r, big_r] = model.pair.base_radii;
        model.pair.torques = [1e4 * r / big_r, 1e4].map(FourierTorque::constant);
        model.supports[0].stiffness[5] = 1e9;
        rows(&model)
    };
    let base = loaded(30.25, Sense::Ccw);
    // Signs of x, y, z and of the turns about them.
    let images = [
        ("hand", loaded(-30.25, Sense::Ccw), [1.0, 1.0, -1.0, -1.0, -1.0, 1.0]),
        ("hand and sense", loaded(-30.25, Sense::Cw), [1.0, -1.0, 1.0, -1.0, 1.0, -1.0]),
        ("sense", loaded(30.25, Sense::Cw), [1.0, -1.0, -1.0, 1.0, -1.0, -1.0]),
    ];
    for (name, image, signs) in images {
        let pick = |rows: &[HistoryRow], signs: &[f64; 6]| -> [Vec<f64>; 3] {
            [
                rows.iter().map(|r| r.transmission_error).collect(),
                rows.iter().flat_map(|r| (0..12).map(|i| signs[i % 6] * r.displacement[i])).collect(),
                rows.iter()
                    .flat_map(|r| {
                        r.wrench.iter().flat_map(|w| (0..3).map(|i| signs[i] * w.force[i])).collect::<Vec<_>>()
                    })
                    .collect(),
            ]
        };
        let worst =
            pick(&base, &[1.0; 6]).iter().zip(&pick(&image, &signs)).map(|(a, b)| relative(a, b)).fold(0.0, f64::max);
        println!("mirror of {name}: off by {worst:.1e}");
        assert!(worst < 1e-9, "{name}: {worst:e}");
    }
}

/// Tangents are derivatives, forces of friction and mesh cancel between the gears, and the stiffness matrix is the
/// tangent.
#[test]
fn tangents_are_derivatives() {
    let model = seed_003(30.25, Sense::Ccw, 0.1);
    let mut motion = model.motion().unwrap();
    let q = DVector::from_fn(12, |i, _| 1e-3 * (1.0 + 0.7 * i as f64).sin());
    let v = DVector::from_fn(12, |i, _| (2.0 + 1.3 * i as f64).cos());
    let t = 3.3e-4;
    let mut out = Forces::zeros(12);
    motion.forces(t, &q, &v, &mut out).unwrap();
    let mut total = |q: &DVector<f64>, v: &DVector<f64>| {
        let mut out = Forces::zeros(12);
        motion.forces(t, q, v, &mut out).unwrap();
        out.conservative + out.other
    };
    for j in 0..12 {
        let unit = DVector::from_fn(12, |i, _| f64::from(i == j));
        let by_q = (total(&(&q - 1e-4 * &unit), &v) - total(&(&q + 1e-4 * &unit), &v)) / 2e-4;
        let by_v = (total(&q, &(&v - &unit)) - total(&q, &(&v + &unit))) / 2.0;
        for (name, tangent, difference) in [("q", &out.stiffness, by_q), ("v", &out.damping, by_v)] {
            let column = tangent.column(j);
            assert!((&difference - column).amax() < 1e-7 * tangent.amax(), "d/d{name}_{j}");
        }
    }
    let k = model.motion().unwrap().stiffness_at(model.pair.clock.cycles(t));
    assert!((k - &out.stiffness).amax() < 1e-9 * out.stiffness.amax());
}

/// Energy closes: to round-off with the energy scheme, with friction and a mesh whose levers move.
#[test]
fn energy_ledger_closes() {
    let model = seed_003(30.25, Sense::Ccw, 0.1);
    for (scheme, least) in [(Scheme::Energy, 1e-10), (Scheme::Newmark, 1e-2), (Scheme::DormandPrince, 1e-4)] {
        let plan = RunPlan { scheme, rows_per_cycle: 32, steps_per_row: 4, settling_cycles: 0, cycles: 20 };
        let history = run(&mut model.motion().unwrap(), &plan, None).unwrap();
        let residual = history.ledger.relative_residual().abs();
        println!("{scheme:?}: {residual:.1e}");
        assert!(residual < least, "{scheme:?}: {residual:e}");
    }
}

/// Every integrator of the workspace gives the same motion.
#[test]
fn integrators_agree() {
    let model = seed_003(30.25, Sense::Ccw, 0.1);
    let te = |scheme| -> Vec<f64> {
        let plan = RunPlan { scheme, rows_per_cycle: 32, steps_per_row: 16, settling_cycles: 0, cycles: 8 };
        run(&mut model.motion().unwrap(), &plan, None).unwrap().rows.iter().map(|r| r.transmission_error).collect()
    };
    let exact = te(Scheme::DormandPrince);
    for scheme in [Scheme::Newmark, Scheme::Energy, Scheme::GeneralisedAlpha { rho: 0.8 }] {
        let off = relative(&exact, &te(scheme));
        println!("{scheme:?}: {off:.1e}");
        assert!(off < 5e-3, "{scheme:?}: {off:e}");
    }
}

/// Without friction the stiffness is symmetric and no mode grows; friction moves the frequencies a little, as the
/// seed's table says (less than 1 %).
#[test]
fn friction_makes_the_stiffness_non_symmetric_and_moves_frequencies_little() {
    let [free, rubbed] = [0.0, 0.1].map(|mu| seed_003(30.25, Sense::Ccw, mu).motion().unwrap());
    for phase in [0.0, 0.25, 0.5, 0.75] {
        let [a, b] = [&free, &rubbed].map(|m| m.stiffness_at(phase));
        assert!((&a - a.transpose()).amax() < 1e-12 * a.amax() && (&b - b.transpose()).amax() > 1e-4 * b.amax());
        let [a, b] = [&free, &rubbed].map(|m| m.modes(phase).unwrap());
        assert!(a.iter().all(|m| m.growth == 0.0) && a.len() == 12, "phase {phase}");
        // The first is the rigid turn of both gears.
        assert!(a[0].frequency_hz < 1e-3 && a[1].frequency_hz > 10.0);
        for (a, b) in a.iter().zip(&b).skip(1) {
            assert!(
                (b.frequency_hz / a.frequency_hz - 1.0).abs() < 0.01,
                "phase {phase}: {} and {} Hz",
                a.frequency_hz,
                b.frequency_hz
            );
        }
        let list = |m: &[lumped::modes::Mode]| {
            m.iter().map(|m| format!("{:.1}", m.frequency_hz)).collect::<Vec<_>>().join(" ")
        };
        println!("phase {phase}: {} Hz; with friction {} Hz", list(&a), list(&b));
    }
}

/// Seed 004's gears with a face of 10 mm (few lines at once, so that friction of one does not cancel that of another),
/// frozen where the lines are split most unevenly. Supports are turned a little against the line of action and almost
/// alike in both directions: friction across it then comes back along it, and two modes can merge.
fn near_flutter(mu: f64, ratio: f64, turned: f64) -> Lumped12 {
    let mut pair = pair_004(mu);
    pair.torques = [0.0; 2].map(FourierTorque::constant);
    pair.plane.face_width = 10.0;
    pair.frame.orientation = pair.frame.pressure_angle + turned;
    let uneven = |phase: f64| pair.plane.at(phase).split[0].abs();
    let phases = (0..64).map(|k| f64::from(k) / 64.0);
    let start = phases.max_by(|&a, &b| uneven(a).total_cmp(&uneven(b))).unwrap();
    pair.clock = MeshClock { start, ..MeshClock::steady(30, 1e-9) };
    let stiffness = [1e6 * ratio, 1e6, 1e8, 1e12, 1e12, 0.0];
    Lumped12 { pair, supports: [Support12 { stiffness }; 2], rayleigh: [0.0; 2] }
}

fn fluttering(model: &Lumped12) -> Option<lumped::modes::Mode> {
    let modes = model.motion().unwrap().modes(model.pair.clock.start).unwrap();
    modes.into_iter().filter(|m| m.flutters()).max_by(|a, b| a.growth.total_cmp(&b.growth))
}

/// Flutter: friction merges two modes where the eigenvalues say so; in time the motion grows at that rate; damping
/// stops it; without friction it cannot be.
#[test]
fn flutter_grows_as_the_eigenvalues_say() {
    let ratios: Vec<f64> = (0..160).map(|i| 0.4 + 0.005 * f64::from(i)).collect();
    // Little turned, either way: one of the two has the sign that feeds back.
    let turned = [-0.03, 0.03];
    let all =
        |mu: f64| turned.iter().flat_map(|&a| ratios.iter().map(move |&r| near_flutter(mu, r, a))).collect::<Vec<_>>();
    assert!(all(0.0).iter().all(|m| fluttering(m).is_none()), "no friction, no flutter");
    let found: Vec<(Lumped12, lumped::modes::Mode)> =
        all(0.3).into_iter().filter_map(|m| fluttering(&m).map(|mode| (m, mode))).collect();
    let (model, mode) = found.iter().max_by(|a, b| a.1.growth.total_cmp(&b.1.growth)).expect("some supports flutter");
    let omega = TAU * mode.frequency_hz;
    println!(
        "{} of {} supports flutter; worst {:.1} Hz, growth {:.2} 1/s, {:.2e} of omega; split {:.3}",
        found.len(),
        2 * ratios.len(),
        mode.frequency_hz,
        mode.growth,
        mode.growth / omega,
        model.pair.plane.at(model.pair.clock.start).split[0]
    );
    let rate = measured_growth(model, mode);
    println!("in time {rate:.3} 1/s");
    assert!((rate / mode.growth - 1.0).abs() < 0.01, "grows by {rate} 1/s, not {}", mode.growth);
    // Damping of twice the growth in ratio takes it away.
    let mut damped = model.clone();
    damped.rayleigh = [6.0 * mode.growth, 0.0];
    let mut motion = damped.motion().unwrap();
    let (k, c) = lumped::modes::linearised(&mut motion, 0.0, &DVector::zeros(12)).unwrap();
    let roots = damped_modes(motion.mass(), &c, &k).unwrap();
    assert!(roots.iter().all(|m| m.growth < 1e-6 * omega), "{:?}", roots.iter().map(|m| m.growth).collect::<Vec<_>>());
    assert!(measured_growth(&damped, mode) < 0.0);
}

/// Rate at which the motion grows that starts in a mode's shape.
fn measured_growth(model: &Lumped12, mode: &lumped::modes::Mode) -> f64 {
    let mut motion: Motion12 = model.motion().unwrap();
    let omega = TAU * mode.frequency_hz;
    let s = nalgebra::Complex::new(mode.growth, omega);
    let (q, v) = (mode.shape.map(|x| x.re), mode.shape.map(|x| (s * x).re));
    let size = q.amax();
    let mut state = State::new(0.0, q / size, v / size);
    let period = 1.0 / mode.frequency_hz;
    let mut integrator =
        Integrator::new(Scheme::DormandPrince, StepControl::Fixed(period / 400.0), DVector::from_element(12, 1.0));
    let cycles = (3.0 / (mode.growth * period)).ceil();
    let mut peaks = [0.0f64; 2];
    integrator
        .advance(&mut motion, &mut state, cycles * period, |_, seen| {
            let x = seen.state.q.rows(0, 2).norm();
            if seen.state.time < period {
                peaks[0] = peaks[0].max(x);
            } else if seen.state.time > (cycles - 1.0) * period {
                peaks[1] = peaks[1].max(x);
            }
        })
        .unwrap();
    (peaks[1] / peaks[0]).ln() / ((cycles - 1.0) * period)
}

/// Nonsense is an error with the quantity's name, never a panic.
#[test]
fn nonsense_is_refused() {
    let broken = |change: &dyn Fn(&mut Lumped12)| {
        let mut model = seed_003(30.25, Sense::Ccw, 0.1);
        change(&mut model);
        model.motion().map(|_| ()).unwrap_err()
    };
    let all: [(&str, LumpedError); 5] = [
        ("support stiffness", broken(&|m| m.supports[1].stiffness[4] = -1.0)),
        ("Rayleigh coefficient b", broken(&|m| m.rayleigh[1] = f64::NAN)),
        ("base radius", broken(&|m| m.pair.base_radii[0] = 0.0)),
        ("transverse inertia", broken(&|m| m.pair.bodies[0].transverse_inertia = -1.0)),
        ("working pressure angle", broken(&|m| m.pair.frame.pressure_angle = 2.0)),
    ];
    for (quantity, error) in all {
        assert!(error.to_string().starts_with(quantity), "{error}");
    }
    let model = seed_003(30.25, Sense::Ccw, 0.0);
    assert!(Lumped12::new(model.pair.clone(), model.supports, -0.1, [1.0, 2.0]).is_err());
    assert!(model.motion().unwrap().quasi_static(0.0).is_some());
}
