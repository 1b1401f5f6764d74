//! Where a mechanism stands still under its forces.

use dynamics::motion::{Forces, Mechanism};
use nalgebra::{DMatrix, DVector, Dyn, LU};

const ITERATIONS: usize = 60;
/// Last change that is round-off, relative to the largest coordinate of the solution.
const TOLERANCE: f64 = 1e-13;
/// Changes up to here that do not fall any more are round-off of the forces.
const NOISE: f64 = 1e-9;

/// Coordinates at which all forces vanish at time `t` with everything at rest, those in `held` kept as they are in `start`.
///
/// Newton's method with the exact tangents: one step where the forces are linear, one more for every contact that opens or closes.
/// `None` when it does not settle: a coordinate that nothing holds, or clearance all around.
///
/// # Errors
/// The system's own.
pub fn equilibrium<M: Mechanism>(
    system: &mut M,
    t: f64,
    start: &DVector<f64>,
    held: &[usize],
) -> Result<Option<DVector<f64>>, M::Error> {
    let n = start.len();
    let free: Vec<usize> = (0..n).filter(|i| !held.contains(i)).collect();
    let (mut q, rest) = (start.clone(), DVector::zeros(n));
    let mut forces = Forces::zeros(n);
    let mut last = f64::INFINITY;
    for _ in 0..ITERATIONS {
        forces.clear();
        system.forces(t, &q, &rest, &mut forces)?;
        let tangent = DMatrix::from_fn(free.len(), free.len(), |i, j| forces.stiffness[(free[i], free[j])]);
        let force = DVector::from_fn(free.len(), |i, _| forces.total(free[i]));
        let Some(step) = LU::<f64, Dyn, Dyn>::new(tangent).solve(&force).filter(|x| x.iter().all(|x| x.is_finite()))
        else {
            return Ok(None);
        };
        for (k, &i) in free.iter().enumerate() {
            q[i] += step[k];
        }
        let change = step.amax() / q.amax().max(f64::MIN_POSITIVE);
        if change <= TOLERANCE || (change <= NOISE && change > 0.5 * last) {
            return Ok(Some(q));
        }
        last = change;
    }
    Ok(None)
}
