//! What the coefficients of each method promise, to the digits that a wrong coefficient changes: on linear oscillators,
//! where theory says all of it.

use std::convert::Infallible;
use std::f64::consts::{FRAC_PI_2, PI};

use integrate::{Direction, Forces, Integrator, Ledger, Mechanism, Scheme, State, StepControl};
use nalgebra::{DMatrix, DVector, Matrix3, dvector};

/// q'' + k(t) q = 0 for every coordinate, k(t) = k (1 + swing cos t); the event is q_0 = 0.
struct Linear {
    mass: DMatrix<f64>,
    stiffness: f64,
    swing: f64,
}

impl Linear {
    fn new(coordinates: usize, stiffness: f64, swing: f64) -> Self {
        Self { mass: DMatrix::identity(coordinates, coordinates), stiffness, swing }
    }

    fn at(&self, t: f64) -> f64 {
        self.stiffness * (1.0 + self.swing * t.cos())
    }
}

impl Mechanism for Linear {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let k = self.at(t);
        for i in 0..q.len() {
            out.conservative[i] = -k * q[i];
            out.stiffness[(i, i)] = k;
        }
        out.parametric = -0.5 * self.stiffness * self.swing * t.sin() * q.norm_squared();
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.5 * self.at(t) * q.norm_squared())
    }

    fn events(&self) -> usize {
        1
    }

    fn event_values(&mut self, _: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), Infallible> {
        out[0] = q[0];
        Ok(())
    }
}

/// What one step of length 1 does to (q, v, averaged acceleration) of q'' + x^2 q = 0: column by column.
fn amplification(scheme: Scheme, x: f64) -> Matrix3<f64> {
    let column = |i: usize| {
        let start = [0, 1, 2].map(|j| f64::from(u8::from(i == j)));
        let mut state = State::new(0.0, dvector![start[0]], dvector![start[1]]);
        (state.a, state.averaged, state.last_step) = (dvector![-x * x * start[0]], dvector![start[2]], 1.0);
        // With a ledger at hand the accelerations are taken as they are.
        let mut integrator = Integrator::new(scheme, StepControl::Fixed(1.0), dvector![1.0]).resumed(Ledger::default());
        integrator.advance(&mut Linear::new(1, x * x, 0.0), &mut state, 1.0, |_, _| ()).unwrap();
        [state.q[0], state.v[0], state.averaged[0]]
    };
    let columns = [column(0), column(1), column(2)];
    Matrix3::from_fn(|row, i| columns[i][row])
}

fn radius(scheme: Scheme, x: f64) -> f64 {
    amplification(scheme, x).complex_eigenvalues().iter().map(|l| l.norm()).fold(0.0, f64::max)
}

/// Chung and Hulbert's choice: the spectral radius at infinite frequency is the rho that was asked for, and no
/// frequency grows. There the roots coincide, and a root of multiplicity three feels 1e-8 of the matrix as 2e-3.
#[test]
fn generalised_alpha_damps_the_highest_frequency_as_asked() {
    for rho in [0.0, 0.3, 0.6, 0.8, 0.9, 1.0] {
        let scheme = Scheme::GeneralisedAlpha { rho };
        let found = radius(scheme, 1e4);
        assert!((found - rho).abs() < 5e-3, "rho {rho}: at w h = 1e4 the spectral radius is {found}");
        for x in [0.01, 0.1, 1.0, 3.0, 10.0, 100.0] {
            let found = radius(scheme, x);
            assert!(found < 1.0 + 1e-9 && found > rho - 5e-3, "rho {rho}: at w h = {x} the spectral radius is {found}");
        }
    }
}

/// Constant average acceleration neither damps nor drives, and is late by a known angle: tan(phi / 2) = w h / 2 a step.
/// So is generalised-alpha with rho = 1.
#[test]
fn newmark_keeps_amplitude_and_has_the_phase_of_the_trapezoidal_rule() {
    for scheme in [Scheme::Newmark, Scheme::GeneralisedAlpha { rho: 1.0 }] {
        for x in [0.1f64, 1.0, 5.0] {
            let eigenvalues = amplification(scheme, x).complex_eigenvalues();
            let physical = eigenvalues.iter().find(|l| l.im > 1e-9).unwrap_or_else(|| panic!("{scheme:?}: no swing"));
            let angle = 2.0 * (0.5 * x).atan();
            let (phase, norm) = (physical.arg(), physical.norm());
            assert!((norm - 1.0).abs() < 1e-9, "{scheme:?}, w h = {x}: {norm} of the amplitude is left");
            assert!((phase - angle).abs() < 1e-8, "{scheme:?}, w h = {x}: {phase} rad a step, not {angle}");
        }
    }
}

/// The estimate of a step's error is the leading term of theory, so steps are as long as it says: h = 0.9 (tolerance /
/// (C |q^(p)|))^(1/p).
///
/// C: the midpoint rule and Newmark 1/12, generalised-alpha |beta - 1/6|; Runge-Kutta's shared weight 1/120; Dormand
/// and Prince's pair 1/120 - 1097/120000 (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 1993,
/// II.5). Two coordinates in quadrature: the larger one of |cos|, |sin| counts. Ten per cent are what is left of higher
/// terms.
#[test]
fn steps_are_as_long_as_theory_says_of_their_error() {
    let rho = 0.6f64;
    let beta = (1.0 / (1.0 + rho)).powi(2);
    let cases = [
        (Scheme::Energy, 3.0, 1.0 / 12.0, 1e-7),
        (Scheme::Newmark, 3.0, 1.0 / 12.0, 1e-7),
        (Scheme::GeneralisedAlpha { rho }, 3.0, beta - 1.0 / 6.0, 1e-7),
        (Scheme::RungeKutta4, 4.0, 1.0 / 120.0, 1e-9),
        (Scheme::DormandPrince, 5.0, 97.0 / 120_000.0, 1e-10),
    ];
    for (scheme, power, constant, tolerance) in cases {
        let control = StepControl::Adaptive { tolerance, first: 1e-3, least: 1e-9, largest: 1.0 };
        let mut integrator = Integrator::new(scheme, control, dvector![1.0, 1.0]);
        let mut state = State::new(0.0, dvector![1.0, 0.0], dvector![0.0, 1.0]);
        integrator.advance(&mut Linear::new(2, 1.0, 0.0), &mut state, 4.0 * PI, |_, _| ()).unwrap();
        // Mean of max(|cos|, |sin|)^(1/p) over a turn.
        let mean = (0..400)
            .map(|i| FRAC_PI_2 * (f64::from(i) + 0.5) / 400.0)
            .map(|t| t.cos().max(t.sin()).powf(1.0 / power))
            .sum::<f64>()
            / 400.0;
        let wanted = 4.0 * PI * mean / (0.9 * (tolerance / constant).powf(1.0 / power));
        let taken = integrator.steps()[0] as f64;
        assert!((taken / wanted - 1.0).abs() < 0.1, "{scheme:?}: {taken} steps, by theory {wanted:.1}");
    }
}

/// Order two also with steps that change: the averaged acceleration belongs to a place within the step before, and is
/// moved.
#[test]
fn order_is_kept_where_steps_change() {
    for scheme in [Scheme::GeneralisedAlpha { rho: 0.0 }, Scheme::GeneralisedAlpha { rho: 0.6 }, Scheme::Newmark] {
        let error = |pairs: u32| {
            let h = 3.0 / f64::from(3 * pairs);
            let mut state = State::new(0.0, dvector![1.0], dvector![0.0]);
            let mut ledger: Option<Ledger> = None;
            for step in 0..2 * pairs {
                let h = if step % 2 == 0 { h } else { 2.0 * h };
                let integrator = Integrator::new(scheme, StepControl::Fixed(h), dvector![1.0]);
                let mut integrator = if let Some(l) = ledger { integrator.resumed(l) } else { integrator };
                let until = state.time + h;
                integrator.advance(&mut Linear::new(1, 1.0, 0.0), &mut state, until, |_, _| ()).unwrap();
                ledger = integrator.ledger().copied();
            }
            (state.q[0] - 3f64.cos()).abs()
        };
        let order = (error(64) / error(128)).log2();
        assert!((order - 2.0).abs() < 0.1, "{scheme:?}: order {order}");
    }
}

/// Zeros of a cosine: located to the fourth order of the step by the cubic through both ends and their slopes, h^4/384
/// of the motion.
#[test]
fn events_are_located_to_fourth_order() {
    let h = 0.05;
    let mut found = Vec::new();
    let mut state = State::new(0.0, dvector![1.0], dvector![0.0]);
    let mut integrator = Integrator::new(Scheme::RungeKutta4, StepControl::Fixed(h), dvector![1.0]);
    let mut system = Linear::new(1, 1.0, 0.0);
    integrator.advance(&mut system, &mut state, 10.0, |_, seen| found.extend_from_slice(seen.crossings)).unwrap();
    let wanted = [(0.5, Direction::Down), (1.5, Direction::Up), (2.5, Direction::Down)];
    assert_eq!(found.len(), wanted.len());
    for (crossing, (turns, direction)) in found.iter().zip(wanted) {
        let off = (crossing.time - turns * PI).abs();
        // Runge-Kutta's own phase is late by h^4/120 of the way.
        let allowed = h.powi(4) * (1.0 / 384.0 + turns * PI / 100.0);
        assert!(off < allowed && crossing.direction == direction, "{crossing:?}: {off:e} s off, allowed {allowed:e}");
    }
}

/// The ledger of a stiffness that varies closes to the order of the method, and turnover is the sum of all work either
/// way.
#[test]
fn parametric_work_is_booked_to_the_order_of_the_method() {
    for (scheme, order) in [
        (Scheme::Newmark, 2),
        (Scheme::GeneralisedAlpha { rho: 0.6 }, 2),
        (Scheme::RungeKutta4, 4),
        (Scheme::DormandPrince, 5),
    ] {
        let open = |h: f64| {
            let mut state = State::new(0.0, dvector![1.0], dvector![0.0]);
            let mut integrator = Integrator::new(scheme, StepControl::Fixed(h), dvector![1.0]);
            let (mut before, mut turned) = (0.0, 0.0f64);
            let mut system = Linear::new(1, 1.0, 0.3);
            integrator
                .advance(&mut system, &mut state, 10.0, |_, seen| {
                    turned += (seen.ledger.parametric - before).abs();
                    before = seen.ledger.parametric;
                })
                .unwrap();
            let ledger = integrator.ledger().unwrap();
            assert!(turned > 0.1 && (ledger.turnover / turned - 1.0).abs() < 1e-12, "{scheme:?}: {ledger:?}, {turned}");
            ledger.residual().abs()
        };
        let found = (open(0.1) / open(0.05)).log2();
        assert!(found > f64::from(order) - 0.4, "{scheme:?}: the ledger closes to order {found}");
    }
}

/// M q'' + grad V = 0 with V = |q|^4 / 4 - q_0 q_1^3 / 5: nothing about it is linear.
struct Quartic {
    mass: DMatrix<f64>,
}

impl Mechanism for Quartic {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, _: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let (x, y, r2) = (q[0], q[1], q.norm_squared());
        out.conservative += dvector![-r2 * x + 0.2 * y.powi(3), -r2 * y + 0.6 * x * y * y];
        let off = 2.0 * x * y - 0.6 * y * y;
        out.stiffness += DMatrix::from_row_slice(2, 2, &[r2 + 2.0 * x * x, off, off, r2 + 2.0 * y * y - 1.2 * x * y]);
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.25 * q.norm_squared().powi(2) - 0.2 * q[0] * q[1].powi(3))
    }
}

/// The discrete gradient does exactly the work that the potential says, also where a step is a quarter of a swing and
/// the force at its middle does a hundredth of it less: energy closes to round-off after every step. On a linear
/// oscillator, where that force is right by itself, no test would see it.
#[test]
fn the_energy_scheme_closes_its_ledger_where_forces_are_not_linear() {
    for h in [0.1, 0.5, 1.0] {
        let mut system = Quartic { mass: DMatrix::from_diagonal(&dvector![1.0, 2.5]) };
        let mut state = State::new(0.0, dvector![1.0, -0.4], dvector![0.3, 0.5]);
        let (mut open, mut uncorrected) = (0.0f64, 0.0f64);
        let mut last = state.clone();
        let mut integrator = Integrator::new(Scheme::Energy, StepControl::Fixed(h), dvector![1.0, 1.0]);
        integrator
            .advance(&mut system, &mut state, 40.0 * h, |system, seen| {
                open = open.max(seen.ledger.residual().abs());
                let middle = 0.5 * (&last.q + &seen.state.q);
                let mut forces = Forces::zeros(2);
                system.forces(0.0, &middle, &middle, &mut forces).unwrap();
                let risen = system.potential(0.0, &seen.state.q).unwrap() - system.potential(0.0, &last.q).unwrap();
                uncorrected = uncorrected.max((risen + forces.conservative.dot(&(&seen.state.q - &last.q))).abs());
                last = seen.state.clone();
            })
            .unwrap();
        assert!(uncorrected > 1e-5, "h = {h}: the middle's force is off by {uncorrected:e} of work, too little to see");
        assert!(
            open < 1e-10,
            "h = {h}: energy is open by {open:e}, the middle's force alone is off by {uncorrected:e}"
        );
    }
}

/// x'' + 2 zeta x' + x = cos(W t).
struct Shaken {
    mass: DMatrix<f64>,
    damping: f64,
    frequency: f64,
}

impl Mechanism for Shaken {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        out.conservative[0] = -q[0];
        out.stiffness[(0, 0)] = 1.0;
        out.damping[(0, 0)] = 2.0 * self.damping;
        out.other[0] = (self.frequency * t).cos() - out.damping[(0, 0)] * v[0];
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.5 * q[0] * q[0])
    }
}

/// The steady answer to a harmonic force has the amplitude that theory says of the steps: below, at and above resonance. That
/// of Dormand and Prince lies nearer to the exact one than what stands for it.
#[test]
fn steps_change_a_steady_answer_as_theory_says() {
    let damping = 0.08;
    for scheme in [
        Scheme::Energy,
        Scheme::Newmark,
        Scheme::GeneralisedAlpha { rho: 0.6 },
        Scheme::GeneralisedAlpha { rho: 0.0 },
        Scheme::RungeKutta4,
        Scheme::DormandPrince,
    ] {
        for ratio in [0.5f64, 0.95, 1.04, 1.6] {
            for steps in [12u32, 24] {
                let h = 2.0 * PI / (ratio * f64::from(steps));
                let mut integrator = Integrator::new(scheme, StepControl::Fixed(h), dvector![1.0]);
                let mut system = Shaken { mass: DMatrix::identity(1, 1), damping, frequency: ratio };
                let mut state = State::new(0.0, dvector![0.0], dvector![0.0]);
                // exp(-0.08 400) of the transient is left.
                let settled = (400.0 / h).ceil();
                let mut rows = Vec::new();
                for row in 0..settled as u32 + steps {
                    integrator.advance(&mut system, &mut state, f64::from(row + 1) * h, |_, _| ()).unwrap();
                    rows.push(state.q[0]);
                }
                let last = &rows[rows.len() - steps as usize..];
                let sum = |of: fn(f64) -> f64| -> f64 {
                    last.iter().enumerate().map(|(i, x)| x * of(2.0 * PI * i as f64 / f64::from(steps))).sum()
                };
                let amplitude = 2.0 / f64::from(steps) * sum(f64::cos).hypot(sum(f64::sin));
                let exact = 1.0 / (1.0 - ratio * ratio).hypot(2.0 * damping * ratio);
                let wanted = scheme.steady_gain(ratio * h, ratio, damping);
                let found = amplitude / exact;
                let allowed = if scheme == Scheme::DormandPrince { (wanted - 1.0).abs() + 1e-6 } else { 1e-6 };
                let of = if scheme == Scheme::DormandPrince { 1.0 } else { wanted };
                assert!(
                    (found - of).abs() < allowed,
                    "{scheme:?}, {ratio} of the resonance, {steps} steps a period: {found}, by theory {wanted}"
                );
            }
        }
    }
    assert!(Scheme::Energy.steady_gain(PI, 1.0, damping).is_infinite());
}
