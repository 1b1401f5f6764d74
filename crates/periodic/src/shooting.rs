//! Periodic motions without waiting: Newton's method on the map over a period. Theory (49), (71).
//!
//! ```text
//! P(x) - x = 0,   (1 - dP/dx) dx = P(x) - x,   x = (q, v) at the start of a period
//! ```
//! P is the motion over a period by its own steps, with coordinates that count in frames that turn on turned back. dP/dx
//! is that of the tangent flow, with what P did in the steps before (C. G. Broyden, Math. Comp. 19 (1965) 577).
//!
//! A motion that settles already is taken to where it settles to ([`Shooting::near`]): an answer is one only where it is
//! near, so that of several periodic motions it is the one that waiting leads to, and where disturbances of it fade.
//! [`Shooting::from_anywhere`] also finds unstable motions, which waiting never does.

use integrate::{Ahead, Envelope, Forces, Ledger, MotionError, Resumable, State, difference};
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
    /// Part of the tolerance that ends it, over the largest peak to peak; `None`: all of it, each over its own.
    part: Option<f64>,
}

/// To where a motion settles: three or four steps do. The cycles that follow are judged by all of the tolerance.
const NEARBY: Reach = Reach { steps: 6, halvings: 0, way: 0.3, slow: 0.5, part: Some(0.1) };
/// From anywhere.
const ANYWHERE: Reach = Reach { steps: 12, halvings: 5, way: f64::INFINITY, slow: f64::INFINITY, part: None };

/// What a search for a periodic state takes beside the mechanism.
#[derive(Debug)]
pub struct Shooting<'a> {
    /// Where it begins, accelerations included, and the cycles of a period from there on; the scale of the method has the
    /// sizes of the coordinates.
    pub period: &'a Ahead,
    /// Difference after a period, over the peak to peak, that is none.
    pub tolerance: f64,
    /// A direction that nothing holds: where a motion is along it says nothing of it.
    pub free: Option<&'a FreeDirection>,
    /// Map of the coordinates at the end of a period to those at its beginning which are the same motion, n x n orthogonal;
    /// `None`: they repeat themselves.
    pub back: Option<DMatrix<f64>>,
}

/// Where a search ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// State at the beginning of a period; a Newton step beyond the one that is found.
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

/// One period from a state on.
struct Period {
    from: State,
    end: State,
    /// P(x) - x.
    rest: DVector<f64>,
    /// dP/dx.
    monodromy: DMatrix<f64>,
    /// M^-1 f at its end.
    acceleration: DVector<f64>,
    /// Peak to peak of coordinates and velocities.
    extent: DVector<f64>,
    /// Largest difference over its own peak to peak.
    residual: f64,
}

impl Shooting<'_> {
    /// The stable periodic state near the beginning, at the same time; `None` where there is none near, or the search leads
    /// out of what the mechanism can do. The mechanism is afterwards what it was before, beside coordinates and velocities.
    ///
    /// # Errors
    /// Where it cannot be restored.
    pub fn near<M: Resumable>(&self, mechanism: &mut M) -> Result<Option<State>, M::Error> {
        let memory = mechanism.memory();
        let found = self.search(mechanism, &memory, &NEARBY).ok();
        mechanism.restore(&memory)?;
        mechanism.forget();
        Ok(found.filter(|(shot, repeats)| *repeats && shot.multiplier < 1.0).map(|(shot, _)| shot.state))
    }

    /// A periodic state, stable or not, by the way from any other one; after some steps without one the residual tells how
    /// far it is from repeating itself. The mechanism is afterwards what it was before, beside coordinates and velocities.
    ///
    /// # Errors
    /// [`MotionError`] of a step.
    pub fn from_anywhere<M: Resumable>(&self, mechanism: &mut M) -> Result<Shot, MotionError<M::Error>> {
        let memory = mechanism.memory();
        let (shot, _) = self.search(mechanism, &memory, &ANYWHERE)?;
        let time = self.period.state.time;
        mechanism.restore(&memory).map_err(|source| MotionError::Mechanism { time, source })?;
        mechanism.forget();
        Ok(shot)
    }

    /// Where it ends, and whether the motion repeats itself there.
    fn search<M: Resumable>(
        &self,
        mechanism: &mut M,
        memory: &M::Memory,
        reach: &Reach,
    ) -> Result<(Shot, bool), MotionError<M::Error>> {
        let from = &self.period.state;
        let mut here = self.over_period(mechanism, memory, from.clone(), None)?;
        let (mut steps, mut periods) = (0, 1);
        let units = here.units(&self.period.method.scale);
        let mut gone = DVector::zeros(units.len());
        // What dP/dx is beside that of the tangent flow.
        let mut beside = DMatrix::zeros(units.len(), units.len());
        let mut leads_on = true;
        loop {
            let [rest, extent] = [&here.rest, &here.extent].map(|x| x.component_div(&units));
            let scaled = (DMatrix::identity(units.len(), units.len()) - &here.monodromy - &beside)
                .map_with_location(|i, j, x| x * units[j] / units[i]);
            let svd = scaled.svd(true, true);
            let least = FREE * svd.singular_values.max();
            let step = svd.solve(&rest, least).ok().filter(|step| step.iter().all(|x| x.is_finite()));
            let mut step = step.ok_or(MotionError::Singular { time: from.time, which: "period" })?;
            let off = reach.part.map_or(here.residual, |part| rest.amax() / (part * extent.amax()));
            let repeats = off <= self.tolerance;
            let is_near = (&gone + &step).amax() <= reach.way * extent.amax();
            if repeats || !leads_on || !is_near || steps == reach.steps {
                let (residual, multiplier) = (here.residual, here.multiplier());
                let state = if repeats { here.moved(&step.component_mul(&units)) } else { here.from };
                return Ok((Shot { state, residual, multiplier, steps, periods }, repeats));
            }
            let mut halving = 0;
            let next = loop {
                periods += 1;
                match self.over_period(
                    mechanism,
                    memory,
                    here.moved(&step.component_mul(&units)),
                    Some(&here.acceleration),
                ) {
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
            let moved = step.component_mul(&units);
            let missing = &next.rest - &here.rest + &moved - mean * moved;
            beside.ger(1.0 / step.norm_squared(), &missing, &step.component_div(&units), 1.0);
            gone += step;
            steps += 1;
            leads_on = next.residual <= reach.slow * here.residual;
            here = next;
        }
    }

    fn over_period<M: Resumable>(
        &self,
        mechanism: &mut M,
        memory: &M::Memory,
        mut from: State,
        before: Option<&DVector<f64>>,
    ) -> Result<Period, MotionError<M::Error>> {
        let (n, begin) = (from.q.len(), from.time);
        let Ahead { method, cycles, .. } = self.period;
        let at = |time: f64| move |source| MotionError::Mechanism { time, source };
        mechanism.restore(memory).map_err(at(begin))?;
        mechanism.forget();
        let mass = mechanism.mass().clone();
        let unit = DMatrix::identity(2 * n, 2 * n);
        let mut flow = TangentFlow { places: unit.rows(0, n).into_owned(), rates: unit.rows(n, n).into_owned() };
        let mut tangents = [Forces::zeros(n), Forces::zeros(n)];
        mechanism.forces(begin, &from.q, &from.v, &mut tangents[0]).map_err(at(begin))?;
        let factor = mass.clone().cholesky().ok_or(MotionError::Singular { time: begin, which: "mass" })?;
        let acceleration = |f: &Forces| factor.solve(&(&f.conservative + &f.other));
        if let Some(before) = before {
            // The integrator's own accelerations go along with the true one.
            let further = acceleration(&tangents[0]) - before;
            from.a += &further;
            from.averaged += further;
        }
        let mut state = from.clone();
        let mut envelope = Envelope::new(&state);
        let (mut last, mut failure) = (begin, None);
        for cycle in cycles {
            mechanism.forget();
            // Nobody asks for the energy of the search, and the state has all that a start would have to find.
            let mut integrator = method.clone().integrator(cycle.control).resumed(Ledger::default());
            for stop in &cycle.stops {
                integrator.advance(mechanism, &mut state, stop.time, |mechanism, now| {
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
        state.time = begin;
        let mut acceleration = acceleration(&tangents[0]);
        if let Some(back) = &self.back {
            for part in [&mut state.q, &mut state.v, &mut state.a, &mut state.averaged, &mut acceleration] {
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
        let extent = envelope.peak_to_peak();
        let still = [DVector::zeros(n), DVector::zeros(n)];
        let residual = difference([&rest, &still], &extent, &method.scale, None);
        let [rest, extent] = [rest, extent].map(|[q, v]| DVector::from_iterator(2 * n, q.iter().chain(&v).copied()));
        let monodromy =
            DMatrix::from_fn(2 * n, 2 * n, |i, j| if i < n { flow.places[(i, j)] } else { flow.rates[(i - n, j)] });
        Ok(Period { from, end: state, rest, monodromy, acceleration, extent, residual })
    }
}

impl Period {
    /// Sizes of coordinates, and of velocities by how fast the motion is.
    fn units(&self, scale: &DVector<f64>) -> DVector<f64> {
        let n = scale.len();
        let [way, speed] = [0, n].map(|i| self.extent.rows(i, n).component_div(scale).amax());
        let frequency = if way > 0.0 && speed > 0.0 { speed / way } else { 1.0 };
        DVector::from_fn(2 * n, |i, _| if i < n { scale[i] } else { frequency * scale[i - n] })
    }

    /// The state where it begins, moved by a step; the accelerations of the integrator come along with the motion.
    fn moved(&self, step: &DVector<f64>) -> State {
        let n = self.from.q.len();
        let (q, v) = (&self.from.q + step.rows(0, n), &self.from.v + step.rows(n, n));
        State { q, v, ..self.end.clone() }
    }

    /// Size of the largest eigenvalue of dP/dx; a free turn has been taken out and fades at once.
    fn multiplier(&self) -> f64 {
        let all = integrate::eigenvalues(self.monodromy.clone());
        all.map_or(f64::INFINITY, |all| all.iter().map(|e| e.norm()).fold(0.0, f64::max))
    }
}
