//! Interface between a system and the integrators.

use nalgebra::{DMatrix, DVector};

/// A mechanical system in generalised coordinates q with a constant mass matrix.
///
/// Any consistent units; ale-gear uses mm, rad, t, s, N, N mm.
pub trait Mechanism {
    /// Error of an evaluation of forces.
    type Error;

    /// Mass matrix M, n x n, symmetric positive definite.
    fn mass(&self) -> &DMatrix<f64>;

    /// Generalised forces at a state, and their exact tangents if `out.tangents` requests them.
    ///
    /// # Errors
    /// The error of the system.
    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Self::Error>;

    /// Potential energy V(t, q) of the conservative forces.
    ///
    /// # Errors
    /// The error of the system.
    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Self::Error>;

    /// Potential energy at a position off the path of the motion, used only for the ledger. The system need not keep
    /// anything of this evaluation, and twelve correct digits are sufficient.
    ///
    /// # Errors
    /// The error of the system.
    fn potential_off_path(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Self::Error> {
        self.potential(t, q)
    }

    /// Number of event functions. Their sign changes are events: contact gained (from below) or lost. By default there
    /// are none.
    fn events(&self) -> usize {
        0
    }

    /// Values of the event functions.
    ///
    /// # Errors
    /// The error of the system.
    fn event_values(
        &mut self,
        _t: f64,
        _q: &DVector<f64>,
        _v: &DVector<f64>,
        _out: &mut [f64],
    ) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Called when a step has been accepted: the place for a tooth change, which must not change q, v and forces.
    ///
    /// # Errors
    /// The error of the system.
    fn accepted(&mut self, _t: f64, _q: &DVector<f64>, _v: &DVector<f64>) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Discards the memory of earlier positions, so that results depend only on the position, to the last bit. Not
    /// needed for a system whose forces are formulas.
    fn forget(&mut self) {}

    /// Called when a cycle of the motion between two times (s) is complete, for sums over cycles.
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
    /// Conservative forces -dV/dq.
    pub conservative: DVector<f64>,
    /// All other forces: dampers, friction, drives and loads.
    pub other: DVector<f64>,
    /// Stiffness -df/dq, n x n.
    pub stiffness: DMatrix<f64>,
    /// Damping -df/dv, n x n.
    pub damping: DMatrix<f64>,
    /// Whether the tangents are requested.
    pub tangents: bool,
    /// Whether [`Forces::parametric`] is requested.
    pub rates: bool,
    /// Power that drives and loads supply to the system.
    pub supplied: f64,
    /// Explicit change of the potential with time at fixed coordinates, dV/dt, if [`Forces::rates`] requests it; never
    /// together with tangents.
    pub parametric: f64,
    /// Power dissipated by dampers and friction.
    pub dissipated: f64,
}

impl Forces {
    /// Zero forces on `n` coordinates.
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

    /// Sets everything to zero except the requests.
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

    /// Total force f on coordinate `i`.
    pub fn total(&self, i: usize) -> f64 {
        self.conservative[i] + self.other[i]
    }
}
