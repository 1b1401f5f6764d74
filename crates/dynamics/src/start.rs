//! Start of a motion: in quasi-static equilibrium, so that nothing rings that the motion itself does not set off.

use nalgebra::DVector;

use crate::{PairMechanism, PairMotionError};
use integrate::{Forces, Mechanism, State, equilibrium, quasi_static};

/// Residual force over the force of the load that is equilibrium.
const ROUND_OFF: f64 = 1e-6;
/// Residual force over the force of the load that is equilibrium where round-off of places is all that is left.
const UNFELT: f64 = 1e-4;
/// Round-off of places, in units of the last bit.
const LAST_BITS: f64 = 256.0;
/// A load that is not so many times what round-off makes has no digit.
const ONE_DIGIT: f64 = 10.0;
/// Share of a mesh cycle either way over which velocities are taken.
const SPAN: f64 = 1e-3;

/// State at `time` (s) in which forces balance as the gears turn slowly through their nominal motion ([`quasi_static`]).
///
/// A driver that a torque drives keeps its nominal turn. `guess` is an approximate lag of the driven gear (mm) with load on
/// the driving flanks, `scale` the size of each coordinate. A load in the other direction presses the coast flanks: the lag
/// is then about as far beyond the backlash.
///
/// # Errors
/// [`PairMotionError::NoStart`] where no balance is found: the load must press the flanks together, and every free
/// coordinate be held by teeth or bearings. [`PairMotionError::LostLoad`] for a load that is next to none.
pub fn quasi_static_start(
    system: &mut PairMechanism,
    time: f64,
    guess: f64,
    scale: &DVector<f64>,
) -> Result<State, PairMotionError> {
    let speed = system.nominal().cycles_per_second(system.pair(), &system.options().statics, time);
    let span = if speed > 0.0 { SPAN / speed } else { 0.0 };
    let guess = guessed(system, time, guess);
    quasi_static(system, time, span, guess, |system, t, q| balance(system, t, q, scale))
}

/// Coordinates at `time` (s) in which forces balance without motion, sought from `from`, or from a lag of `guess` (mm).
pub(super) fn quasi_static_balance(
    system: &mut PairMechanism,
    time: f64,
    guess: f64,
    from: Option<DVector<f64>>,
    scale: &DVector<f64>,
) -> Result<DVector<f64>, PairMotionError> {
    let from = from.unwrap_or_else(|| guessed(system, time, guess));
    balance(system, time, from, scale)
}

/// Start of the search for balance: the driven gear lags by `guess` (mm), or as much beyond the backlash; no mode bends.
pub(super) fn guessed(system: &PairMechanism, time: f64, guess: f64) -> DVector<f64> {
    let mut q = DVector::zeros(system.count());
    let coasts = system.load_on_lag(time) < 0.0;
    q[system.coordinates().lag()] = if coasts { -(system.pair().backlash() + guess) } else { guess };
    system.stiffened(time, q)
}

/// Where forces balance at `time` (s) without motion, a driver's own turn held.
pub(super) fn balance(
    system: &mut PairMechanism,
    time: f64,
    from: DVector<f64>,
    scale: &DVector<f64>,
) -> Result<DVector<f64>, PairMotionError> {
    let (held, lag) = (system.coordinates().driver_turn(), system.coordinates().lag());
    // Sizes have no sign, whatever the places have that they are taken from.
    let scale = &scale.abs();
    let fail = |source| PairMotionError::contact(time, source);
    let held: Vec<usize> = held.into_iter().collect();
    let found = equilibrium(system, time, &from, &held, scale).map_err(fail)?;
    // Work of the residual over the coordinates' sizes: one number for forces and moments.
    let mut forces = Forces::zeros(from.len());
    system.forces(time, found.as_ref().unwrap_or(&from), &DVector::zeros(from.len()), &mut forces).map_err(fail)?;
    let mut residual = (&forces.conservative + &forces.other).component_mul(scale);
    held.into_iter().for_each(|i| residual[i] = 0.0);
    let (load_n, left_n) = (system.load_on_lag(time).abs(), residual.norm() / scale[lag]);
    // Places are known to some last bits of the distance of the axes, and teeth make a force of that.
    let place = LAST_BITS * f64::EPSILON * system.pair().centre_distance();
    let lost_n = place * system.mean_stiffness().max(forces.stiffness[(lag, lag)].abs());
    match found {
        Some(q) if left_n <= (ROUND_OFF * load_n).max(lost_n.min(UNFELT * load_n)) => Ok(q),
        _ if load_n <= ONE_DIGIT * lost_n => Err(PairMotionError::LostLoad { time, load_n, lost_n }),
        _ => Err(PairMotionError::NoStart { time, left: left_n / load_n }),
    }
}
