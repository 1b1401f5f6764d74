//! Newton's method on one implicit step.
//!
//! The tangent is made once and kept as long as steps shrink fast with it: what such a step leaves is its own contraction times itself, so two steps tell when to stop. Where they do not
//! shrink fast, because contact opens or closes, tangents are made anew.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::Forces;

/// Iterations before giving up; two or three do.
pub(super) const ITERATIONS: usize = 40;
/// Last change that is round-off, relative to the motion's scale.
const TOLERANCE: f64 = 1e-11;
/// Iterations after which steps are shortened: a contact that opens and closes in turns settles between.
const PATIENCE: usize = 10;
/// Changes up to this many times round-off that do not fall any more are the noise of the forces themselves. Forces from a contact solver are good to some 1e-11.
const NOISE: f64 = 1e4;
/// What a step must leave of the one before it for the tangent to be kept.
const SLOW: f64 = 0.05;
/// What may be left to go, over round-off.
const LEFT: f64 = 0.5;

/// The iteration of one step.
#[derive(Debug)]
pub(super) struct Newton {
    factor: Option<LU<f64, Dyn, Dyn>>,
    step: DVector<f64>,
    /// Largest change of a coordinate over what is round-off for it, of the last step and of the one before.
    changes: [f64; 2],
}

impl Newton {
    pub fn new(forces: &mut Forces) -> Self {
        (forces.tangents, forces.rates) = (true, false);
        Self { factor: None, step: DVector::zeros(0), changes: [f64::INFINITY; 2] }
    }

    /// Has the tangent made anew at the next evaluation.
    pub fn renew(&mut self) {
        self.factor = None;
    }

    /// Makes forces ready for the next evaluation, with tangents or without.
    pub fn prepare(&mut self, forces: &mut Forces) {
        let [last, before] = self.changes;
        if before.is_finite() && last > SLOW * before {
            self.factor = None;
        }
        forces.tangents = self.factor.is_none();
        forces.clear();
    }

    /// The next step for the residual `rest`, to be taken away from the coordinates; `None` when the matrix, made where its tangents are new, is singular or holds no numbers.
    pub fn step(
        &mut self,
        forces: &Forces,
        matrix: impl FnOnce(&Forces) -> DMatrix<f64>,
        rest: &DVector<f64>,
        iteration: usize,
    ) -> Option<&DVector<f64>> {
        let factor = self.factor.get_or_insert_with(|| LU::new(matrix(forces)));
        self.step = factor.solve(rest).filter(|x| x.iter().all(|x| x.is_finite()))?;
        if iteration >= PATIENCE {
            self.step *= 0.5;
        }
        Some(&self.step)
    }

    /// Measures the last step, taken to `q`.
    pub fn measure(&mut self, q: &DVector<f64>, scale: &DVector<f64>) {
        let one = |i: usize| self.step[i].abs() / (TOLERANCE * scale[i]).max(8.0 * f64::EPSILON * q[i].abs());
        self.changes = [(0..q.len()).map(one).fold(0.0, f64::max), self.changes[0]];
    }

    /// Largest change of a coordinate by the last step over what is round-off for it.
    pub fn change(&self) -> f64 {
        self.changes[0]
    }

    /// Whether the iteration is over: by the last change, by what two of them say is left, or because changes are noise.
    pub fn settled(&self) -> bool {
        let [last, before] = self.changes;
        let shrinks = before.is_finite() && last < 0.5 * before;
        last <= 1.0 || (shrinks && last * last <= LEFT * (before - last)) || (last <= NOISE && last > 0.5 * before)
    }
}
