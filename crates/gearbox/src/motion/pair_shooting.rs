//! The periodic solution by shooting: Newton's method on the map over one period. Theory (49).
//!
//! ```text
//! P(x) - x = 0,   (1 - dP/dx) dx = P(x) - x,   x = (q, v) at the start of a mesh cycle
//! ```
//! P is the motion over a period, with the gears' own frames turned back by as many pitches: amplitudes of modes are in
//! those frames (`GearboxMechanism::back_over`). With generalised-alpha the
//! integrator's own acceleration is a third part of x, because it is carried from step to step. dP/dx comes from finite
//! differences, one period for each column, on all cores. Where damping is weak or a speed lies near a fold, shooting
//! takes far fewer periods than waiting. It also finds unstable solutions, which waiting never does.

use integrate::{MotionError, Resumable, State, difference};
use ltca::StaticError;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::{GearboxMemory, PairModel, PairMotion, PairMotionError};

/// Differences of coordinates over their scales.
const STEP: f64 = 1e-4;
/// Times a Newton step is halved before it is taken as it is.
const HALVINGS: usize = 5;

/// Result of shooting.
#[derive(Debug, Clone, PartialEq)]
pub struct ShootingResult {
    /// Largest difference of a coordinate or velocity over a period, over its peak to peak.
    pub residual: f64,
    /// Newton steps.
    pub iterations: usize,
    /// Periods integrated in all.
    pub periods: usize,
    /// Largest |eigenvalue| of dP/dx: below 1 the answer is stable; how much of a disturbance is left after a period.
    pub multiplier: f64,
}

/// Brings `motion`, at the start of cycle 0, onto its periodic solution of `period` mesh cycles. Afterwards the motion
/// stands at the start of cycle 0.
///
/// Gives up after `most` Newton steps: the residual then says how far it is from repeating itself.
///
/// # Errors
/// [`PairMotionError::FreeDriver`] where a torque drives: speed and position of the driver are free then.
/// [`PairMotionError::ModesWithoutPeriod`] with modes of a gear that is not known by sectors.
/// [`PairMotionError::ShootingStart`] where the motion has begun. [`PairMotionError::Integration`].
pub fn shoot(
    pair: &PairModel,
    motion: &mut PairMotion,
    period: u64,
    tolerance: f64,
    most: usize,
) -> Result<ShootingResult, PairMotionError> {
    if motion.system().free.turn.is_some() {
        return Err(PairMotionError::FreeDriver);
    }
    if period == 0 || motion.cycle() != 0 {
        return Err(PairMotionError::ShootingStart { cycle: motion.cycle(), period });
    }
    let back = motion.system().back_over(period).map_err(PairMotionError::at(motion.state().time))?;
    let mut search = Search { pair, start: motion.system().memory(), period, back, periods: 0 };
    // Where the search begins, the integrator's own acceleration is the true one.
    let mut here = motion.state().clone();
    motion.rewind(&search.start, here.clone())?;
    here.averaged = motion.state().a.clone();
    let mut end = search.map(motion, &here)?;
    let mut shot = ShootingResult { residual: end.residual, iterations: 0, periods: 0, multiplier: f64::NAN };
    while shot.residual > tolerance && shot.iterations < most {
        let monodromy = search.monodromy(motion, &here, &end)?;
        shot.multiplier = largest_eigenvalue(&monodromy);
        let parts = parts(motion);
        let rest = stacked(&end.state, parts) - stacked(&here, parts);
        let step = (DMatrix::identity(rest.len(), rest.len()) - monodromy)
            .lu()
            .solve(&rest)
            .filter(|s| s.iter().all(|x| x.is_finite()))
            .ok_or(PairMotionError::Integration(MotionError::Singular { time: here.time, which: "period" }))?;
        let mut share = 1.0;
        for halving in 0..=HALVINGS {
            let next = moved(&here, &(share * &step));
            let there = match search.map(motion, &next) {
                // The step was too long: there is no motion from there.
                Err(e)
                    if halving < HALVINGS && matches!(e.contact_error(), Some(StaticError::PassedThrough { .. })) =>
                {
                    share *= 0.5;
                    continue;
                }
                other => other?,
            };
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
    motion.rewind(&search.start, here)?;
    Ok(shot)
}

/// The map over a period.
struct Search<'a> {
    pair: &'a PairModel,
    start: GearboxMemory,
    period: u64,
    /// Turn of the coordinates back by a period; none where they repeat themselves.
    back: Option<DMatrix<f64>>,
    periods: usize,
}

/// End of a period.
struct End {
    state: State,
    residual: f64,
}

impl Search<'_> {
    fn map(&mut self, motion: &mut PairMotion, from: &State) -> Result<End, PairMotionError> {
        self.periods += 1;
        self.over_period(motion, from)
    }

    /// dP/dx, column by column.
    fn monodromy(&mut self, motion: &PairMotion, here: &State, end: &End) -> Result<DMatrix<f64>, PairMotionError> {
        let (n, parts) = (here.q.len(), parts(motion));
        self.periods += parts * n;
        let timetable = motion.timetable();
        let (scale, omega) = (&timetable.scale, std::f64::consts::TAU * timetable.resonance_hz);
        let base = stacked(&end.state, parts);
        let column = |j: usize| {
            // Coordinates, velocities and accelerations of a vibration at the mesh resonance.
            let size = STEP * scale[j % n] * omega.powi((j / n) as i32);
            let mut offset = DVector::zeros(parts * n);
            offset[j] = size;
            let system = self.pair.machine().map_err(PairMotionError::at(here.time))?;
            let mut own = PairMotion::new(system, timetable.clone(), here.clone());
            let there = self.over_period(&mut own, &moved(here, &offset))?;
            Ok::<_, PairMotionError>((stacked(&there.state, parts) - &base) / size)
        };
        let columns: Vec<DVector<f64>> = (0..parts * n).into_par_iter().map(column).collect::<Result<_, _>>()?;
        Ok(DMatrix::from_columns(&columns))
    }

    fn over_period(&self, motion: &mut PairMotion, from: &State) -> Result<End, PairMotionError> {
        motion.rewind(&self.start, from.clone())?;
        let mut size: Option<[DVector<f64>; 2]> = None;
        for _ in 0..self.period {
            let envelope = motion.run_cycle::<PairMotionError>(None)?.peak_to_peak();
            size = Some(match size {
                None => envelope,
                Some(before) => [0, 1].map(|i| before[i].sup(&envelope[i])),
            });
        }
        let mut state = motion.state().clone();
        if let Some(back) = &self.back {
            for part in [&mut state.q, &mut state.v, &mut state.averaged] {
                *part = back * &*part;
            }
        }
        let both = [[state.q.clone(), state.v.clone()], [from.q.clone(), from.v.clone()]];
        let scale = &motion.timetable().scale;
        let residual = size.map_or(f64::INFINITY, |s| difference([&both[0], &both[1]], &s, scale, None));
        Ok(End { state, residual })
    }
}

/// Parts of x: coordinates, velocities, and the integrator's own acceleration where it has one.
fn parts(motion: &PairMotion) -> usize {
    if motion.timetable().scheme.carries_acceleration() { 3 } else { 2 }
}

fn stacked(state: &State, parts: usize) -> DVector<f64> {
    let n = state.q.len();
    DVector::from_fn(parts * n, |i, _| [&state.q, &state.v, &state.averaged][i / n][i % n])
}

fn moved(state: &State, by: &DVector<f64>) -> State {
    let n = state.q.len();
    let mut next = state.clone();
    for (k, part) in [&mut next.q, &mut next.v, &mut next.averaged].into_iter().enumerate().take(by.len() / n) {
        *part += by.rows(k * n, n);
    }
    next
}

/// Size of the largest eigenvalue of a matrix; infinite where none is found, so that nothing is called stable that is
/// not known to be.
fn largest_eigenvalue(matrix: &DMatrix<f64>) -> f64 {
    let all = integrate::eigenvalues(matrix.clone());
    all.map_or(f64::INFINITY, |all| all.iter().map(|e| e.norm()).fold(0.0, f64::max))
}
