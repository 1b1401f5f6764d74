//! Error of the integrators against their step, on the reduced pair itself.
#![allow(clippy::print_stdout, reason = "the table is what the test is for")]

use std::sync::OnceLock;

use fem::ElementOptions;
use gearbox::{GearboxError, motion::GearboxMechanism};
use integrate::{Integrator, MotionError, Scheme, State, StepControl};
use nalgebra::DVector;
use testing::{
    Case,
    moving::{MovingPair, machine, started},
};

const SCHEMES: [(&str, Scheme, f64); 5] = [
    ("generalised-alpha", Scheme::GeneralisedAlpha { rho: 0.8 }, 2.0),
    ("Newmark", Scheme::Newmark, 2.0),
    ("energy", Scheme::Energy, 2.0),
    ("Runge-Kutta 4", Scheme::RungeKutta4, 4.0),
    ("Dormand-Prince", Scheme::DormandPrince, 5.0),
];

/// Name, order in theory, errors (mm) and wall times (s) at each number of steps.
type Row = (&'static str, f64, Vec<f64>, Vec<f64>);

fn pair() -> &'static MovingPair {
    static PAIR: OnceLock<MovingPair> = OnceLock::new();
    PAIR.get_or_init(|| {
        let case = Case::read("coarse_hex8_pinion.msh", "coarse_hex8_wheel.msh", ElementOptions::default());
        let contact = case.slice_options().with_contact(|c| c.slices = 8);
        MovingPair::new(case, contact, 8)
    })
}

/// Lag at `places` evenly spaced times up to `until`, in `steps` steps.
fn course(
    mut system: GearboxMechanism,
    mut state: State,
    scheme: Scheme,
    until: f64,
    steps: usize,
    places: usize,
) -> Result<Vec<f64>, MotionError<GearboxError>> {
    let scale = DVector::from_element(1, pair().ste[0]);
    let mut integrator = Integrator::new(scheme, StepControl::Fixed(until / steps as f64), scale);
    let (mut all, mut done) = (Vec::new(), 0);
    integrator.advance(&mut system, &mut state, until, |_, seen| {
        done += 1;
        if done % (steps / places) == 0 {
            all.push(seen.state.q[0]);
        }
    })?;
    Ok(all)
}

/// Rows of the table: error (mm) at each number of steps, infinite where the method fails.
fn table(system: &dyn Fn() -> (GearboxMechanism, State), until: f64, counts: &[usize], finest: usize) -> Vec<Row> {
    let places = counts[0];
    let (mechanism, state) = system();
    let reference =
        course(mechanism, state, Scheme::RungeKutta4, until, finest, places).unwrap_or_else(|e| panic!("{e}"));
    SCHEMES
        .iter()
        .map(|&(name, scheme, order)| {
            let (mut errors, mut times) = (Vec::new(), Vec::new());
            for &steps in counts {
                let (mechanism, state) = system();
                let clock = std::time::Instant::now();
                let found = course(mechanism, state, scheme, until, steps, places);
                times.push(clock.elapsed().as_secs_f64());
                errors.push(match found {
                    Ok(found) => found.iter().zip(&reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max),
                    Err(error) => {
                        println!("{name}, {steps} steps: {error}");
                        f64::INFINITY
                    }
                });
            }
            (name, order, errors, times)
        })
        .collect()
}

fn show(counts: &[usize], rows: &[Row]) {
    println!("| steps | {} |", counts.iter().map(ToString::to_string).collect::<Vec<_>>().join(" | "));
    for (name, _, errors, times) in rows {
        let errors_text: Vec<String> = errors.iter().map(|e| format!("{e:.1e}")).collect();
        println!("| {name}: error, mm | {} |", errors_text.join(" | "));
        let orders: Vec<String> = errors.windows(2).map(|e| format!("{:.2}", (e[0] / e[1]).log2())).collect();
        println!("| order | | {} |", orders.join(" | "));
        let times: Vec<String> = times.iter().map(|t| format!("{:.1}", 1e3 * t)).collect();
        println!("| wall time, ms | {} |", times.join(" | "));
    }
}

/// Contact is known to the cell of a lattice of poses: what is below this, mm, is not the method's.
const FLOOR: f64 = 1e-11;

/// Where no slice comes or goes forces are smooth, and every method has the order of its theory: a swing of a third of
/// the transmission error with gears that stand still, large enough for the most accurate method at the finest steps to
/// stay above the floor.
#[test]
fn orders_are_those_of_theory_where_forces_are_smooth() {
    let pair = pair();
    let start = || {
        let system = machine(&pair.system(1e-9, |_| ()));
        let at = DVector::from_element(1, pair.ste[0] + 3e-3);
        (system, State::new(0.0, at, DVector::zeros(1)))
    };
    let counts = [16, 32, 64, 128];
    let rows = table(&start, 2.0 / pair.resonance_hz(), &counts, 1024);
    show(&counts, &rows);
    for (name, expected, errors, _) in rows {
        assert!(errors[3] > FLOOR, "{name}: {:.1e} mm at the finest steps says nothing of its order", errors[3]);
        let order = (errors[2] / errors[3]).log2();
        assert!((order - expected).abs() < 0.2, "{name}: order {order:.2}, not {expected}");
    }
}

/// A mesh cycle from quasi-static balance on, at `ratio` times the resonance.
fn turning(ratio: f64, counts: &[usize], finest: usize) -> Vec<Row> {
    let pair = pair();
    let frequency = ratio * pair.resonance_hz();
    let start = || started(&pair.system(frequency, |_| ()), 0.0);
    println!("f_m / f_0 = {ratio}");
    let rows = table(&start, 1.0 / frequency, counts, finest);
    show(counts, &rows);
    rows
}

/// Of a pair that turns, slices come and go: forces have kinks, and second order is what any method has in the end. At
/// a tenth of the resonance explicit methods need some 24 steps a mesh cycle to be stable; implicit ones are bounded
/// with eight.
#[test]
fn orders_of_a_pair_that_turns() {
    for (name, order, errors, _) in turning(0.1, &[8, 16, 32, 64, 128], 512) {
        if order == 2.0 {
            let found = (errors[3] / errors[4]).log2();
            assert!(found > 1.3, "{name}: order {found:.2}");
            assert!(errors.iter().all(|e| *e < 1e-3), "{name}: {errors:?}");
        } else {
            // Beyond the limit teeth are thrown off each other within the first cycle: off by more than they bend.
            let deflection = pair().ste[0];
            assert!(errors[0] > deflection && errors[1] > deflection, "{name} is not stable there: {errors:?}");
            assert!(errors[3] < 5e-5, "{name}: {errors:?}");
        }
    }
}

/// Largest and smallest lag (mm) in the last four of eight cycles at a tenth of the resonance, in `steps` steps a
/// cycle.
fn swing(scheme: Scheme, steps: usize) -> Result<[f64; 2], MotionError<GearboxError>> {
    let pair = pair();
    let frequency = 0.1 * pair.resonance_hz();
    let (mut system, mut state) = started(&pair.system(frequency, |_| ()), 0.0);
    let scale = DVector::from_element(1, pair.ste[0]);
    let control = StepControl::Fixed(1.0 / (frequency * steps as f64));
    let mut found = [f64::NEG_INFINITY, f64::INFINITY];
    Integrator::new(scheme, control, scale).advance(&mut system, &mut state, 8.0 / frequency, |_, seen| {
        if seen.state.time * frequency > 4.0 {
            let lag = seen.state.q[0];
            found = [found[0].max(lag), found[1].min(lag)];
        }
    })?;
    Ok(found)
}

/// The step up to which an explicit method is stable is computed, and the motion knows of it: with steps just below it
/// swings as it should, with steps an eighth beyond round-off has grown until teeth leave each other. From there on it
/// is thrown about, and how far within so many cycles is chance (1.5 times the limit: 0.06 to 0.9 mm in the first four
/// cycles).
#[test]
fn explicit_methods_hold_up_to_their_limit_and_no_farther() {
    let pair = pair();
    let frequency = 0.1 * pair.resonance_hz();
    let deflection = pair.ste[0];
    let system = pair.system(frequency, |_| ());
    let wanted = swing(Scheme::GeneralisedAlpha { rho: 0.8 }, 128).unwrap_or_else(|e| panic!("{e}"));
    for scheme in [Scheme::RungeKutta4, Scheme::DormandPrince] {
        let limit = system.machine().and_then(|mut machine| machine.stable_step(scheme));
        let limit = limit.unwrap_or_else(|e| panic!("{e}")).unwrap();
        let at_limit = 1.0 / (frequency * limit.step);
        let [below, beyond] = [(at_limit / 0.95).ceil(), (at_limit / 1.1).floor()].map(|n| {
            let found = swing(scheme, n as usize).unwrap_or_else(|e| {
                println!("{scheme:?}: {e}");
                [f64::INFINITY; 2]
            });
            let off = (0..2).map(|i| (found[i] - wanted[i]).abs()).fold(0.0, f64::max) / deflection;
            println!("{scheme:?}: {n} steps a cycle, {at_limit:.2} at the limit: off by {off:.3} of the deflection");
            off
        });
        assert!(below < 0.1, "{scheme:?} is off by {below:.3} of the deflection below its limit");
        assert!(beyond > 0.3, "{scheme:?} is off by {beyond:.3} of the deflection beyond its limit");
    }
}

/// The whole table.
#[test]
#[ignore = "half a minute"]
fn orders_down_to_the_smallest_steps() {
    for ratio in [0.1, 0.5] {
        turning(ratio, &[8, 16, 32, 64, 128, 256, 512], 2048);
    }
}
