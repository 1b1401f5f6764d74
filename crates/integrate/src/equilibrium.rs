//! Where a mechanism stands still under its forces, and where it moves on as that place does.

use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::{Forces, Mechanism, State};

const ITERATIONS: usize = 60;
/// Last change that is round-off, relative to the largest coordinate of the solution.
const TOLERANCE: f64 = 1e-13;
/// Changes up to here that do not fall any more are round-off of the forces.
const NOISE: f64 = 1e-9;
/// Steps along lines before giving up.
const LINES: usize = 300;
/// Places that are looked at along a line.
const PLACES: usize = 80;
/// Share of the work rate at the beginning of a line that may be left at its end.
const LEFT: f64 = 0.3;
/// Farther than so many times its scale no coordinate goes on a line: what moves so far has nothing to rest on.
const FAR: f64 = 100.0;

/// Coordinates at which all forces vanish at time `t` with everything at rest, those in `held` kept as they are in
/// `start`.
///
/// Newton's method with the exact tangents first: one step where the forces are linear, one more for every contact that
/// opens or closes. Where that does not settle, because nothing touches at the start or forces grow with a power of the
/// overlap, it goes along lines: the direction is that of Newton's method with mass added to the stiffness, so much
/// that the work of the forces along it is positive, and on the line it goes to where that work ends. Every line then
/// lowers the energy of all forces that have one, and it is found where flanks meet.
///
/// `scale`: what counts as a large motion of each coordinate, > 0. `None` where neither settles: a coordinate that
/// nothing holds, or clearance all around.
///
/// # Errors
/// The system's own.
pub fn equilibrium<M: Mechanism>(
    system: &mut M,
    t: f64,
    start: &DVector<f64>,
    held: &[usize],
    scale: &DVector<f64>,
) -> Result<Option<DVector<f64>>, M::Error> {
    let free: Vec<usize> = (0..start.len()).filter(|i| !held.contains(i)).collect();
    let mut search =
        Search { system, t, free, scale, rest: DVector::zeros(start.len()), forces: Forces::zeros(start.len()) };
    match search.newton(start.clone())? {
        Some(found) => Ok(Some(found)),
        None => {
            let near = search.along_lines(start.clone())?;
            near.map_or(Ok(None), |q| Ok(Some(search.newton(q.clone())?.unwrap_or(q))))
        }
    }
}

/// State at time `t` in which forces balance as the mechanism goes slowly through what is given with time; velocities are
/// the rates of this balance.
///
/// ```text
/// f(t, q, 0) = 0,   v = [q(t + dt) - q(t - dt)] / 2 dt
/// ```
/// Inertia of that slow motion is left out; in a fast motion the difference is a transient. `span`: dt, s; 0: nothing moves.
/// `balance` gives the coordinates at a time from near ones ([`equilibrium`]). Each is sought twice: what is remembered of places
/// on the way is known less well, so the search ends from its own end on with nothing remembered.
///
/// # Errors
/// Those of `balance`.
pub fn quasi_static<M: Mechanism, E>(
    system: &mut M,
    t: f64,
    span: f64,
    start: DVector<f64>,
    mut balance: impl FnMut(&mut M, f64, DVector<f64>) -> Result<DVector<f64>, E>,
) -> Result<State, E> {
    let mut settled = |system: &mut M, t: f64, from: DVector<f64>| {
        let near = balance(system, t, from)?;
        system.forget();
        balance(system, t, near)
    };
    let q = settled(system, t, start)?;
    let mut v = DVector::zeros(q.len());
    if span > 0.0 {
        let after = settled(system, t + span, q.clone())?;
        let before = settled(system, t - span, q.clone())?;
        v = (after - before) / (2.0 * span);
    }
    system.forget();
    Ok(State::new(t, q, v))
}

struct Search<'a, M> {
    system: &'a mut M,
    t: f64,
    free: Vec<usize>,
    scale: &'a DVector<f64>,
    rest: DVector<f64>,
    forces: Forces,
}

impl<M: Mechanism> Search<'_, M> {
    /// Forces on the free coordinates.
    fn force(&mut self, q: &DVector<f64>) -> Result<DVector<f64>, M::Error> {
        self.forces.clear();
        self.system.forces(self.t, q, &self.rest, &mut self.forces)?;
        Ok(DVector::from_fn(self.free.len(), |i, _| self.forces.total(self.free[i])))
    }

    /// The free coordinates' part of a matrix.
    fn part(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let free = &self.free;
        DMatrix::from_fn(free.len(), free.len(), |i, j| matrix[(free[i], free[j])])
    }

    /// Free coordinates moved by a share of a step.
    fn moved(&self, q: &DVector<f64>, step: &DVector<f64>, share: f64) -> DVector<f64> {
        let mut there = q.clone();
        self.free.iter().zip(step.iter()).for_each(|(&i, s)| there[i] += share * s);
        there
    }

    /// Whole Newton steps.
    fn newton(&mut self, mut q: DVector<f64>) -> Result<Option<DVector<f64>>, M::Error> {
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let force = self.force(&q)?;
            let Some(step) = solved(self.part(&self.forces.stiffness), &force) else { return Ok(None) };
            q = self.moved(&q, &step, 1.0);
            let change = step.amax() / q.amax().max(f64::MIN_POSITIVE);
            if change <= TOLERANCE || (change <= NOISE && change > 0.5 * last) {
                return Ok(Some(q));
            }
            last = change;
        }
        Ok(None)
    }

    /// Line after line, each to where the work along it ends.
    fn along_lines(&mut self, mut q: DVector<f64>) -> Result<Option<DVector<f64>>, M::Error> {
        let scale = DVector::from_fn(self.free.len(), |i, _| self.scale[self.free[i]]);
        let mass = self.part(&self.system.mass().clone());
        let mut added = 0.0;
        for _ in 0..LINES {
            let force = self.force(&q)?;
            let stiffness = self.part(&self.forces.stiffness);
            // The stiffness at which the forces would move coordinates by their scales, for a unit of mass.
            let unit = force.component_mul(&scale).norm() / scale.dot(&(&mass * &scale));
            if unit == 0.0 {
                return Ok(Some(q));
            }
            let (step, needed) = loop {
                let matrix = &stiffness + added * unit * &mass;
                // No farther than what counts as large: beyond it, tooth spaces away, others would touch.
                let downhill = |s: &DVector<f64>| s.dot(&force) > 0.0 && s.component_div(&scale).amax() <= 1.0;
                if let Some(step) = solved(matrix, &force).filter(downhill) {
                    break (step, added);
                }
                if added > 1e12 {
                    return Ok(None);
                }
                added = if added == 0.0 { 1e-9 } else { 10.0 * added };
            };
            added = if needed <= 1e-9 { 0.0 } else { 0.01 * needed };
            let Some(share) = self.end_of_line(&q, &step, step.dot(&force), &scale)? else { return Ok(None) };
            q = self.moved(&q, &step, share);
            let change = share * step.component_div(&scale).amax();
            if needed == 0.0 && change <= NOISE {
                return Ok(Some(q));
            }
        }
        Ok(None)
    }

    /// Share of a step after which little is left of the `work` rate at its beginning, > 0; `None` where it never ends.
    fn end_of_line(
        &mut self,
        q: &DVector<f64>,
        step: &DVector<f64>,
        work: f64,
        scale: &DVector<f64>,
    ) -> Result<Option<f64>, M::Error> {
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut share = 1.0;
        for _ in 0..PLACES {
            let there = self.moved(q, step, share);
            let left = step.dot(&self.force(&there)?) / work;
            if left.abs() <= LEFT {
                return Ok(Some(share));
            }
            if left > 0.0 {
                low = share
            } else {
                high = share
            }
            share = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * share };
            if share * step.component_div(scale).amax() > FAR {
                return Ok(None);
            }
            if high - low <= 1e-14 * high {
                break;
            }
        }
        // A jump of the forces: on the side where they still push.
        Ok(Some(if low > 0.0 { low } else { share }))
    }
}

/// A x = b, where that has a solution in numbers.
fn solved(matrix: DMatrix<f64>, right: &DVector<f64>) -> Option<DVector<f64>> {
    LU::<f64, Dyn, Dyn>::new(matrix).solve(right).filter(|x| x.iter().all(|x| x.is_finite()))
}
