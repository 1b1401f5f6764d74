//! The periodic answer found directly: Newton on the map over one period.
//!
//! ```text
//! P(x) - x = 0,   (1 - dP/dx) dx = P(x) - x,   x = (q, v) at the start of a mesh cycle
//! ```
//! dP/dx by differences, one period for each of its 2 n columns, on all cores. Where damping is weak or a speed lies near a fold this takes far fewer periods
//! than waiting; and it finds unstable answers, which waiting never does.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::{Motion, PairMotionError, Place, steady::difference};
use crate::motion::{MotionError, State};

/// Differences of coordinates over their scales.
const STEP: f64 = 1e-4;
/// Times a Newton step is halved before it is taken as it is.
const HALVINGS: usize = 5;

/// What shooting has found.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// Largest difference of a coordinate or velocity over a period, over its peak to peak.
    pub residual: f64,
    /// Newton steps.
    pub iterations: usize,
    /// Periods integrated in all.
    pub periods: usize,
    /// Largest |eigenvalue| of dP/dx: below 1 the answer is stable; how much of a disturbance is left after a period.
    pub multiplier: f64,
}

/// Brings `motion`, at the start of cycle 0, onto its periodic answer of `period` mesh cycles; afterwards it stands there at the start of cycle 0.
///
/// Gives up after `most` Newton steps: the residual then says how far it is from repeating itself.
///
/// # Errors
/// [`MotionError::Options`] where a torque drives, since speed and place of the driver are free then; [`PairMotionError`] of the integration.
pub fn shoot(motion: &mut Motion, period: u64, tolerance: f64, most: usize) -> Result<Shot, PairMotionError> {
    if motion.system().coordinates().driver_turn().is_some() {
        return Err(MotionError::Options(
            "a driver that a torque turns has no period of its own: shooting needs a given speed",
        ));
    }
    if period == 0 || motion.cycle() != 0 {
        return Err(MotionError::Options(
            "shooting begins at the start of a motion and takes a period of one mesh cycle or more",
        ));
    }
    let mut search = Search { start: motion.system().place(), period, periods: 0 };
    let mut here = motion.state().clone();
    let mut end = search.map(motion, &here)?;
    let mut shot = Shot { residual: end.residual, iterations: 0, periods: 0, multiplier: f64::NAN };
    while shot.residual > tolerance && shot.iterations < most {
        let monodromy = search.monodromy(motion, &here, &end)?;
        shot.multiplier = largest_eigenvalue(&monodromy);
        let n = here.q.len();
        let rest = stacked(&end.state) - stacked(&here);
        let step = (DMatrix::identity(2 * n, 2 * n) - monodromy)
            .lu()
            .solve(&rest)
            .filter(|s| s.iter().all(|x| x.is_finite()))
            .ok_or(MotionError::Singular { time: here.time, which: "period" })?;
        let mut share = 1.0;
        for halving in 0..=HALVINGS {
            let mut next = moved(&here, &(share * &step));
            // What the integrator carries along is nearer to its own periodic value at the period's end.
            (next.a, next.averaged) = (end.state.a.clone(), end.state.averaged.clone());
            (next.last_step, next.next_step) = (end.state.last_step, end.state.next_step);
            next.powers = end.state.powers;
            let there = search.map(motion, &next)?;
            if there.residual < shot.residual || halving == HALVINGS {
                (here, end) = (next, there);
                break;
            }
            share *= 0.5;
        }
        shot.residual = end.residual;
        shot.iterations += 1;
    }
    shot.periods = search.periods;
    let mut state = here;
    state.time = 0.0;
    motion.rewind(&search.start, state)?;
    Ok(shot)
}

/// The map over a period.
struct Search {
    start: Place,
    period: u64,
    periods: usize,
}

/// Where a period ends.
struct End {
    state: State,
    residual: f64,
}

impl Search {
    fn map(&mut self, motion: &mut Motion, from: &State) -> Result<End, PairMotionError> {
        self.periods += 1;
        over_period(motion, &self.start, self.period, from)
    }

    /// dP/dx, column by column.
    fn monodromy(&mut self, motion: &Motion, here: &State, end: &End) -> Result<DMatrix<f64>, PairMotionError> {
        let n = here.q.len();
        self.periods += 2 * n;
        let scale = &motion.settings().scale;
        let omega = std::f64::consts::TAU * motion.system().mesh_resonance_hz();
        let base = stacked(&end.state);
        let column = |j: usize| {
            let size = STEP * if j < n { scale[j] } else { omega * scale[j - n] };
            let mut offset = DVector::zeros(2 * n);
            offset[j] = size;
            let system = motion.system().with_drive(motion.system().options().drive.clone());
            let system = system.map_err(|source| MotionError::Mechanism { time: here.time, source })?;
            let mut own = Motion::new(system, motion.settings().clone(), here.clone());
            let there = over_period(&mut own, &self.start, self.period, &moved(here, &offset))?;
            Ok::<_, PairMotionError>((stacked(&there.state) - &base) / size)
        };
        let columns: Vec<DVector<f64>> = (0..2 * n).into_par_iter().map(column).collect::<Result<_, _>>()?;
        Ok(DMatrix::from_columns(&columns))
    }
}

fn over_period(motion: &mut Motion, start: &Place, period: u64, from: &State) -> Result<End, PairMotionError> {
    motion.rewind(start, from.clone())?;
    if from.last_step > 0.0 {
        motion.keep_accelerations();
    }
    let mut size: Option<[DVector<f64>; 2]> = None;
    for _ in 0..period {
        let swing = motion.run_cycle(None)?.peak_to_peak();
        size = Some(match size {
            None => swing,
            Some(before) => [0, 1].map(|i| before[i].sup(&swing[i])),
        });
    }
    let state = motion.state().clone();
    let both = [[state.q.clone(), state.v.clone()], [from.q.clone(), from.v.clone()]];
    let residual = size.map_or(f64::INFINITY, |s| difference([&both[0], &both[1]], &s, &motion.settings().scale, None));
    Ok(End { state, residual })
}

fn stacked(state: &State) -> DVector<f64> {
    let n = state.q.len();
    DVector::from_fn(2 * n, |i, _| if i < n { state.q[i] } else { state.v[i - n] })
}

fn moved(state: &State, by: &DVector<f64>) -> State {
    let n = state.q.len();
    let mut next = state.clone();
    next.q += by.rows(0, n);
    next.v += by.rows(n, n);
    next
}

fn largest_eigenvalue(matrix: &DMatrix<f64>) -> f64 {
    matrix.complex_eigenvalues().iter().map(|e| e.norm()).fold(0.0, f64::max)
}
