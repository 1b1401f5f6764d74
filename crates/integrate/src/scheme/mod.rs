//! The integration methods by name, and the lengths of their steps. A method is a file in this folder with a `Stepper`,
//! and a line in [`Scheme`] and in `with_stepper`.

mod energy;
mod generalised_alpha;
mod runge_kutta;
mod steady;

use energy::DiscreteGradient;
use generalised_alpha::Coefficients;
use runge_kutta::{CLASSICAL, DORMAND_PRINCE};
pub use steady::SteadySteps;

use crate::{
    Mechanism,
    stepper::{Step, Stepped, Stepper},
};

/// Integration method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scheme {
    /// Generalised-alpha method with a given spectral radius at infinite frequency, 0 .. 1.
    GeneralisedAlpha {
        /// rho at infinite frequency: 1 keeps all high frequencies, 0 removes them in one step.
        rho: f64,
    },
    /// Newmark's method with constant average acceleration.
    Newmark,
    /// Implicit midpoint rule with a discrete gradient, which conserves energy to round-off.
    Energy,
    /// Dormand-Prince 5(4) method, explicit.
    DormandPrince,
    /// Classical Runge-Kutta method of fourth order, explicit.
    RungeKutta4,
}

/// The stepper of a scheme: the one place where a scheme becomes a method.
macro_rules! with_stepper {
    ($scheme:expr, $stepper:ident => $then:expr) => {
        match $scheme {
            Scheme::GeneralisedAlpha { rho } => {
                let $stepper = Coefficients::generalised_alpha(*rho);
                $then
            }
            Scheme::Newmark => {
                let $stepper = Coefficients::newmark(0.25, 0.5);
                $then
            }
            Scheme::Energy => {
                let $stepper = DiscreteGradient;
                $then
            }
            Scheme::DormandPrince => {
                let $stepper = &DORMAND_PRINCE;
                $then
            }
            Scheme::RungeKutta4 => {
                let $stepper = &CLASSICAL;
                $then
            }
        }
    };
}

impl Scheme {
    /// Whether every motion grows without bounds if steps exceed a stability limit.
    pub fn is_explicit(&self) -> bool {
        self.stability_polynomial().is_some()
    }

    /// Coefficients of the stability polynomial, ascending; `None` for implicit methods, which are stable with any
    /// step.
    pub(crate) fn stability_polynomial(&self) -> Option<Vec<f64>> {
        with_stepper!(self, stepper => stepper.stability_polynomial())
    }

    /// Whether the method carries an acceleration of its own from step to step, which is then part of the state in
    /// addition to coordinates and velocities.
    pub fn carries_acceleration(&self) -> bool {
        with_stepper!(self, stepper => stepper.carries_acceleration())
    }

    /// The local error that a step reports falls as its length to this power.
    pub(crate) fn error_order(&self) -> f64 {
        with_stepper!(self, stepper => stepper.error_order())
    }

    pub(crate) fn step<M: Mechanism>(&self, step: Step<'_, M>) -> Stepped<M> {
        with_stepper!(self, stepper => stepper.step(step))
    }
}

/// Control of the step length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepControl {
    /// Steps of this constant length.
    Fixed(f64),
    /// Steps whose local error stays below `tolerance` times the scale of the coordinates.
    Adaptive {
        /// Tolerance for the local error, relative to the scale.
        tolerance: f64,
        /// First step.
        first: f64,
        /// Least permitted step; a shorter one is an error.
        least: f64,
        /// Longest step.
        largest: f64,
    },
}

impl StepControl {
    /// Steps of length `longest` (s) or, with a tolerance, steps by local error, at most that long and at least a
    /// ten-millionth of it.
    pub fn new(tolerance: Option<f64>, longest: f64) -> Self {
        match tolerance {
            None => Self::Fixed(longest),
            Some(tolerance) => {
                Self::Adaptive { tolerance, first: 0.1 * longest, least: 1e-7 * longest, largest: longest }
            }
        }
    }
}
