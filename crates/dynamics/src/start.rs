//! Where a motion begins: in quasi-static equilibrium, so that nothing rings that the motion itself does not set off.

use nalgebra::DVector;

use crate::{PairMechanism, PairMotionError};
use integrate::{Forces, Mechanism, MotionError, State};

/// Steps of the search for equilibrium before giving up.
const STEPS: usize = 200;
/// Residual force over the force of the load that is equilibrium.
const TOLERANCE: f64 = 1e-9;
/// The same where no step lowers it any more.
const ROUND_OFF: f64 = 1e3 * TOLERANCE;
/// Share of a mesh cycle either way over which velocities are taken.
const SPAN: f64 = 1e-3;

/// State at `time` (s) in which forces balance as the gears turn slowly through their nominal motion. Velocities are
/// the rates of this balance.
///
/// ```text
/// f(t, q, 0) = 0,   v = [q(t + dt) - q(t - dt)] / 2 dt
/// ```
/// Inertia of that slow motion is left out; in a fast motion the difference is a transient. A driver that a torque
/// drives keeps its nominal turn. `guess` is an approximate lag of the driven gear (mm) with load on the driving
/// flanks, `scale` the size of each coordinate. A load in the other direction presses the coast flanks: the lag is then
/// about as far beyond the backlash.
///
/// # Errors
/// [`PairMotionError::NoStart`] where no balance is found: the load must press the flanks together, and every free
/// coordinate be held by teeth or bearings.
pub fn quasi_static_start(
    system: &mut PairMechanism,
    time: f64,
    guess: f64,
    scale: &DVector<f64>,
) -> Result<State, PairMotionError> {
    let q = balance(system, time, guessed(system, time, guess), scale)?;
    let speed = system.nominal().cycles_per_second(system.pair(), &system.options().statics, time);
    let mut v = DVector::zeros(q.len());
    if speed > 0.0 {
        let dt = SPAN / speed;
        let after = balance(system, time + dt, q.clone(), scale)?;
        let before = balance(system, time - dt, q.clone(), scale)?;
        v = (after - before) / (2.0 * dt);
    }
    system.forget();
    Ok(State::new(time, q, v))
}

/// Where the search for balance begins: the driven gear lags by `guess` (mm), or as much beyond the backlash.
pub(super) fn guessed(system: &PairMechanism, time: f64, guess: f64) -> DVector<f64> {
    let mut q = DVector::zeros(system.count());
    let coasts = system.load_on_lag(time) < 0.0;
    q[system.coordinates().lag()] = if coasts { -(system.pair().backlash() + guess) } else { guess };
    q
}

/// Levenberg-Marquardt: Newton's method where it lowers the residual, else with added stiffness. Where flanks are apart
/// and nothing but the load acts, the residual is the same before and after a step: such a step is taken, or a gap of
/// some deflections would lie between steps that do not reach the teeth and those that overlap too far.
pub(super) fn balance(
    system: &mut PairMechanism,
    time: f64,
    mut q: DVector<f64>,
    scale: &DVector<f64>,
) -> Result<DVector<f64>, PairMotionError> {
    let n = q.len();
    let held = system.coordinates().driver_turn();
    let lag = system.coordinates().lag();
    let still = DVector::zeros(n);
    let mut forces = Forces::zeros(n);
    let residual = |system: &mut PairMechanism, q: &DVector<f64>, forces: &mut Forces| {
        forces.clear();
        system.forces(time, q, &still, forces).map_err(|source| PairMotionError::contact(time, source))?;
        let mut r = &forces.conservative + &forces.other;
        if let Some(i) = held {
            r[i] = 0.0;
        }
        Ok::<_, PairMotionError>(r)
    };
    // Work of the residual over the coordinates' sizes: one number for forces and moments.
    let size = |r: &DVector<f64>| r.component_mul(scale).norm();
    let mut r = residual(system, &q, &mut forces)?;
    let load = system.load_on_lag(time).abs() * scale[lag];
    let mut added = 1e-3;
    let mut change = 0.0;
    for _ in 0..STEPS {
        let now = size(&r);
        if now <= TOLERANCE * load.max(f64::MIN_POSITIVE) {
            return Ok(q);
        }
        let mut matrix = forces.stiffness.clone();
        for i in 0..n {
            // As stiff as the teeth would be if they carried the load over the coordinate's size.
            matrix[(i, i)] += added * load.max(now) / (scale[i] * scale[i]);
        }
        if let Some(i) = held {
            matrix.row_mut(i).fill(0.0);
            matrix.column_mut(i).fill(0.0);
            matrix[(i, i)] = 1.0;
        }
        let singular = MotionError::Singular { time, which: "stiffness" };
        let step = matrix.lu().solve(&r).filter(|s| s.iter().all(|x| x.is_finite())).ok_or(singular)?;
        let tried = &q + &step;
        let kept = forces.clone();
        let there = residual(system, &tried, &mut forces)?;
        let found = size(&there);
        if found < now || (found == now && now > ROUND_OFF * load) {
            change = step.component_div(scale).amax();
            (q, r, added) = (tried, there, added * 0.1);
        } else if added > 1e6 {
            // Residuals of contact are good to some 1e-11 of its forces; what is left is round-off, or no balance is
            // near.
            if now <= ROUND_OFF * load {
                return Ok(q);
            }
            break;
        } else {
            forces = kept;
            added = (added * 10.0).max(1e-6);
        }
    }
    Err(PairMotionError::NoStart { time, change })
}
