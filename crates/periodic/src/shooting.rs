//! Periodic motions without waiting: Newton's method on the map over a period. Theory (49), (71).
//!
//! ```text
//! P(x) - x = 0,   (1 - dP/dx) dx = P(x) - x,   x = (q, v) at the start of a period
//! ```
//! P is the motion over a period by its own integrator, with coordinates that count in frames that turn on turned back.
//! dP/dx is that of the tangent flow, with what P did in the steps before (C. G. Broyden, Math. Comp. 19 (1965) 577).
//!
//! A motion that settles already is taken to where it settles to ([`Shooting::near`]): an answer is one only where it is
//! near, so that of several periodic motions it is the one that waiting leads to, and where disturbances of it fade.
//! [`Shooting::from`] begins anywhere, and finds motions that waiting never does.

use integrate::{
    CycleTimes, Envelope, Forces, Ledger, Mechanism, Method, MotionError, Resumable, State, Timetable, difference,
};
use nalgebra::{DMatrix, DVector};

use crate::{FreeDirection, TangentFlow};

/// Singular values over the largest below which a direction is free: no turn of all gears is sought.
const FREE: f64 = 1e-9;

/// How far a search goes.
struct Reach {
    /// Newton steps at the most.
    steps: usize,
    /// Times a step is halved before it is taken as it is.
    halvings: usize,
    /// Largest change of a coordinate, over the largest peak to peak.
    way: f64,
    /// Residual of a step over the one before, from which on it leads nowhere.
    slow: f64,
}

/// To where a motion settles: three or four steps do.
const NEARBY: Reach = Reach { steps: 6, halvings: 0, way: 0.3, slow: 0.5 };
/// From anywhere.
const ANYWHERE: Reach = Reach { steps: 12, halvings: 5, way: f64::INFINITY, slow: f64::INFINITY };

/// What a search for a periodic state takes beside the mechanism.
#[derive(Debug)]
pub struct Shooting<'a> {
    /// Method of the motion; its scale has the sizes of the coordinates.
    pub method: Method,
    /// Cycles of a period, by times from its beginning on.
    pub cycles: Vec<CycleTimes>,
    /// Difference after a period, over the peak to peak, that is none.
    pub tolerance: f64,
    /// Angular frequency (rad/s) that makes sizes of velocities of those of coordinates.
    pub frequency: f64,
    /// A direction that nothing holds: where a motion is along it says nothing of it.
    pub free: Option<&'a FreeDirection>,
    /// Map of the coordinates at the end of a period to those at its beginning which are the same motion, n x n orthogonal;
    /// `None`: they repeat themselves.
    pub back: Option<DMatrix<f64>>,
}

/// Where a search ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// State at the beginning of a period; with a residual within the tolerance a Newton step beyond the one that has it.
    pub state: State,
    /// Largest difference of a coordinate or velocity after a period, over its peak to peak.
    pub residual: f64,
    /// Largest size of an eigenvalue of dP/dx: below 1 the motion is stable; how much of a disturbance is left after a
    /// period. Infinite where none is found, so that nothing is called stable that is not known to be.
    pub multiplier: f64,
    /// Newton steps.
    pub steps: usize,
    /// Periods integrated in all.
    pub periods: usize,
}

/// One period from a state on, in units of the coordinates' sizes and of velocities that belong to them.
struct Period {
    from: State,
    end: State,
    /// P(x) - x.
    rest: DVector<f64>,
    /// dP/dx.
    monodromy: DMatrix<f64>,
    /// Largest peak to peak of a coordinate or velocity.
    size: f64,
    residual: f64,
}

impl Shooting<'_> {
    /// So many cycles of a timetable from its first on, which begins at the time `begin` (s); `None` where the motion ends
    /// before.
    pub fn cycles<M: Mechanism>(
        times: &impl Timetable<M>,
        system: &M,
        begin: f64,
        count: u64,
    ) -> Option<Vec<CycleTimes>> {
        let mut now = begin;
        let one = |k| {
            let mut cycle = times.cycle(system, k, now)?;
            now = cycle.stops.last().map_or(now, |stop| stop.time);
            cycle.stops.iter_mut().for_each(|stop| stop.time -= begin);
            Some(cycle)
        };
        (0..count).map(one).collect()
    }

    /// The stable periodic state near `from`, at the same time; `None` where there is none near, or the search leads out of
    /// what the mechanism can do. The mechanism is afterwards what it was before, beside coordinates and velocities.
    ///
    /// # Errors
    /// Where it cannot be restored.
    pub fn near<M: Resumable>(&self, mechanism: &mut M, from: &State) -> Result<Option<State>, M::Error> {
        let memory = mechanism.memory();
        let found = self.search(mechanism, &memory, from, &NEARBY).ok();
        mechanism.restore(&memory)?;
        mechanism.forget();
        Ok(found.filter(|shot| shot.residual <= self.tolerance && shot.multiplier < 1.0).map(|shot| shot.state))
    }

    /// A periodic state, stable or not, by the way from any other one; after some steps without one the residual tells how
    /// far it is from repeating itself. The mechanism is afterwards what it was before, beside coordinates and velocities.
    ///
    /// # Errors
    /// [`MotionError`] of a step.
    pub fn from<M: Resumable>(&self, mechanism: &mut M, from: &State) -> Result<Shot, MotionError<M::Error>> {
        let memory = mechanism.memory();
        let shot = self.search(mechanism, &memory, from, &ANYWHERE)?;
        mechanism.restore(&memory).map_err(|source| MotionError::Mechanism { time: from.time, source })?;
        mechanism.forget();
        Ok(shot)
    }

    fn search<M: Resumable>(
        &self,
        mechanism: &mut M,
        memory: &M::Memory,
        from: &State,
        reach: &Reach,
    ) -> Result<Shot, MotionError<M::Error>> {
        let (scale, n) = (&self.method.scale, from.q.len());
        let units = DVector::from_fn(2 * n, |i, _| if i < n { scale[i] } else { self.frequency * scale[i - n] });
        let mut here = self.over_period(mechanism, memory, from.clone(), &units)?;
        let (mut steps, mut periods) = (0, 1);
        let mut gone = DVector::zeros(units.len());
        // What dP/dx is beside that of the tangent flow.
        let mut beside = DMatrix::zeros(units.len(), units.len());
        loop {
            let map = DMatrix::identity(units.len(), units.len()) - &here.monodromy - &beside;
            let svd = map.svd(true, true);
            let least = FREE * svd.singular_values.max();
            let singular = MotionError::Singular { time: from.time, which: "period" };
            let step = svd.solve(&here.rest, least).ok().filter(|step| step.iter().all(|x| x.is_finite()));
            let mut step = step.ok_or(singular)?;
            let found = here.residual <= self.tolerance;
            let is_near = (&gone + &step).amax() <= reach.way * here.size;
            if found || steps == reach.steps || !is_near {
                let state = if found { here.moved(&step, &units) } else { here.from };
                let multiplier = largest_eigenvalue(here.monodromy);
                return Ok(Shot { state, residual: here.residual, multiplier, steps, periods });
            }
            let mut halving = 0;
            let next = loop {
                periods += 1;
                match self.over_period(mechanism, memory, here.moved(&step, &units), &units) {
                    Ok(next) if next.residual < here.residual || halving == reach.halvings => break next,
                    // Too long a step, from where there may be no motion.
                    Err(e) if halving == reach.halvings => return Err(e),
                    _ => (),
                }
                step *= 0.5;
                halving += 1;
            };
            // What the map bends by is the same along the step as by the mean of both ends.
            let mean = (&here.monodromy + &next.monodromy) * 0.5 + &beside;
            let missing = &next.rest - &here.rest + &step - mean * &step;
            beside.ger(1.0 / step.norm_squared(), &missing, &step, 1.0);
            gone += step;
            steps += 1;
            let leads_on = next.residual <= reach.slow * here.residual;
            here = next;
            if !leads_on {
                steps = reach.steps;
            }
        }
    }

    fn over_period<M: Resumable>(
        &self,
        mechanism: &mut M,
        memory: &M::Memory,
        mut from: State,
        units: &DVector<f64>,
    ) -> Result<Period, MotionError<M::Error>> {
        let (n, begin) = (from.q.len(), from.time);
        let at = |time: f64| move |source| MotionError::Mechanism { time, source };
        mechanism.restore(memory).map_err(at(begin))?;
        mechanism.forget();
        let mass = mechanism.mass().clone();
        let unit = DMatrix::from_diagonal(units);
        let mut flow = TangentFlow { places: unit.rows(0, n).into_owned(), rates: unit.rows(n, n).into_owned() };
        let mut tangents = [Forces::zeros(n), Forces::zeros(n)];
        mechanism.forces(begin, &from.q, &from.v, &mut tangents[0]).map_err(at(begin))?;
        let factor = mass.clone().cholesky().ok_or(MotionError::Singular { time: begin, which: "mass" })?;
        let a = factor.solve(&(&tangents[0].conservative + &tangents[0].other));
        // The integrator's own acceleration is the true one at a start, and moves along with it on the way.
        from.averaged = if from.last_step > 0.0 { &from.averaged + &a - &from.a } else { a.clone() };
        from.a = a;
        let mut state = from.clone();
        let mut envelope = Envelope::new(&state);
        let (mut last, mut failure) = (begin, None);
        for cycle in &self.cycles {
            mechanism.forget();
            // Nobody asks for the energy of the search, and the state has all that a start would have to find.
            let mut integrator = self.method.clone().integrator(cycle.control).resumed(Ledger::default());
            for stop in &cycle.stops {
                integrator.advance(mechanism, &mut state, begin + stop.time, |mechanism, now| {
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
                    envelope.widen(now.state);
                })?;
            }
        }
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
        let mut rest = [&state.q - &from.q, &state.v - &from.v];
        // What a free turn has become says nothing of the motion.
        if let Some(free) = self.free {
            rest.iter_mut().for_each(|part| free.remove(part));
            [&mut flow.places, &mut flow.rates].into_iter().for_each(|part| free.remove(part));
        }
        let still = [DVector::zeros(n), DVector::zeros(n)];
        let extent = envelope.peak_to_peak();
        let over = |[places, rates]: [&DVector<f64>; 2]| {
            DVector::from_fn(2 * n, |i, _| if i < n { places[i] } else { rates[i - n] } / units[i])
        };
        Ok(Period {
            rest: over(rest.each_ref()),
            monodromy: DMatrix::from_fn(2 * n, 2 * n, |i, j| {
                (if i < n { flow.places[(i, j)] } else { flow.rates[(i - n, j)] }) / units[i]
            }),
            size: over(extent.each_ref()).amax(),
            residual: difference([&rest, &still], &extent, &self.method.scale, None),
            from,
            end: state,
        })
    }
}

impl Period {
    /// The state where it begins, moved by a step; the accelerations of the integrator come along with the motion.
    fn moved(&self, step: &DVector<f64>, units: &DVector<f64>) -> State {
        let (by, n) = (units.component_mul(step), self.from.q.len());
        let (q, v) = (&self.from.q + by.rows(0, n), &self.from.v + by.rows(n, n));
        State { time: self.from.time, q, v, ..self.end.clone() }
    }
}

/// Size of the largest eigenvalue; a free turn has been taken out and fades at once.
fn largest_eigenvalue(matrix: DMatrix<f64>) -> f64 {
    let all = integrate::eigenvalues(matrix);
    all.map_or(f64::INFINITY, |all| all.iter().map(|e| e.norm()).fold(0.0, f64::max))
}
