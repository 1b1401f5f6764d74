//! The largest Lyapunov exponent of a motion, from its tangent flow.

use std::f64::consts::TAU;

use gearbox::GearboxError;
use integrate::{Forces, Mechanism, MotionError, State};
use nalgebra::DMatrix;
use periodic::{FreeDirection, TangentFlow};
use scene::MotionScene;
use study::Lyapunov;

use super::{
    integration::{MeshFrequencies, integrator},
    mechanism::BoxedMechanism,
};

/// Part of the stretches that pass before counting begins: the difference turns into its direction of fastest growth.
const SETTLING: u32 = 5;

/// Largest exponent of the motion from `end` on, 1/s; growth is read once a mesh cycle. Theory (76).
///
/// ```text
/// M y'' + D(t) y' + K(t) y = 0 along the motion,   lambda = mean of ln(|y(t + T)| / |y(t)|) / T
/// ```
/// The exponent says nothing of the gears' free rotation, which nothing holds.
pub(super) fn exponent(
    (model, free): (&mut BoxedMechanism, Option<&FreeDirection>),
    motion: &MotionScene,
    end: &State,
    frequencies: MeshFrequencies,
    stretches: u32,
) -> Result<Lyapunov, GearboxError> {
    let (n, period) = (end.q.len(), 1.0 / frequencies.mesh_hz);
    let fastest = TAU * frequencies.mesh_hz.max(frequencies.resonance_hz);
    let (lengths, mass) = (model.scale(), model.mass().clone());
    let column = |of: &dyn Fn(usize) -> f64| DMatrix::from_fn(n, 1, |i, _| of(i));
    // In no special direction.
    let mut flow = TangentFlow { places: column(&|i| lengths[i]), rates: column(&|i| fastest * lengths[i]) };
    let size = |flow: &TangentFlow| {
        let one = |i: usize| (flow.places[i] / lengths[i]).powi(2) + (flow.rates[i] / (fastest * lengths[i])).powi(2);
        (0..n).map(one).sum::<f64>().sqrt()
    };
    let mut state = end.clone();
    let mut tangents = [Forces::zeros(n), Forces::zeros(n)];
    let asked = model.forces(state.time, &state.q, &state.v, &mut tangents[0]);
    asked.map_err(GearboxError::at(state.time))?;
    let mut last = state.time;
    let mut integrator = integrator(model, motion, frequencies.step(motion));
    let mut failure = None;
    let mut rates = Vec::with_capacity(stretches as usize);
    let settling = stretches / SETTLING;
    for k in 0..settling + stretches {
        let before = size(&flow);
        let until = end.time + f64::from(k + 1) * period;
        integrator.advance(model, &mut state, until, |model, now| {
            let time = now.state.time;
            let mut step = || {
                let [here, next] = &mut tangents;
                next.clear();
                model.forces(time, &now.state.q, &now.state.v, next).map_err(GearboxError::at(time))?;
                let places = [[&here.stiffness, &here.damping], [&next.stiffness, &next.damping]];
                let singular = || MotionError::<GearboxError>::Singular { time, which: "tangent" };
                flow.step(&mass, places[0], places[1], time - last).ok_or_else(singular)?;
                Ok::<_, GearboxError>(())
            };
            if failure.is_none() {
                failure = step().err();
            }
            tangents.swap(0, 1);
            last = time;
            if let Some(free) = free {
                free.remove(&mut flow.places);
                free.remove(&mut flow.rates);
            }
        })?;
        if let Some(failure) = failure.take() {
            return Err(failure);
        }
        let after = size(&flow).max(f64::MIN_POSITIVE);
        if k >= settling {
            rates.push((after / before).ln() / period);
        }
        flow.places /= after;
        flow.rates /= after;
    }
    Ok(Lyapunov::of_rates(&rates))
}
