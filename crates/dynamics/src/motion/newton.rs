//! Newton's method on one implicit step.

use nalgebra::{DMatrix, DVector, Dyn, LU};

/// Iterations before giving up; two or three do.
pub(super) const ITERATIONS: usize = 40;
/// Last change that is round-off, relative to the motion's scale.
const TOLERANCE: f64 = 1e-11;
/// Iterations after which steps are shortened: a contact that opens and closes in turns settles between.
const PATIENCE: usize = 10;

/// Solves S x = r; `None` when S is singular or holds no numbers.
pub(super) fn solve(s: DMatrix<f64>, r: &DVector<f64>) -> Option<DVector<f64>> {
    LU::<f64, Dyn, Dyn>::new(s).solve(r).filter(|x| x.iter().all(|x| x.is_finite()))
}

/// Share of the full step to go at this iteration.
pub(super) fn damping(iteration: usize) -> f64 {
    if iteration < PATIENCE { 1.0 } else { 0.5 }
}

/// Changes up to this many times round-off that do not fall any more are the noise of the forces themselves.
const NOISE: f64 = 1e4;

/// Whether the iteration is over: by the last change, or because changes are noise. Forces from a contact solver are good to some 1e-11.
pub(super) fn settled(change: f64, before: f64) -> bool {
    change <= 1.0 || (change <= NOISE && change > 0.5 * before)
}

/// Largest change of a coordinate over what is round-off for it; done at 1 or below.
pub(super) fn change(step: &DVector<f64>, q: &DVector<f64>, scale: &DVector<f64>) -> f64 {
    let one = |i: usize| step[i].abs() / (TOLERANCE * scale[i]).max(8.0 * f64::EPSILON * q[i].abs());
    (0..q.len()).map(one).fold(0.0, f64::max)
}
