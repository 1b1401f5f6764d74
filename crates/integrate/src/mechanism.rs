//! Interface of a system to the integrators.

use nalgebra::{DMatrix, DVector};

/// A mechanical system in generalised coordinates q with a constant mass matrix.
///
/// Any consistent units; ale-gear's own are mm, rad, t, s, N, N mm.
pub trait Mechanism {
    /// Error of an evaluation of forces.
    type Error;

    /// Mass matrix M, n x n, symmetric positive definite.
    fn mass(&self) -> &DMatrix<f64>;

    /// Generalised forces at a state, and their exact tangents where `out.tangents` asks for them.
    ///
    /// # Errors
    /// The system's own.
    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Self::Error>;

    /// Potential energy V(t, q) of the conservative forces.
    ///
    /// # Errors
    /// The system's own.
    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Self::Error>;

    /// Potential energy at a place off the path of the motion, for the ledger alone. A system need not keep anything of
    /// that evaluation, and twelve correct digits are enough.
    ///
    /// # Errors
    /// The system's own.
    fn potential_off_path(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Self::Error> {
        self.potential(t, q)
    }

    /// Functions whose changes of sign are events: contact gained (from below) or lost. None unless a system has some.
    fn events(&self) -> usize {
        0
    }

    /// Values of the event functions.
    ///
    /// # Errors
    /// The system's own.
    fn event_values(
        &mut self,
        _t: f64,
        _q: &DVector<f64>,
        _v: &DVector<f64>,
        _out: &mut [f64],
    ) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Called when a step has been taken for good: the place for a tooth change, which must leave q, v and forces as
    /// they are.
    ///
    /// # Errors
    /// The system's own.
    fn accepted(&mut self, _t: f64, _q: &DVector<f64>, _v: &DVector<f64>) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Forgets what is remembered of earlier places, so that all answers depend on the place alone, to the last bit.
    /// Nothing to do for a system whose forces are formulas.
    fn forget(&mut self) {}

    /// Called when a cycle of the motion between two times (s) is complete: the place for sums over cycles.
    fn end_cycle(&mut self, _begin: f64, _end: f64) {}
}

impl<M: Mechanism> Mechanism for &mut M {
    type Error = M::Error;

    fn mass(&self) -> &DMatrix<f64> {
        (**self).mass()
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), M::Error> {
        (**self).forces(t, q, v, out)
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, M::Error> {
        (**self).potential(t, q)
    }

    fn potential_off_path(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, M::Error> {
        (**self).potential_off_path(t, q)
    }

    fn events(&self) -> usize {
        (**self).events()
    }

    fn event_values(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut [f64]) -> Result<(), M::Error> {
        (**self).event_values(t, q, v, out)
    }

    fn accepted(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<(), M::Error> {
        (**self).accepted(t, q, v)
    }

    fn forget(&mut self) {
        (**self).forget();
    }

    fn end_cycle(&mut self, begin: f64, end: f64) {
        (**self).end_cycle(begin, end);
    }
}

/// Generalised forces of a system of n coordinates at one state.
#[derive(Debug, Clone, PartialEq)]
pub struct Forces {
    /// -dV/dq, the part that has a potential.
    pub conservative: DVector<f64>,
    /// All the rest: dampers, friction, drives and loads.
    pub other: DVector<f64>,
    /// -df/dq, n x n.
    pub stiffness: DMatrix<f64>,
    /// -df/dv, n x n.
    pub damping: DMatrix<f64>,
    /// Whether the tangents are wanted.
    pub tangents: bool,
    /// Whether [`Forces::parametric`] is wanted.
    pub rates: bool,
    /// Power of drives and loads into the system.
    pub supplied: f64,
    /// Explicit change of the potential with time at fixed coordinates, dV/dt, where [`Forces::rates`] asks for it;
    /// never together with tangents.
    pub parametric: f64,
    /// Power that dampers and friction take.
    pub dissipated: f64,
}

impl Forces {
    /// No forces on `n` coordinates.
    pub fn zeros(n: usize) -> Self {
        Self {
            conservative: DVector::zeros(n),
            other: DVector::zeros(n),
            stiffness: DMatrix::zeros(n, n),
            damping: DMatrix::zeros(n, n),
            tangents: true,
            rates: false,
            supplied: 0.0,
            parametric: 0.0,
            dissipated: 0.0,
        }
    }

    /// All to zero but what is wanted.
    pub fn clear(&mut self) {
        // Of few numbers: an iterator of nalgebra takes longer than they do.
        self.conservative.as_mut_slice().fill(0.0);
        self.other.as_mut_slice().fill(0.0);
        self.stiffness.as_mut_slice().fill(0.0);
        self.damping.as_mut_slice().fill(0.0);
        (self.supplied, self.parametric, self.dissipated) = (0.0, 0.0, 0.0);
    }

    /// Powers supplied and dissipated.
    pub(crate) fn powers(&self) -> [f64; 2] {
        [self.supplied, self.dissipated]
    }

    /// f, coordinate `i`.
    pub fn total(&self, i: usize) -> f64 {
        self.conservative[i] + self.other[i]
    }
}
