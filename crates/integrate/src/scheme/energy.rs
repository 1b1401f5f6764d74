//! Implicit midpoint rule with a discrete gradient: the energy balance closes to round-off for any step. Theory (48).
//!
//! Source: O. Gonzalez, J. Nonlinear Sci. 6 (1996) 449.
//!
//! ```text
//! q_1 - q_0 = h (v_0 + v_1) / 2,   M (v_1 - v_0) = h [f(t_m, q_m, v_m) + c W (q_1 - q_0)]
//! c = -[V(t_m, q_1) - V(t_m, q_0) + f_c(q_m) . (q_1 - q_0)] / (q_1 - q_0)' W (q_1 - q_0),   W = M
//! ```
//! m is the middle of the step. Second order, without numerical damping at any frequency. Forces with kinks (contact
//! lost and gained) do exactly the work that their potential accounts for. The explicit change of V with time between
//! t_0 and t_1 is booked as parametric work.

use nalgebra::DMatrix;

use crate::{
    Forces, Mechanism, MotionError, State,
    newton::{ITERATIONS, NoStep},
    stepper::{Step, StepWork, Stepped, Stepper},
};

/// Relative accuracy of V. Over the short path of a motion that just begins, noise of that size would be a large force.
const ROUND_OFF: f64 = 8.0 * f64::EPSILON;
/// Shortest path over the motion's scale whose work is distinguished from noise of V. V of a contact has twelve digits: over
/// this path they are 1e-7 of the force, and the work that is left out is the third power of the path, 1e-15 of V.
const NO_WAY: f64 = 1e-5;

/// The method; it has no parameters.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DiscreteGradient;

impl Stepper for DiscreteGradient {
    fn error_order(&self) -> f64 {
        3.0
    }

    /// The forces that are left are those of the middle of the step.
    fn step<M: Mechanism>(&self, mut step: Step<'_, M>) -> Stepped<M> {
        // The derivative of c is left out as long as the iteration converges without it: over a short path it would
        // contain the noise of V.
        match iterate(&mut step, false) {
            Err(MotionError::NotConverged { .. }) => iterate(&mut step, true),
            done => done,
        }
    }
}

/// Newton's method from the predictor on, `exact` with dc/dq_1.
fn iterate<M: Mechanism>(step: &mut Step<'_, M>, exact: bool) -> Stepped<M> {
    let Step { system, from, h, scale, forces, to, ledger: book, work, .. } = step;
    let (StepWork { error, newton, rest, moved: [moved, velocity, weighted, half], .. }, h) = (&mut **work, *h);
    let (middle, end) = (from.time + 0.5 * h, from.time + h);
    let fail = |time: f64| move |source| MotionError::Mechanism { time, source };
    let before = system.potential(middle, &from.q).map_err(fail(middle))?;
    to.copy_from(from);
    to.time = end;
    to.q.axpy(h, &from.v, 1.0);
    to.q.axpy(0.5 * h * h, &from.a, 1.0);
    newton.begin(forces);
    let mut at_end = exact.then(|| Forces::zeros(to.q.len()));
    for iteration in 0..ITERATIONS {
        for i in 0..moved.len() {
            moved[i] = to.q[i] - from.q[i];
            velocity[i] = moved[i] / h;
            half[i] = from.q[i] + 0.5 * moved[i];
        }
        if exact {
            newton.renew();
        }
        newton.prepare(forces);
        system.forces(middle, half, velocity, forces).map_err(fail(middle))?;
        weighted.gemv(1.0, system.mass(), moved, 0.0);
        let length = moved.dot(weighted);
        let after = system.potential(middle, &to.q).map_err(fail(middle))?;
        let defect = after - before + forces.conservative.dot(moved);
        let goes = moved.iter().zip(scale.iter()).any(|(x, s)| x.abs() > NO_WAY * s);
        let c = if goes && defect.abs() > ROUND_OFF * (after.abs() + before.abs()) { -defect / length } else { 0.0 };
        // M (v_1 - v_0) / h
        let gained = &mut *half;
        gained.zip_zip_apply(velocity, &from.v, |gained, after, before| *gained = 2.0 * (after - before));
        rest.gemv(1.0, system.mass(), gained, 0.0);
        for i in 0..rest.len() {
            rest[i] = rest[i] / h - forces.conservative[i] - forces.other[i] - c * weighted[i];
        }
        let mut added = None;
        if let Some(at_end) = at_end.as_mut().filter(|_| c != 0.0) {
            // dc/dq_1 = [f_c(q_1) - f_c(q_m) + K (q_1 - q_0) / 2 - 2 c W (q_1 - q_0)] / (q_1 - q_0)' W (q_1 - q_0)
            at_end.clear();
            system.forces(middle, &to.q, velocity, at_end).map_err(fail(middle))?;
            let slope =
                &at_end.conservative - &forces.conservative + 0.5 * &forces.stiffness * &*moved - 2.0 * c * &*weighted;
            added = Some(&*weighted * slope.transpose() / length);
        }
        let matrix = |forces: &Forces, sum: &mut DMatrix<f64>| {
            let of_mass = 2.0 / (h * h) - c;
            sum.copy_from(system.mass());
            sum.zip_zip_apply(&forces.damping, &forces.stiffness, |m, d, k| *m = of_mass * *m + d / h + 0.5 * k);
            if let Some(added) = &added {
                *sum -= added;
            }
        };
        let settled = newton.settled();
        let no_step = |e: NoStep| e.error((from.time, h), middle);
        let step = newton.step(forces, matrix, rest, iteration).map_err(no_step)?;
        to.q -= step;
        if settled {
            // The residual of the balance is work that nothing does. It has one sign and would add up over many steps,
            // so the iteration goes on to round-off. Load and drive do work over the last iteration as well.
            book.supplied += h * forces.supplied - forces.other.dot(step);
            let known = book.potential;
            let after = system.potential(middle, &to.q).map_err(fail(middle))?;
            finish(to, from, h);
            book.dissipated += h * forces.dissipated;
            book.potential = system.potential(end, &to.q).map_err(fail(end))?;
            book.parametric += (book.potential - after) + (before - known);
            // Third differences of the motion: the leading error of a midpoint step.
            error.copy_from(&to.a);
            error.zip_apply(&from.a, |after, before| *after = h * h / 12.0 * (*after - before));
            return Ok(());
        }
        newton.measure(&to.q, scale);
    }
    Err(MotionError::NotConverged { time: from.time, step: h, iterations: ITERATIONS, change: newton.change() })
}

/// Velocity and acceleration at the end of a step whose coordinates are known.
fn finish(to: &mut State, from: &State, h: f64) {
    for i in 0..to.q.len() {
        to.v[i] = 2.0 / h * (to.q[i] - from.q[i]) - from.v[i];
        to.a[i] = (to.v[i] - from.v[i]) / h;
    }
    to.averaged.copy_from(&to.a);
    to.last_step = h;
}
