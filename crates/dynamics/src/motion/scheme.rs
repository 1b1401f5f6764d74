//! Methods of integration, and the lengths of their steps.

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

impl Scheme {
    /// Whether steps beyond a limit of length let every motion grow without bounds.
    pub fn is_explicit(&self) -> bool {
        matches!(self, Self::DormandPrince | Self::RungeKutta4)
    }
}

/// How long steps are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepControl {
    /// Always this long.
    Fixed(f64),
    /// Such that the local error of a step stays below `tolerance` times the coordinates' scale.
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
