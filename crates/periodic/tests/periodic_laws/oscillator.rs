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
