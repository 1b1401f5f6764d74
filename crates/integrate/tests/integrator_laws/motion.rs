//! Laws of the integrators, and the clearance oscillator of the reference cases.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::{PI, TAU};

use integrate::{Direction, Forces, Integrator, Mechanism, Scheme, State, StepControl};
use nalgebra::{DMatrix, DVector, dvector};

/// x'' + 2 zeta x' + k(tau) f(x) = F_m + F_ah W^2 cos(W tau), f the dead zone of half-width 1, k = 1 + parametric cos(W
/// tau).
#[derive(Clone)]
struct Oscillator {
    mass: DMatrix<f64>,
    zeta: f64,
    mean: f64,
    amplitude: f64,
    parametric: f64,
    frequency: f64,
}

impl Oscillator {
    fn new(zeta: f64, mean: f64, amplitude: f64, parametric: f64, frequency: f64) -> Self {
        Self { mass: DMatrix::identity(1, 1), zeta, mean, amplitude, parametric, frequency }
    }

    /// k and dk/dtau.
    fn stiffness(&self, t: f64) -> [f64; 2] {
        let phase = self.frequency * t;
        [1.0 + self.parametric * phase.cos(), -self.parametric * self.frequency * phase.sin()]
    }
}

/// What is beyond the dead zone.
fn beyond(x: f64) -> f64 {
    x.signum() * (x.abs() - 1.0).max(0.0)
}

impl Mechanism for Oscillator {
    type Error = std::convert::Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Self::Error> {
        let ([k, rate], x) = (self.stiffness(t), beyond(q[0]));
        let drive = self.mean + self.amplitude * self.frequency.powi(2) * (self.frequency * t).cos();
        out.conservative[0] = -k * x;
        out.other[0] = drive - 2.0 * self.zeta * v[0];
        out.stiffness[(0, 0)] = if x == 0.0 { 0.0 } else { k };
        out.damping[(0, 0)] = 2.0 * self.zeta;
        out.supplied = drive * v[0];
        out.parametric = 0.5 * rate * x * x;
        out.dissipated = 2.0 * self.zeta * v[0] * v[0];
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Self::Error> {
        Ok(0.5 * self.stiffness(t)[0] * beyond(q[0]).powi(2))
    }

    fn events(&self) -> usize {
        1
    }

    fn event_values(&mut self, _: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), Self::Error> {
        out[0] = q[0] - 1.0;
        Ok(())
    }
}

const PER_CYCLE: f64 = 64.0;

/// Peak to peak of the last cycles of `cycles` at frequency `w`, from `state` on, which goes along; time starts anew at
/// each frequency.
fn peak_to_peak(of: &Oscillator, scheme: Scheme, w: f64, state: &mut State, cycles: usize) -> f64 {
    let mut system = Oscillator { frequency: w, ..of.clone() };
    let period = TAU / w;
    let mut integrator = Integrator::new(scheme, StepControl::Fixed(period / PER_CYCLE), dvector![1.0]);
    *state = State::new(0.0, state.q.clone(), state.v.clone());
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let from = (cycles as f64 - 8.0) * period;
    integrator
        .advance(&mut system, state, cycles as f64 * period, |_, seen| {
            if seen.state.time > from {
                (low, high) = (low.min(seen.state.q[0]), high.max(seen.state.q[0]));
            }
        })
        .unwrap_or_else(|e| panic!("W {w}: {e}"));
    high - low
}

fn at_rest(of: &Oscillator) -> State {
    State::new(0.0, dvector![1.0 + of.mean], dvector![0.0])
}

/// Peak to peak over W going up and going down.
fn sweeps(of: &Oscillator, scheme: Scheme, all: &[f64]) -> [Vec<f64>; 2] {
    let mut state = at_rest(of);
    let up: Vec<f64> = all.iter().map(|&w| peak_to_peak(of, scheme, w, &mut state, 300)).collect();
    let mut down: Vec<f64> = all.iter().rev().map(|&w| peak_to_peak(of, scheme, w, &mut state, 300)).collect();
    down.reverse();
    [up, down]
}

/// First and last W with two answers.
fn band(all: &[f64], [up, down]: &[Vec<f64>; 2]) -> [f64; 2] {
    let two: Vec<f64> = (0..all.len()).filter(|&i| (down[i] / up[i] - 1.0).abs() > 0.02).map(|i| all[i]).collect();
    [two[0], two[two.len() - 1]]
}

/// Reference: RK4, 400 steps a cycle, 400 cycles; both branches, both jumps, within one step of W.
#[test]
fn clearance_oscillator_jumps_where_it_must() {
    let of = Oscillator::new(0.05, 0.1, 0.05, 0.0, 1.0);
    let all: Vec<f64> = (50..=100).map(|i| 0.01 * f64::from(i)).collect();
    for scheme in [Scheme::Energy, Scheme::GeneralisedAlpha { rho: 0.9 }] {
        let both = sweeps(&of, scheme, &all);
        let [first, last] = band(&all, &both);
        let at = |sweep: usize, w: f64| both[sweep][((w - 0.5) * 100.0).round() as usize];
        let largest = [0, 1].map(|i: usize| both[i].iter().copied().fold(0.0, f64::max));
        println!(
            "{scheme:?}: two answers {first:.2} .. {last:.2}; largest {:.4} up, {:.4} down; {:.4} at 0.5, {:.4} / {:.4} at 0.75, {:.4} at 1",
            largest[0],
            largest[1],
            at(0, 0.5),
            at(0, 0.75),
            at(1, 0.75),
            at(0, 1.0)
        );
        assert!((first - 0.71).abs() < 0.011 && (last - 0.82).abs() < 0.011, "{scheme:?}: {first} .. {last}");
        let wanted = [(at(0, 0.5), 0.0333), (at(0, 0.75), 0.1267), (at(1, 0.75), 0.6367), (at(0, 1.0), 0.3740)];
        for (found, wanted) in wanted.into_iter().chain([(largest[0], 0.534), (largest[1], 0.669)]) {
            assert!((found / wanted - 1.0).abs() < 0.015, "{scheme:?}: {found}, not {wanted}");
        }
    }
}

/// The oscillator with a stiffness that varies instead of a force.
#[test]
fn parametric_clearance_oscillator() {
    let of = Oscillator::new(0.02, 0.1, 0.0, 0.1, 1.0);
    let all: Vec<f64> = (76..=100).map(|i| 0.01 * f64::from(i)).collect();
    let both = sweeps(&of, Scheme::Energy, &all);
    let [first, last] = band(&all, &both);
    let at = |sweep: usize, w: f64| both[sweep][((w - 0.76) * 100.0).round() as usize];
    println!(
        "two answers {first:.2} .. {last:.2}; {:.4} / {:.4} at 0.85, {:.4} at 1",
        at(0, 0.85),
        at(1, 0.85),
        at(0, 1.0)
    );
    assert!((first - 0.79).abs() < 0.011 && (last - 0.95).abs() < 0.011, "{first} .. {last}");
    for (found, wanted) in [(at(0, 0.85), 0.0725), (at(1, 0.85), 0.4171), (at(0, 1.0), 0.2460)] {
        assert!((found / wanted - 1.0).abs() < 0.015, "{found}, not {wanted}");
    }
}

/// Free vibration about the loaded equilibrium, undamped, so large that contact is lost in every cycle: a million
/// steps.
#[test]
fn energy_of_free_vibration_does_not_drift() {
    let mut system = Oscillator::new(0.0, 0.1, 0.0, 0.0, 0.0);
    let steps = 1_000_000;
    let h = TAU / 50.0;
    let mut state = State::new(0.0, dvector![2.0], dvector![0.0]);
    let mut integrator = Integrator::new(Scheme::Energy, StepControl::Fixed(h), dvector![1.0]);
    let (mut worst, mut separated) = (0.0f64, 0usize);
    integrator
        .advance(&mut system, &mut state, f64::from(steps) * h, |_, seen| {
            worst = worst.max(seen.ledger.residual().abs());
            separated += usize::from(seen.state.q[0] < 1.0);
        })
        .unwrap();
    let initial = 0.5;
    println!("{steps} steps, {separated} of them apart: energy drifts by {:.2e} of the vibration's", worst / initial);
    assert!(separated > 10_000 && worst < 1e-6 * initial, "{worst:e}");
}

/// A pendulum with a turning moment: smooth, not linear.
struct Pendulum(DMatrix<f64>);

impl Mechanism for Pendulum {
    type Error = std::convert::Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.0
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Self::Error> {
        out.conservative[0] = -q[0].sin();
        out.other[0] = 0.3 * (1.3 * t).cos() - 0.1 * v[0];
        out.stiffness[(0, 0)] = q[0].cos();
        out.damping[(0, 0)] = 0.1;
        out.supplied = 0.3 * (1.3 * t).cos() * v[0];
        out.dissipated = 0.1 * v[0] * v[0];
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Self::Error> {
        Ok(1.0 - q[0].cos())
    }
}

/// Angle at the end, energy that does not close, steps.
fn pendulum(scheme: Scheme, control: StepControl) -> (f64, f64, u64) {
    let mut integrator = Integrator::new(scheme, control, dvector![1.0]);
    let mut state = State::new(0.0, dvector![1.0], dvector![0.0]);
    integrator.advance(&mut Pendulum(DMatrix::identity(1, 1)), &mut state, 10.0, |_, _| ()).unwrap();
    (state.q[0], integrator.ledger().unwrap().residual(), integrator.steps()[0])
}

const SCHEMES: [(Scheme, f64); 6] = [
    (Scheme::Energy, 2.0),
    (Scheme::Newmark, 2.0),
    (Scheme::GeneralisedAlpha { rho: 1.0 }, 2.0),
    (Scheme::GeneralisedAlpha { rho: 0.6 }, 2.0),
    (Scheme::DormandPrince, 5.0),
    (Scheme::RungeKutta4, 4.0),
];

/// Order of convergence; energy closes to the same order, and to round-off where that is promised.
#[test]
fn orders_are_those_of_the_methods() {
    let (exact, _, _) = pendulum(Scheme::DormandPrince, StepControl::Fixed(0.001));
    for (scheme, order) in SCHEMES {
        let steps = [0.1, 0.05, 0.025];
        let all = steps.map(|h| pendulum(scheme, StepControl::Fixed(h)));
        let errors = all.map(|a| (a.0 - exact).abs());
        let observed = (errors[1] / errors[2]).log2();
        println!("{scheme:?}: errors {errors:?}, order {observed:.2}; energy open by {:?}", all.map(|a| a.1));
        assert!((observed - order).abs() < 0.35, "{scheme:?}: order {observed}");
        if scheme == Scheme::Energy {
            assert!(all.iter().all(|a| a.1.abs() < 1e-10), "{all:?}");
        } else {
            assert!(all[2].1.abs() < 0.3 * all[1].1.abs().max(1e-13), "{scheme:?}: {all:?}");
        }
    }
}

/// A spring that stiffens as a Hertzian contact does, F = x |x|^(1/2), beside a constant one.
struct Stiffening(DMatrix<f64>, f64);

impl Mechanism for Stiffening {
    type Error = std::convert::Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.0
    }

    fn forces(&mut self, _: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut Forces) -> Result<(), Self::Error> {
        let root = q[0].abs().sqrt();
        out.conservative[0] = -q[0] * (self.1 * root + 1.0);
        if out.tangents {
            out.stiffness[(0, 0)] = 1.5 * self.1 * root + 1.0;
        }
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Self::Error> {
        Ok(self.1 * q[0].abs().powf(2.5) / 2.5 + 0.5 * q[0] * q[0])
    }
}

/// Largest |q| over a thousand steps of length `h` from q = 1, and steps taken in parts.
fn thousand_steps(hertz: f64, scheme: Scheme, h: f64, keeping: bool) -> (f64, u64) {
    let mut integrator = Integrator::new(scheme, StepControl::Fixed(h), dvector![1.0]);
    if keeping {
        integrator = integrator.keeping_stable();
    }
    let mut state = State::new(0.0, dvector![1.0], dvector![0.0]);
    let mut largest = 0.0f64;
    let mut system = Stiffening(DMatrix::identity(1, 1), hertz);
    integrator
        .advance(&mut system, &mut state, 1000.0 * h, |_, seen| largest = largest.max(seen.state.q[0].abs()))
        .unwrap_or_else(|e| panic!("{scheme:?}, h = {h}: {e}"));
    (largest, integrator.steps()[1])
}

/// x'' + x = 0 at 0.9 and 1.1 of the limit that the stability polynomial says: bounded and without bounds; watched, the
/// longer steps are parted and bounded too.
#[test]
fn explicit_methods_are_stable_up_to_their_limit() {
    let one = DMatrix::identity(1, 1);
    for scheme in [Scheme::RungeKutta4, Scheme::DormandPrince] {
        let limit = scheme.step_limit(&one, &one, &DMatrix::zeros(1, 1)).unwrap().step;
        let [(within, _), (beyond, _)] = [0.9, 1.1].map(|share| thousand_steps(0.0, scheme, share * limit, false));
        println!("{scheme:?}: limit {limit:.4}; largest |q| {within:.3} at 0.9, {beyond:.3e} at 1.1 of it");
        // Dormand-Prince grows by 1e-4 a step just beyond its limit.
        assert!(within <= 1.0 && beyond > 1.05, "{scheme:?}: {within}, {beyond}");
        let [(within, none), (parted, all)] = [0.9, 1.1].map(|share| thousand_steps(0.0, scheme, share * limit, true));
        assert_eq!((none, all), (0, 1000), "{scheme:?}: steps in parts");
        assert!(within <= 1.0 && parted <= 1.0, "{scheme:?}: {within}, {parted}");
    }
}

/// A contact that stiffens on the way makes steps too long that were well within the limit at rest: those are parted,
/// and only those.
#[test]
fn steps_that_stiffening_makes_too_long_are_parted() {
    let one = DMatrix::identity(1, 1);
    let at_rest = Scheme::RungeKutta4.step_limit(&one, &one, &DMatrix::zeros(1, 1)).unwrap().step;
    let h = 0.5 * at_rest;
    let (free, _) = thousand_steps(40.0, Scheme::RungeKutta4, h, false);
    let (watched, parted) = thousand_steps(40.0, Scheme::RungeKutta4, h, true);
    println!("largest |q| {free:.2e} with steps as they are, {watched:.3} watched, {parted} of 1000 in parts");
    assert!(free.is_nan() || free > 10.0, "{free}");
    assert!(watched <= 1.1 && (100..1000).contains(&parted), "{watched}, {parted} in parts");
}

/// Error control: a tolerance a hundred times smaller, an error about as much smaller.
#[test]
fn error_control_controls_the_error() {
    let (exact, _, _) = pendulum(Scheme::DormandPrince, StepControl::Fixed(0.001));
    for (scheme, _) in SCHEMES {
        let run = |tolerance: f64| {
            let control = StepControl::Adaptive { tolerance, first: 1e-3, least: 1e-9, largest: 1.0 };
            let (q, _, steps) = pendulum(scheme, control);
            ((q - exact).abs(), steps)
        };
        let [(loose, few), (tight, many)] = [1e-5, 1e-7].map(run);
        println!("{scheme:?}: {loose:.1e} in {few} steps, {tight:.1e} in {many}");
        assert!(
            tight < (0.15 * loose).max(1e-5 * 0.3) && loose < 1e-2 && many > few,
            "{scheme:?}: {loose:e}, {tight:e}"
        );
    }
}

/// A body thrown at a wall: contact gained and lost where the closed form says, with steps that stop there.
#[test]
fn events_are_found() {
    // From 0 with v = 1 to the wall at 1, half a period of a sine of frequency 1 in it, and out again.
    let mut system = Oscillator::new(0.0, 0.0, 0.0, 0.0, 0.0);
    let mut state = State::new(0.0, dvector![0.0], dvector![1.0]);
    let control = StepControl::Fixed(0.01);
    let mut integrator = Integrator::new(Scheme::Energy, control, dvector![1.0]).stopping_at_events(true);
    let mut found = Vec::new();
    integrator.advance(&mut system, &mut state, 5.0, |_, seen| found.extend_from_slice(seen.crossings)).unwrap();
    let times: Vec<(f64, Direction)> = found.iter().map(|c| (c.time, c.direction)).collect();
    println!("{times:?}, wanted 1 and {}", 1.0 + PI);
    assert_eq!(times.len(), 2);
    assert!((times[0].0 - 1.0).abs() < 1e-9 && times[0].1 == Direction::Up);
    assert!((times[1].0 - 1.0 - PI).abs() < 1e-4 && times[1].1 == Direction::Down);
}

/// Cut short and gone on with: every bit the same.
#[test]
fn restart_is_the_same_to_the_last_bit() {
    for (scheme, _) in SCHEMES {
        for control in [
            StepControl::Fixed(0.01),
            StepControl::Adaptive { tolerance: 1e-6, first: 0.01, least: 1e-9, largest: 0.1 },
        ] {
            let mut system = Oscillator::new(0.02, 0.1, 0.05, 0.1, 0.8);
            let mut whole = at_rest(&system);
            let mut integrator = Integrator::new(scheme, control, dvector![1.0]);
            let mut at = Vec::new();
            let mut keep = |state: &State, ledger| at.push((state.clone(), ledger));
            integrator.advance(&mut system, &mut whole, 30.0, |_, seen| keep(seen.state, *seen.ledger)).unwrap();
            let (state, ledger) = &at[at.len() / 2];
            let text = serde_json::to_string(&(state, ledger)).unwrap();
            let (mut again, ledger): (State, _) = serde_json::from_str(&text).unwrap();
            let mut integrator = Integrator::new(scheme, control, dvector![1.0]).resumed(ledger);
            integrator.advance(&mut system, &mut again, 30.0, |_, _| ()).unwrap();
            assert_eq!(whole, again, "{scheme:?}, {control:?}");
            assert_eq!(integrator.ledger(), Some(&at[at.len() - 1].1), "{scheme:?}, {control:?}");
        }
    }
}

/// Steps that cannot be taken are errors.
#[test]
fn what_cannot_be_integrated_is_an_error() {
    let mut system = Oscillator::new(0.0, 0.1, 0.0, 0.0, 0.0);
    let run = |system: &mut Oscillator, scheme, control, scale: f64| {
        let mut state = at_rest(system);
        let mut integrator = Integrator::new(scheme, control, dvector![scale]);
        integrator.advance(system, &mut state, 1.0, |_, _| ()).map_err(|e| e.to_string())
    };
    let small = StepControl::Adaptive { tolerance: 1e-30, first: 0.1, least: 1e-3, largest: 1.0 };
    let mut thrown = Oscillator { frequency: 3.0, amplitude: 1.0, ..system.clone() };
    assert!(run(&mut thrown, Scheme::Energy, small, 1.0).unwrap_err().contains("is needed for the tolerance"));
    // A second of a motion whose period takes microseconds: 30,000 steps do not get on, and so it is said.
    let tiny = StepControl::Adaptive { tolerance: 1e-6, first: 1e-6, least: 1e-15, largest: 1.0 };
    let mut stiff = Oscillator { frequency: 3e6, amplitude: 1e6, ..system.clone() };
    stiff.mass[(0, 0)] = 1e-12;
    assert!(run(&mut stiff, Scheme::RungeKutta4, tiny, 1.0).unwrap_err().contains("bring the motion hardly on"));
    assert!(run(&mut system, Scheme::Energy, StepControl::Fixed(0.0), 1.0).unwrap_err().contains("positive"));
    assert!(run(&mut system, Scheme::Energy, StepControl::Fixed(0.1), f64::NAN).unwrap_err().contains("positive"));
    let rho = Scheme::GeneralisedAlpha { rho: 2.0 };
    assert!(run(&mut system, rho, StepControl::Fixed(0.1), 1.0).unwrap_err().contains("between 0 and 1"));
    system.mass[(0, 0)] = -1.0;
    assert!(run(&mut system, Scheme::Energy, StepControl::Fixed(0.1), 1.0).unwrap_err().contains("mass matrix"));
}

/// x'' = -100 sign(x) |x|^0.02 - x' + 3: all but a jump at the origin, which neither Newton's steps nor the way along
/// them hit where inertia does not hold them back.
struct Root(DMatrix<f64>);

impl Mechanism for Root {
    type Error = std::convert::Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.0
    }

    fn forces(&mut self, _: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Self::Error> {
        let x = q[0].abs().max(1e-12);
        out.conservative[0] = -100.0 * q[0].signum() * x.powf(0.02);
        out.other[0] = 3.0 - v[0];
        out.stiffness[(0, 0)] = 2.0 * x.powf(-0.98);
        out.damping[(0, 0)] = 1.0;
        (out.supplied, out.dissipated) = (3.0 * v[0], v[0] * v[0]);
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Self::Error> {
        Ok(100.0 / 1.02 * q[0].abs().powf(1.02))
    }
}

/// A step of given length without a solution is taken as its halves: the same bits as if they had been asked for, and
/// one step to the caller.
#[test]
fn a_step_without_a_solution_is_taken_in_halves() {
    let scheme = Scheme::Newmark;
    let run = |state: &mut State, steps: u32, h: f64| {
        let mut integrator = Integrator::new(scheme, StepControl::Fixed(h), dvector![1.0]);
        let (mut seen, until) = (0, state.time + f64::from(steps) * h);
        integrator.advance(&mut Root(DMatrix::identity(1, 1)), state, until, |_, _| seen += 1).map(|()| {
            let [_, refused] = integrator.steps();
            (seen, refused, integrator.ledger().copied())
        })
    };
    let h = 1.0 / 16.0;
    let (mut halved, mut begin) = (0, 0.0);
    while begin < 2.0 {
        let from = State::new(0.0, dvector![1.0 - begin], dvector![-3.0]);
        let (mut whole, mut parts) = (from.clone(), from.clone());
        let (seen, refused, book) = run(&mut whole, 1, h).unwrap_or_else(|e| panic!("from {}: {e}", from.q[0]));
        assert_eq!(seen, 1, "from {}: the caller sees one step", from.q[0]);
        if refused == 1 {
            halved += 1;
            let (_, again, own) = run(&mut parts, 2, 0.5 * h).unwrap_or_else(|e| panic!("halves: {e}"));
            assert_eq!(again, 0);
            assert_eq!((whole.q[0], whole.v[0], book), (parts.q[0], parts.v[0], own), "from {}", from.q[0]);
        }
        begin += 0.01;
    }
    println!("{halved} of 200 starts needed halves");
    assert!(halved > 0, "no start that needs halves: the test shows nothing");
}

/// x'' = -exp(x/s), s = 0.01: a wall whose force is no number a few lengths s beyond where it turns a body back.
struct Wall(DMatrix<f64>);

const STEEP: f64 = 0.01;

impl Mechanism for Wall {
    type Error = std::convert::Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.0
    }

    fn forces(&mut self, _: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut Forces) -> Result<(), Self::Error> {
        let force = (q[0] / STEEP).exp();
        out.conservative[0] = -force;
        out.stiffness[(0, 0)] = force / STEEP;
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Self::Error> {
        Ok(STEEP * (q[0] / STEEP).exp())
    }
}

/// A step that leads where forces are no numbers has no solution, and is taken in parts: the body comes back from the wall
/// with the energy that it had. It is no singular matrix.
#[test]
fn a_step_beyond_all_numbers_is_taken_in_parts() {
    for scheme in [Scheme::Energy, Scheme::Newmark, Scheme::GeneralisedAlpha { rho: 0.9 }] {
        let mut state = State::new(0.0, dvector![-1.0], dvector![30.0]);
        let mut integrator = Integrator::new(scheme, StepControl::Fixed(0.5), dvector![1.0]);
        let mut wall = Wall(DMatrix::identity(1, 1));
        integrator.advance(&mut wall, &mut state, 0.5, |_, _| ()).unwrap_or_else(|e| panic!("{scheme:?}: {e}"));
        let (v, [steps, refused]) = (state.v[0], integrator.steps());
        println!("{scheme:?}: back with {v:.3} at {:.3}; {refused} divisions", state.q[0]);
        assert!(steps == 1 && refused > 0 && v < 0.0, "{scheme:?}: {v} after {refused} divisions");
        assert!(scheme != Scheme::Energy || (v + 30.0).abs() < 1e-6, "{scheme:?}: comes back with {v}");
    }
}

/// A mass on a spring under a load that is ten thousand times what shakes it; `booked` of the load's work is in the ledger.
struct Loaded {
    mass: DMatrix<f64>,
    booked: f64,
}

impl Mechanism for Loaded {
    type Error = std::convert::Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Self::Error> {
        let load = 1e4 + (0.7 * t).cos();
        out.conservative[0] = -q[0];
        out.other[0] = load - 0.1 * v[0];
        out.stiffness[(0, 0)] = 1.0;
        out.damping[(0, 0)] = 0.1;
        out.supplied = self.booked * load * v[0];
        out.dissipated = 0.1 * v[0] * v[0];
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Self::Error> {
        Ok(0.5 * q[0] * q[0])
    }
}

/// Half of the work left out is seen however light the vibration is beside its load, and however long it lasts: what
/// steps make by themselves is measured by the energy that comes and goes. All of it booked, every method closes.
#[test]
fn a_ledger_off_by_half_is_seen_in_a_light_vibration() {
    let open = |booked: f64, scheme: Scheme, periods: f64| {
        let mut system = Loaded { mass: DMatrix::identity(1, 1), booked };
        let mut state = State::new(0.0, dvector![1e4], dvector![0.0]);
        let mut integrator = Integrator::new(scheme, StepControl::Fixed(TAU / 64.0), dvector![1e4]);
        integrator.advance(&mut system, &mut state, periods * TAU, |_, _| ()).unwrap();
        *integrator.ledger().unwrap()
    };
    for scheme in [Scheme::Energy, Scheme::Newmark, Scheme::RungeKutta4] {
        for periods in [3.0, 300.0] {
            let [whole, half] = [1.0, 0.5].map(|booked| open(booked, scheme, periods).open_over_vibration());
            println!("{scheme:?}, {periods} periods: open by {whole:.1e}; half of the work booked: {half:.2}");
            assert!(whole < 1e-3, "{scheme:?}: {whole:e} of the vibration is open");
            assert!(half > 0.3, "{scheme:?}: half of the work is missing, and the ledger is open by {half:e}");
        }
    }
    let mut lost = open(1.0, Scheme::Energy, 3.0);
    lost.open = f64::NAN;
    assert!(lost.open_over_vibration().is_nan());
    assert_eq!(integrate::Ledger::default().open_over_vibration(), 0.0);
}
