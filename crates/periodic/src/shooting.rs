//! The periodic state without waiting: Newton's method on the map over a period, its derivative from the tangent flow.
//! Theory (49), (71).
//!
//! ```text
//! P(x) - x = 0,   (1 - dP/dx) dx = P(x) - x,   x = (q, v) at the start of a period
//! ```
//! P is the motion over a period, with coordinates that count in frames that turn on turned back.
//! A motion that settles already is taken to where it settles to. An answer is one only where it is near, so that of
//! several periodic motions it is the one that waiting leads to, and where disturbances of it fade.

use integrate::{Forces, Integrator, Ledger, Mechanism, MotionError, State};
use nalgebra::{DMatrix, DVector};

use crate::{FreeDirection, TangentFlow};

/// Newton steps before it is left to waiting; three or four do.
const STEPS: usize = 6;
/// Largest change of a coordinate, over the largest peak to peak, that is near.
const NEAR: f64 = 0.3;
/// Change of a Newton step over the one before, from which on it leads nowhere.
const SLOW: f64 = 0.5;
/// Part of the tolerance to which the state comes back: the cycles that follow are judged by all of it.
const OF_TOLERANCE: f64 = 0.1;
/// Singular values over the largest below which a direction is free: no turn of all gears is sought.
const FREE: f64 = 1e-9;

/// What a search for a periodic state takes beside the mechanism.
#[derive(Debug)]
pub struct Shooting<'a> {
    /// Length of a period, s.
    pub period: f64,
    /// Difference after a period, over the peak to peak, that is none.
    pub tolerance: f64,
    /// Sizes of the coordinates, > 0.
    pub scale: DVector<f64>,
    /// Angular frequency (rad/s) that makes sizes of velocities of them.
    pub frequency: f64,
    /// A direction that nothing holds: where a motion is along it says nothing of it.
    pub free: Option<&'a FreeDirection>,
    /// Map of the coordinates at the end of a period to those at its beginning which are the same motion, n x n orthogonal;
    /// `None`: they repeat themselves.
    pub back: Option<DMatrix<f64>>,
}

/// One period from a state on, in units of the coordinates' sizes and of velocities that belong to them.
struct Period {
    end: State,
    /// P(x) - x.
    rest: DVector<f64>,
    /// dP/dx.
    monodromy: DMatrix<f64>,
    /// Largest peak to peak of a coordinate or velocity.
    size: f64,
}

impl Shooting<'_> {
    /// The stable periodic state near `from`, at the same time; `None` where there is none near. `begin` puts what the
    /// mechanism is beside coordinates and velocities to where it is at the start of a period, before each of them, and
    /// gives the integrator that moves it; the search leaves the mechanism at the end of a period.
    ///
    /// # Errors
    /// [`MotionError`] of a step.
    pub fn near<M: Mechanism>(
        &self,
        mechanism: &mut M,
        from: &State,
        mut begin: impl FnMut(&mut M) -> Result<Integrator, M::Error>,
    ) -> Result<Option<State>, MotionError<M::Error>> {
        let n = from.q.len();
        let units =
            DVector::from_fn(2 * n, |i, _| if i < n { self.scale[i] } else { self.frequency * self.scale[i - n] });
        let mut here = from.clone();
        let mut before = f64::INFINITY;
        let mut gone = DVector::zeros(units.len());
        for _ in 0..STEPS {
            let time = from.time;
            let own = begin(mechanism).map_err(|source| MotionError::Mechanism { time, source })?;
            let Period { end, rest, monodromy, size } = self.over_period(mechanism, own, &here, &units)?;
            let off = rest.amax();
            if off <= OF_TOLERANCE * self.tolerance * size {
                return Ok(is_stable(monodromy).then_some(State { time: from.time, ..end }));
            }
            if off.is_nan() || off > SLOW * before {
                return Ok(None);
            }
            before = off;
            let map = DMatrix::identity(units.len(), units.len()) - monodromy;
            let svd = map.svd(true, true);
            let least = FREE * svd.singular_values.max();
            let Ok(step) = svd.solve(&rest, least) else { return Ok(None) };
            gone += &step;
            if gone.amax().is_nan() || gone.amax() > NEAR * size {
                return Ok(None);
            }
            let moved = units.component_mul(&step);
            // The integrator's own acceleration comes along with the motion.
            let (q, v) = (&here.q + moved.rows(0, n), &here.v + moved.rows(n, n));
            here = State { time: from.time, q, v, ..end };
        }
        Ok(None)
    }

    fn over_period<M: Mechanism>(
        &self,
        mechanism: &mut M,
        integrator: Integrator,
        from: &State,
        units: &DVector<f64>,
    ) -> Result<Period, MotionError<M::Error>> {
        let (n, mass) = (from.q.len(), mechanism.mass().clone());
        let unit = DMatrix::from_diagonal(units);
        let mut flow = TangentFlow { places: unit.rows(0, n).into_owned(), rates: unit.rows(n, n).into_owned() };
        let mut tangents = [Forces::zeros(n), Forces::zeros(n)];
        let at = |time: f64| move |source| MotionError::Mechanism { time, source };
        mechanism.forget();
        mechanism.forces(from.time, &from.q, &from.v, &mut tangents[0]).map_err(at(from.time))?;
        let mut state = from.clone();
        let mut extent = [stacked(&state, units), stacked(&state, units)];
        // Nobody asks for the energy of the search, and the state has all that a start would have to find.
        let mut integrator = integrator.resumed(Ledger::default());
        let (mut last, mut failure) = (from.time, None);
        integrator.advance(mechanism, &mut state, from.time + self.period, |mechanism, now| {
            let time = now.state.time;
            let mut step = || {
                let [here, next] = &mut tangents;
                next.clear();
                mechanism.forces(time, &now.state.q, &now.state.v, next).map_err(at(time))?;
                let places = [[&here.stiffness, &here.damping], [&next.stiffness, &next.damping]];
                let singular = MotionError::Singular { time, which: "tangent" };
                flow.step(&mass, places[0], places[1], time - last).ok_or(singular)
            };
            failure = failure.take().or_else(|| step().err());
            tangents.swap(0, 1);
            last = time;
            let place = stacked(now.state, units);
            extent[0].zip_apply(&place, |low, x| *low = low.min(x));
            extent[1].zip_apply(&place, |high, x| *high = high.max(x));
        })?;
        if let Some(failure) = failure {
            return Err(failure);
        }
        if let Some(back) = &self.back {
            for part in [&mut state.q, &mut state.v, &mut state.a, &mut state.averaged] {
                *part = back * &*part;
            }
            for part in [&mut flow.places, &mut flow.rates] {
                *part = back * &*part;
            }
        }
        // What a free turn has become says nothing of the motion.
        let mut rest =
            [&state.q - &from.q, &state.v - &from.v].map(|part| DMatrix::from_column_slice(n, 1, part.as_slice()));
        if let Some(free) = self.free {
            rest.iter_mut().for_each(|part| free.remove(part));
            [&mut flow.places, &mut flow.rates].into_iter().for_each(|part| free.remove(part));
        }
        let over = |i: usize, x: f64| x / units[i];
        let [places, rates] = &rest;
        Ok(Period {
            end: state,
            rest: DVector::from_fn(2 * n, |i, _| over(i, if i < n { places[i] } else { rates[i - n] })),
            monodromy: DMatrix::from_fn(2 * n, 2 * n, |i, j| {
                over(i, if i < n { flow.places[(i, j)] } else { flow.rates[(i - n, j)] })
            }),
            size: (&extent[1] - &extent[0]).amax(),
        })
    }
}

fn stacked(state: &State, units: &DVector<f64>) -> DVector<f64> {
    let n = state.q.len();
    DVector::from_fn(2 * n, |i, _| if i < n { state.q[i] } else { state.v[i - n] } / units[i])
}

/// Whether disturbances are known to fade; a free turn has been taken out and fades at once.
fn is_stable(monodromy: DMatrix<f64>) -> bool {
    integrate::eigenvalues(monodromy).is_some_and(|all| all.iter().all(|m| m.norm() < 1.0))
}
