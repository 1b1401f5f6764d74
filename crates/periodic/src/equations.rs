//! Interface of the equations of a periodic motion to what solves them and follows their solutions.

use nalgebra::{DMatrix, DVector};

use crate::{Floquet, FourierSeries, PeriodicError, series::Basis};

/// What is left of the equations of a periodic motion, with forces' tangents over a period. Theory (69).
///
/// ```text
/// R(c) = w^2 M c'' - P f(t, q, w q'),   w = 2 pi / T
/// ```
/// f is evaluated at N equal phases and projected (P) onto the harmonics (alternating frequency and time; Cameron and
/// Griffin, J. Appl. Mech. 56, 1989). Rows are multiplied by the scale of their coordinate, and unknowns divided by it,
/// so that all are energies.
#[derive(Debug, Clone)]
pub struct Balance {
    /// n x (2 H + 1), scaled.
    pub residual: DMatrix<f64>,
    /// Size of the terms that balance.
    pub size: f64,
    /// Motion that the harmonics leave out, over the vibration.
    pub tail: f64,
    /// P f: harmonics of the forces, n x (2 H + 1).
    pub forces: DMatrix<f64>,
    /// -df/dq and -df/dv at each phase; empty where they were not asked for.
    pub stiffness: Vec<DMatrix<f64>>,
    pub damping: Vec<DMatrix<f64>>,
}

/// Equations of the harmonics of periodic motions over one parameter: those of all coordinates of a
/// [`crate::PeriodicFamily`], or those of few of them, the others eliminated ([`crate::Condensed`]).
pub trait PeriodicEquations {
    /// Error of an evaluation of forces.
    type Error;

    /// Sets the parameter.
    ///
    /// # Errors
    /// The system's own, for values that it cannot have.
    fn set_parameter(&mut self, value: f64) -> Result<(), Self::Error>;

    /// Period, s, with the parameter as it is.
    fn period(&self) -> f64;

    /// What counts as a large motion of each coordinate, > 0.
    fn scale(&self) -> DVector<f64>;

    /// A direction of the coordinates along which no force acts.
    fn free_direction(&self) -> Option<DVector<f64>> {
        None
    }

    /// What is left of the equations at a motion.
    ///
    /// # Errors
    /// The system's own.
    fn balance(
        &mut self,
        parameter: f64,
        motion: &FourierSeries,
        basis: &Basis,
        tangents: bool,
    ) -> Result<Balance, PeriodicError<Self::Error>>;

    /// dR/dc, scaled: (harmonic, coordinate) by (harmonic, coordinate), harmonics outermost.
    fn jacobian(&self, basis: &Basis, at: &Balance) -> DMatrix<f64>;

    /// dw/dp, where the parameter moves the system through the frequency w = 2 pi / T alone. `None`: dR/dp is to be taken
    /// by a difference.
    fn frequency_slope(&self) -> Option<f64>;

    /// dR/dw at fixed harmonics, scaled.
    ///
    /// # Errors
    /// The system's own.
    fn frequency_derivative(
        &mut self,
        parameter: f64,
        motion: &FourierSeries,
        basis: &Basis,
        at: &Balance,
    ) -> Result<DMatrix<f64>, PeriodicError<Self::Error>>;

    /// Growth of disturbances of a motion over a period. `None` where they have no equation.
    fn floquet(&self, basis: &Basis, at: &Balance) -> Option<Floquet>;
}
