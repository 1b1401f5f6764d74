//! Interface of an integration method: its properties, and one step.

use nalgebra::{Cholesky, DVector, Dyn};

use crate::{Forces, Ledger, Mechanism, MotionError, State, newton::Newton};

/// A step to be taken.
#[derive(Debug)]
pub(crate) struct Step<'a, M> {
    /// Mechanism that moves.
    pub system: &'a mut M,
    /// Factor of its mass matrix.
    pub mass: &'a Cholesky<f64, Dyn>,
    /// State at the beginning.
    pub from: &'a State,
    /// Length of the step, s.
    pub h: f64,
    /// What counts as a large motion of each coordinate.
    pub scale: &'a DVector<f64>,
    /// Forces of the last evaluation: at the end of the step, unless the method says otherwise.
    pub forces: &'a mut Forces,
    /// State at the end, which the step finds.
    pub to: &'a mut State,
    /// Energy up to the beginning; the step enters its work and the potential energy at its end.
    pub ledger: &'a mut Ledger,
    /// Vectors of its own.
    pub work: &'a mut StepWork,
    /// Whether `forces` must hold the tangents at the end of the step.
    pub tangents: bool,
}

/// Whether a step was found.
pub(crate) type Stepped<M> = Result<(), MotionError<<M as Mechanism>::Error>>;

/// What steps write into, kept from one to the next: a small system's steps would spend half of their time on memory.
#[derive(Debug, Clone)]
pub(crate) struct StepWork {
    /// Local error of the coordinates of the last step.
    pub error: DVector<f64>,
    /// Newton iteration of the last step.
    pub newton: Newton,
    /// Accelerations that an implicit step begins with.
    pub begun: DVector<f64>,
    /// Residual of the balance of forces of the last step.
    pub rest: DVector<f64>,
    /// Way of the coordinates in a step, the velocity of it, and what a method makes of either.
    pub moved: [DVector<f64>; 4],
}

impl StepWork {
    /// Allocates work vectors for `n` coordinates.
    pub fn new(n: usize) -> Self {
        let zeros = || DVector::zeros(n);
        Self { error: zeros(), newton: Newton::new(n), begun: zeros(), rest: zeros(), moved: [(); 4].map(|()| zeros()) }
    }
}

/// A method of integration.
///
/// A new one is a file with this trait, and a row in `scheme.rs`.
pub(crate) trait Stepper {
    /// The local error that a step reports falls as its length to this power.
    fn error_order(&self) -> f64;

    /// Whether [`State::averaged`] is a state of its own that goes from step to step.
    fn carries_acceleration(&self) -> bool {
        false
    }

    /// Coefficients of the stability polynomial, ascending; `None` for implicit methods, which are stable with any
    /// step.
    fn stability_polynomial(&self) -> Option<Vec<f64>> {
        None
    }

    /// Takes a step.
    ///
    /// # Errors
    /// [`MotionError::NotConverged`] where an implicit method finds no solution, and the system's own.
    fn step<M: Mechanism>(&self, step: Step<'_, M>) -> Stepped<M>;
}
