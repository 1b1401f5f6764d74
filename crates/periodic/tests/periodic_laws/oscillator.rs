//! A driven mass on a spring with clearance, and what becomes of it in time.

use std::{convert::Infallible, f64::consts::TAU};

use integrate::{Forces, Integrator, Mechanism, Scheme, State, StepControl};
use nalgebra::{DMatrix, DVector, dvector};
use periodic::{FourierSeries, PeriodicFamily};

/// What the parameter of the family is.
#[derive(Clone, Copy)]
pub enum Varied {
    Frequency,
    Parametric,
}

/// x'' + 2 zeta x' + k(t) f(x) = F_m + F_ah W^2 cos W t, k = 1 + parametric cos W t, f the dead zone of half-width b.
#[derive(Clone)]
pub struct Oscillator {
    pub mass: DMatrix<f64>,
    pub zeta: f64,
    pub half_width: f64,
    pub mean: f64,
    pub amplitude: f64,
    pub parametric: f64,
    pub frequency: f64,
    /// Periods of the excitation in one of the motion.
    pub cycles: f64,
    pub varied: Varied,
}

impl Oscillator {
    pub fn new(zeta: f64, half_width: f64, mean: f64, amplitude: f64) -> Self {
        let (mass, varied) = (DMatrix::identity(1, 1), Varied::Frequency);
        Self { mass, zeta, half_width, mean, amplitude, parametric: 0.0, frequency: 1.0, cycles: 1.0, varied }
    }

    fn stiffness(&self, t: f64) -> f64 {
        1.0 + self.parametric * (self.frequency * t).cos()
    }

    fn beyond(&self, x: f64) -> f64 {
        x.signum() * (x.abs() - self.half_width).max(0.0)
    }

    pub fn at_rest(&self) -> FourierSeries {
        FourierSeries::at_rest(&dvector![self.half_width + self.mean], 4)
    }

    /// Where a period leads from a state, and the least and largest coordinate on the way, by Runge and Kutta's method.
    fn over_a_period(&self, start: [f64; 2]) -> ([f64; 2], [f64; 2]) {
        let period = self.period();
        let mut system = self.clone();
        let mut integrator = Integrator::new(Scheme::RungeKutta4, StepControl::Fixed(period / 2000.0), dvector![1.0]);
        let mut state = State::new(0.0, dvector![start[0]], dvector![start[1]]);
        let mut extent = [start[0]; 2];
        let seen = |_: &mut Self, now: integrate::Progress<'_>| {
            let x = now.state.q[0];
            extent = [extent[0].min(x), extent[1].max(x)];
        };
        integrator
            .advance(&mut system, &mut state, period, seen)
            .unwrap_or_else(|e| panic!("W {}: {e}", self.frequency));
        ([state.q[0], state.v[0]], extent)
    }

    /// The periodic motion near a state by shooting, dP/dx by differences: its peak to peak, and the size of its largest
    /// multiplier.
    pub fn shot(&self, start: [f64; 2]) -> [f64; 2] {
        const STEP: f64 = 1e-6;
        let mut here = start;
        for _ in 0..12 {
            let (end, extent) = self.over_a_period(here);
            let [a, b] = [0, 1].map(|k| {
                let mut beside = here;
                beside[k] += STEP;
                let there = self.over_a_period(beside).0;
                [0, 1].map(|i| (there[i] - end[i]) / STEP)
            });
            let off = [end[0] - here[0], end[1] - here[1]];
            if off[0].abs().max(off[1].abs()) < 1e-10 {
                let (half, det) = (0.5 * (a[0] + b[1]), a[0] * b[1] - a[1] * b[0]);
                let root = half * half - det;
                let largest = if root >= 0.0 { half.abs() + root.sqrt() } else { det.sqrt() };
                return [extent[1] - extent[0], largest];
            }
            // (1 - dP/dx) dx = P(x) - x.
            let det = (1.0 - a[0]) * (1.0 - b[1]) - a[1] * b[0];
            here[0] += ((1.0 - b[1]) * off[0] + b[0] * off[1]) / det;
            here[1] += (a[1] * off[0] + (1.0 - a[0]) * off[1]) / det;
        }
        panic!("W {}: shooting ends at {here:?}", self.frequency);
    }

    /// Peak to peak in the last of many periods from a state on, integrated in time.
    pub fn waited(&self, start: [f64; 2], cycles: usize) -> f64 {
        let period = self.period();
        let mut system = self.clone();
        let mut integrator = Integrator::new(Scheme::RungeKutta4, StepControl::Fixed(period / 800.0), dvector![1.0]);
        let mut state = State::new(0.0, dvector![start[0]], dvector![start[1]]);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let from = (cycles as f64 - 1.0) * period;
        let seen = |now: &State| now.time > from;
        integrator
            .advance(&mut system, &mut state, cycles as f64 * period, |_, now| {
                if seen(now.state) {
                    (low, high) = (low.min(now.state.q[0]), high.max(now.state.q[0]));
                }
            })
            .unwrap_or_else(|e| panic!("W {}: {e}", self.frequency));
        high - low
    }
}

impl Mechanism for Oscillator {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let (k, x) = (self.stiffness(t), self.beyond(q[0]));
        let drive = self.mean + self.amplitude * self.frequency.powi(2) * (self.frequency * t).cos();
        out.conservative[0] = -k * x;
        out.other[0] = drive - 2.0 * self.zeta * v[0];
        out.stiffness[(0, 0)] = if x == 0.0 && self.half_width > 0.0 { 0.0 } else { k };
        out.damping[(0, 0)] = 2.0 * self.zeta;
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.5 * self.stiffness(t) * self.beyond(q[0]).powi(2))
    }
}

impl PeriodicFamily for Oscillator {
    fn set_parameter(&mut self, value: f64) -> Result<(), Infallible> {
        match self.varied {
            Varied::Frequency => self.frequency = value,
            Varied::Parametric => self.parametric = value,
        }
        Ok(())
    }

    fn period(&self) -> f64 {
        self.cycles * TAU / self.frequency
    }

    fn scale(&self) -> DVector<f64> {
        dvector![1.0]
    }
}
