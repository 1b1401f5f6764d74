//! Newton's method for one implicit step.
//!
//! A line search is used if full steps do not converge because a contact opens and closes, or friction reverses,
//! alternately. It searches along the step for the point where the residual does no more work. So a sign change of
//! friction within a tenth of a mm/s is found between two steps that both jump over it, however short the time step is.
//!
//! The tangent is factored once and kept while the steps decrease fast. The error after such a step is its contraction
//! times the step, so two steps show when to stop. If steps decrease slowly because contact opens or closes, the
//! tangent is factored again.

use nalgebra::{DMatrix, DVector};

use crate::{Forces, MotionError, lu::LuFactor};

/// Iterations before giving up; two or three do.
pub(crate) const ITERATIONS: usize = 40;
/// Change that counts as round-off, relative to the motion's scale.
const TOLERANCE: f64 = 1e-11;
/// Iterations after which the line search begins.
const LINE_SEARCH_AFTER: usize = 10;
/// Share of the work at the beginning of a line that may be left at its end.
const LINE_TOLERANCE: f64 = 0.5;
/// Evaluations along a line.
const LINE_EVALUATIONS: u32 = 12;
/// Changes up to this many times round-off that no longer decrease are noise of the forces. Forces of a contact solver
/// are good to some 1e-11.
const NOISE_LEVEL: f64 = 1e4;
/// Largest ratio of two successive changes with which the tangent is kept.
const SLOW_CONTRACTION: f64 = 0.05;
/// Estimated remaining change that counts as converged, over round-off.
const REMAINDER: f64 = 0.5;

/// The iteration of one step.
#[derive(Debug, Clone)]
pub(crate) struct Newton {
    factor: LuFactor,
    /// Whether that is of a matrix of this step.
    is_made: bool,
    step: DVector<f64>,
    /// Largest change of a coordinate over what is round-off for it, of the last step and of the one before; infinite
    /// after a part of a step, which says nothing of what is left.
    changes: [f64; 2],
    /// Largest change of a coordinate over its round-off in the last step, also in a part of one.
    last: f64,
    /// The step that is being followed.
    line: Option<LineSearch>,
    /// Whether the last step is a part of one.
    part: bool,
}

/// A step on the way along its line: q = q_0 - share step.
#[derive(Debug, Clone)]
struct LineSearch {
    step: DVector<f64>,
    /// Work of the residual along the step where the line begins, > 0.
    work: f64,
    share: f64,
    /// Shares below which work is left, and beyond which it is against the step.
    bracket: [f64; 2],
    evaluations: u32,
}

impl LineSearch {
    /// Line along a step from the residual `rest` at its beginning; `None` where the step does not go against the
    /// residual.
    fn along(step: &DVector<f64>, rest: &DVector<f64>) -> Option<Self> {
        let work = rest.dot(step);
        (work > 0.0).then(|| Self {
            step: step.clone(),
            work,
            share: 1.0,
            bracket: [0.0, f64::INFINITY],
            evaluations: 0,
        })
    }

    /// What is to be taken away from the coordinates next, with the residual where they stand; `None` where the line
    /// ends.
    fn advance(&mut self, rest: &DVector<f64>) -> Option<DVector<f64>> {
        let left = rest.dot(&self.step) / self.work;
        self.bracket[usize::from(left < 0.0)] = self.share;
        let [low, high] = self.bracket;
        self.evaluations += 1;
        if left.abs() <= LINE_TOLERANCE || high.is_infinite() || left.is_nan() || self.evaluations > LINE_EVALUATIONS {
            return None;
        }
        let next = 0.5 * (low + high);
        let by = (next - self.share) * &self.step;
        self.share = next;
        Some(by)
    }
}

/// Why there is no next step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoStep {
    /// The matrix is singular.
    Singular,
    /// Coordinates, forces or tangents are no numbers any more: the iteration has led away from the solution.
    Lost {
        /// Iterations so far.
        iterations: usize,
    },
}

impl NoStep {
    /// The error of a step of length `h` that starts at a time (s), whose matrix is evaluated at the time `at`.
    pub fn error<E>(self, (time, h): (f64, f64), at: f64) -> MotionError<E> {
        match self {
            Self::Singular => MotionError::Singular { time: at, which: "iteration" },
            Self::Lost { iterations } => MotionError::NotConverged { time, step: h, iterations, change: f64::INFINITY },
        }
    }
}

impl Newton {
    /// Memory of the iteration for `n` coordinates.
    pub fn new(n: usize) -> Self {
        let changes = [f64::INFINITY; 2];
        Self {
            factor: LuFactor::new(n),
            is_made: false,
            step: DVector::zeros(n),
            changes,
            last: f64::INFINITY,
            line: None,
            part: false,
        }
    }

    /// Called before the first evaluation of a step.
    pub fn begin(&mut self, forces: &mut Forces) {
        (forces.tangents, forces.rates) = (true, false);
        (self.is_made, self.line, self.part) = (false, None, false);
        (self.changes, self.last) = ([f64::INFINITY; 2], f64::INFINITY);
    }

    /// Discards the factor, so that the next evaluation makes a new one.
    pub fn renew(&mut self) {
        self.is_made = false;
    }

    /// Prepares the forces for the next evaluation, with or without tangents.
    pub fn prepare(&mut self, forces: &mut Forces) {
        let [last, before] = self.changes;
        if self.line.is_some() || (before.is_finite() && last > SLOW_CONTRACTION * before) {
            self.is_made = false;
        }
        forces.tangents = !self.is_made;
        forces.clear();
    }

    /// The next step for the residual `rest`, to be subtracted from the coordinates. `matrix` assembles the matrix if
    /// its tangents are new.
    ///
    /// # Errors
    /// [`NoStep`] if there is no step.
    pub fn step(
        &mut self,
        forces: &Forces,
        matrix: impl FnOnce(&Forces, &mut DMatrix<f64>),
        rest: &DVector<f64>,
        iteration: usize,
    ) -> Result<&DVector<f64>, NoStep> {
        if let Some(by) = self.line.as_mut().and_then(|line| line.advance(rest)) {
            (self.step, self.part) = (by, true);
            return Ok(&self.step);
        }
        (self.line, self.part) = (None, false);
        if !self.is_made {
            self.factor.make(|own| matrix(forces, own));
            self.is_made = true;
        }
        self.step.copy_from(rest);
        if !self.factor.solve(&mut self.step) {
            return Err(NoStep::Singular);
        }
        if self.step.iter().any(|x| !x.is_finite()) {
            return Err(NoStep::Lost { iterations: iteration });
        }
        if iteration >= LINE_SEARCH_AFTER {
            self.line = LineSearch::along(&self.step, rest);
        }
        Ok(&self.step)
    }

    /// Measures the last step, which led to `q`.
    pub fn measure(&mut self, q: &DVector<f64>, scale: &DVector<f64>) {
        let one = |i: usize| self.step[i].abs() / (TOLERANCE * scale[i]).max(8.0 * f64::EPSILON * q[i].abs());
        self.last = (0..q.len()).map(one).fold(0.0, f64::max);
        self.changes = if self.part { [f64::INFINITY; 2] } else { [self.last, self.changes[0]] };
    }

    /// Largest change of a coordinate in the last step, relative to the round-off of the coordinate.
    pub fn change(&self) -> f64 {
        self.last
    }

    /// Whether the iteration is finished: by the last change, by the remaining error estimated from two changes, or
    /// because changes are noise.
    pub fn settled(&self) -> bool {
        let [last, before] = self.changes;
        let shrinks = before.is_finite() && last < 0.5 * before;
        last <= 1.0
            || (shrinks && last * last <= REMAINDER * (before - last))
            || (last <= NOISE_LEVEL && last > 0.5 * before)
    }
}
