//! The methods of integration by name, and the lengths of their steps. A method is a file here that has a `Stepper`, and a line of
//! [`Scheme`] and of `with_stepper`.

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

/// Method of integration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scheme {
    /// Generalised-alpha with this spectral radius at infinite frequency, 0 .. 1.
    GeneralisedAlpha {
        /// rho at infinity: 1 keeps all high frequencies, 0 takes them away in one step.
        rho: f64,
    },
    /// Newmark's constant average acceleration.
    Newmark,
    /// Implicit midpoint with a discrete gradient: keeps energy to round-off.
    Energy,
    /// Dormand-Prince 5(4), explicit.
    DormandPrince,
    /// Runge-Kutta's classical method of fourth order, explicit.
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
    /// Whether steps beyond a limit of length let every motion grow without bounds.
    pub fn is_explicit(&self) -> bool {
        self.stability_polynomial().is_some()
    }

    /// Coefficients of the stability polynomial, ascending; `None` for implicit methods, which are stable with any
    /// step.
    pub(crate) fn stability_polynomial(&self) -> Option<Vec<f64>> {
        with_stepper!(self, stepper => stepper.stability_polynomial())
    }

    /// Whether the method carries an acceleration of its own from step to step: a part of the state beside coordinates
    /// and velocities.
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

/// Length of steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepControl {
    /// Always this long.
    Fixed(f64),
    /// Steps such that the local error of each stays below `tolerance` times the coordinates' scale.
    Adaptive {
        /// Local error over scale.
        tolerance: f64,
        /// First step.
        first: f64,
        /// A shorter step is an error.
        least: f64,
        /// Longest step.
        largest: f64,
    },
}

impl StepControl {
    /// Steps of length `longest` (s), or by a local error where one is allowed: then no longer than that, and no shorter
    /// than a ten-millionth of it.
    pub fn new(tolerance: Option<f64>, longest: f64) -> Self {
        match tolerance {
            None => Self::Fixed(longest),
            Some(tolerance) => {
                Self::Adaptive { tolerance, first: 0.1 * longest, least: 1e-7 * longest, largest: longest }
            }
        }
    }
}
