//! A mass on a spring with clearance, shaken: the simplest pair that loses contact.
//!
//! ```text
//! x'' + 2 zeta x' + max(x, 0) = 1 + A cos(w t)
//! ```
//! In units of the natural frequency and of the deflection under the mean load.

use std::convert::Infallible;

use integrate::{Forces, Integrator, Mechanism, Scheme, State, StepControl};
use nalgebra::{DMatrix, DVector, dvector};

use crate::EnvelopeError;

const DAMPING_RATIO: f64 = 0.05;
const AMPLITUDE: f64 = 0.4;
/// Periods until the motion has settled, and that are looked at.
const SETTLE: usize = 80;
const SEEN: usize = 4;

struct Oscillator {
    mass: DMatrix<f64>,
    damping_ratio: f64,
    amplitude: f64,
    /// Frequency of the shaking over the natural one; and its phase at time 0.
    speed: f64,
}

impl Mechanism for Oscillator {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let load = 1.0 + self.amplitude * (self.speed * t).cos();
        let damper = 2.0 * self.damping_ratio * v[0];
        out.conservative[0] = -q[0].max(0.0);
        out.other[0] = load - damper;
        out.stiffness[(0, 0)] = if q[0] > 0.0 { 1.0 } else { 0.0 };
        out.damping[(0, 0)] = 2.0 * self.damping_ratio;
        (out.supplied, out.dissipated) = (load * v[0], damper * v[0]);
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.5 * q[0].max(0.0).powi(2))
    }
}

/// The oscillator at one speed after the other.
pub(crate) struct Clearance {
    scheme: Scheme,
    x: f64,
    v: f64,
}

impl Clearance {
    /// Under its mean load.
    pub fn at_rest(scheme: Scheme) -> Self {
        Self { scheme, x: 1.0, v: 0.0 }
    }

    /// Settled peak to peak at a speed, `steps` a period of the shaking; the next speed begins where this one ends.
    ///
    /// # Errors
    /// [`EnvelopeError::Piece`] where a step has no solution.
    pub fn peak_to_peak(&mut self, speed: f64, steps: usize) -> Result<f64, EnvelopeError> {
        let period = std::f64::consts::TAU / speed;
        let mut system =
            Oscillator { mass: DMatrix::identity(1, 1), damping_ratio: DAMPING_RATIO, amplitude: AMPLITUDE, speed };
        let mut state = State::new(0.0, dvector![self.x], dvector![self.v]);
        let control = StepControl::Fixed(period / steps as f64);
        let mut integrator = Integrator::new(self.scheme, control, dvector![1.0]);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let seen_from = SETTLE as f64 * period;
        integrator
            .advance(&mut system, &mut state, (SETTLE + SEEN) as f64 * period, |_, seen| {
                if seen.state.time > seen_from {
                    (low, high) = (low.min(seen.state.q[0]), high.max(seen.state.q[0]));
                }
            })
            .map_err(EnvelopeError::of("oscillator with clearance"))?;
        (self.x, self.v) = (state.q[0], state.v[0]);
        Ok(high - low)
    }
}

/// Energy that a million steps of a free undamped vibration with separation make or lose, over what it had.
///
/// # Errors
/// [`EnvelopeError::Piece`] where a step has no solution.
pub(crate) fn drift_of(scheme: Scheme) -> Result<f64, EnvelopeError> {
    let mut system = Oscillator { mass: DMatrix::identity(1, 1), damping_ratio: 0.0, amplitude: 0.0, speed: 1.0 };
    let energy = |s: &State| 0.5 * s.v[0] * s.v[0] + 0.5 * s.q[0].max(0.0).powi(2) - s.q[0];
    let mut state = State::new(0.0, dvector![4.0], dvector![0.0]);
    let (before, step) = (energy(&state), 0.1);
    let mut integrator = Integrator::new(scheme, StepControl::Fixed(step), dvector![1.0]);
    integrator
        .advance(&mut system, &mut state, 1e6 * step, |_, _| ())
        .map_err(EnvelopeError::of("oscillator with clearance"))?;
    Ok((energy(&state) / before - 1.0).abs())
}
