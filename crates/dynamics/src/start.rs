//! Start of a motion: in quasi-static equilibrium, so that nothing rings that the motion itself does not set off.

use std::cell::Cell;

use nalgebra::DVector;

use crate::{PairMechanism, PairMotionError};
use integrate::{Forces, Mechanism, MotionError, State};

/// Steps of the search for equilibrium before giving up.
const STEPS: usize = 200;
/// Residual force over the force of the load that is equilibrium.
const TOLERANCE: f64 = 1e-9;
/// Residual force over the force of the load that is equilibrium where no step lowers it any more.
const ROUND_OFF: f64 = 1e3 * TOLERANCE;
/// Residual force over the force of the load that is equilibrium where round-off of places is all that is left.
const UNFELT: f64 = 1e-4;
/// Round-off of places, in units of the last bit.
const LAST_BITS: f64 = 256.0;
/// A load that is not so many times what round-off makes has no digit.
const ONE_DIGIT: f64 = 10.0;
/// How often the reach towards the mating flank is doubled, from the size of the lag on.
const DOUBLINGS: usize = 40;
/// How often the way between flanks apart and flanks that overlap is halved: to the last bit of a number.
const HALVINGS: usize = 60;
/// How often flanks that came apart in the search are closed again.
const APPROACHES: usize = 5;
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
    // Teeth near places that were looked at before are known less well: the search ends from its own end on.
    system.forget();
    let q = balance(system, time, q, scale)?;
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

/// Start of the search for balance: the driven gear lags by `guess` (mm), or as much beyond the backlash.
pub(super) fn guessed(system: &PairMechanism, time: f64, guess: f64) -> DVector<f64> {
    let mut q = DVector::zeros(system.count());
    let coasts = system.load_on_lag(time) < 0.0;
    q[system.coordinates().lag()] = if coasts { -(system.pair().backlash() + guess) } else { guess };
    q
}

/// Levenberg-Marquardt: Newton's method where it lowers the residual, else with added stiffness. Flanks that are apart are
/// closed first: a residual that is the load alone has no slope that leads to the teeth.
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
    // Places are known to some last bits of the distance of the axes, and teeth make a force of that.
    let place = LAST_BITS * f64::EPSILON * system.pair().centre_distance();
    let felt = Cell::new(0.0f64);
    let residual = |system: &mut PairMechanism, q: &DVector<f64>, forces: &mut Forces| {
        forces.clear();
        system.forces(time, q, &still, forces).map_err(|source| PairMotionError::contact(time, source))?;
        felt.set(felt.get().max(place * forces.stiffness[(lag, lag)].abs()));
        let mut r = &forces.conservative + &forces.other;
        if let Some(i) = held {
            r[i] = 0.0;
        }
        Ok::<_, PairMotionError>(r)
    };
    // Sizes have no sign, whatever the places have that they are taken from.
    let scale = &scale.abs();
    // Work of the residual over the coordinates' sizes: one number for forces and moments.
    let size = |r: &DVector<f64>| r.component_mul(scale).norm();
    // Against the load nothing but a flank resists: where a way back changes nothing, none does.
    let approached = |system: &mut PairMechanism, q: &DVector<f64>, forces: &mut Forces| {
        let alone = residual(system, q, forces)?;
        let moved = |reach: f64| {
            let mut there = q.clone();
            there[lag] += reach * scale[lag] * alone[lag].signum();
            there
        };
        if residual(system, &moved(-1.0), forces)?[lag] != alone[lag] {
            return Ok(None);
        }
        let mut touches = |reach: f64| {
            let there = moved(reach);
            let r = residual(system, &there, forces)?;
            Ok::<_, PairMotionError>((r[lag] != alone[lag]).then(|| (size(&r), there)))
        };
        closed(&mut touches, size(&alone))
    };
    let mut approaches = 0;
    if let Some(there) = approached(system, &q, &mut forces)? {
        q = there;
    }
    let mut r = residual(system, &q, &mut forces)?;
    let load_n = system.load_on_lag(time).abs();
    let load = load_n * scale[lag];
    let mut added = 1e-3;
    let mut change = 0.0;
    for _ in 0..STEPS {
        let now = size(&r);
        let lost = felt.get();
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
        if size(&there) < now {
            change = step.component_div(scale).amax();
            (q, r, added) = (tried, there, added * 0.1);
        } else if added > 1e6 {
            // Residuals of contact are good to some 1e-11 of its forces; what is left is round-off, or no balance is
            // near.
            if now <= ROUND_OFF * load || now <= (lost * scale[lag]).min(UNFELT * load) {
                return Ok(q);
            }
            // What else moves may have taken the flanks apart.
            if approaches < APPROACHES
                && let Some(there) = approached(system, &q, &mut forces)?
            {
                q = there;
                r = residual(system, &q, &mut forces)?;
                (added, approaches) = (1e-3, approaches + 1);
                continue;
            }
            break;
        } else {
            forces = kept;
            added = (added * 10.0).max(1e-6);
        }
    }
    let lost = felt.get();
    if size(&r) <= lost * scale[lag] || load_n <= ONE_DIGIT * lost {
        return Err(PairMotionError::LostLoad { time, load_n, lost_n: lost });
    }
    Err(PairMotionError::NoStart { time, change })
}

/// Coordinates at which flanks begin to touch: further and further until they do, then half way back as long as they
/// press by much more than the load, whose residual is `alone`. `touches` tells for a reach (sizes of the lag) the
/// residual and the coordinates there, if flanks touch; `None` where they never do.
fn closed(
    touches: &mut impl FnMut(f64) -> Result<Option<(f64, DVector<f64>)>, PairMotionError>,
    alone: f64,
) -> Result<Option<DVector<f64>>, PairMotionError> {
    let (mut apart, mut reach) = (0.0, 1.0);
    let mut found = None;
    for _ in 0..DOUBLINGS {
        found = touches(reach)?.map(|(residual, q)| (reach, residual, q));
        if found.is_some() {
            break;
        }
        (apart, reach) = (reach, 2.0 * reach);
    }
    let Some((mut touching, mut residual, mut q)) = found else { return Ok(None) };
    for _ in 0..HALVINGS {
        if residual <= 2.0 * alone {
            break;
        }
        let middle = 0.5 * (apart + touching);
        match touches(middle)? {
            Some((less, there)) => (touching, residual, q) = (middle, less, there),
            None => apart = middle,
        }
    }
    Ok(Some(q))
}
