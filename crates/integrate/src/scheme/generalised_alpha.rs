//! Generalised-alpha method: second order, implicit, with adjustable damping of high frequencies.
//!
//! Source: J. Chung, G. M. Hulbert, J. Appl. Mech. 60 (1993) 371, in the form that evaluates forces only at the ends of
//! steps (M. Arnold, O. Bruels, Multibody Syst. Dyn. 18 (2007) 185).
//!
//! ```text
//! q_1 = q_0 + h v_0 + h^2 [(1/2 - beta) b_0 + beta b_1],   v_1 = v_0 + h [(1 - gamma) b_0 + gamma b_1]
//! (1 - a_m) b_1 + a_m b_0 = (1 - a_f) a_1 + a_f a_0,        M a_1 = f(t_1, q_1, v_1)
//! ```

use nalgebra::DMatrix;

use crate::{
    Forces, Mechanism, MotionError,
    newton::{ITERATIONS, NoStep},
    stepper::{Step, StepWork, Stepped, Stepper},
};

/// Longest step, in those before, over which the averaged acceleration is drawn out.
const REACH: f64 = 4.0;

/// Coefficients of the family; Newmark's methods are those with a_m = a_f = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Coefficients {
    pub(super) a_m: f64,
    pub(super) a_f: f64,
    pub(super) beta: f64,
    pub(super) gamma: f64,
}

impl Coefficients {
    /// Generalised-alpha method with the spectral radius `rho` at infinite frequency, 0 .. 1: second order, and the
    /// least damping of low frequencies for that.
    pub(crate) fn generalised_alpha(rho: f64) -> Self {
        let (a_m, a_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let gamma = 0.5 + a_f - a_m;
        Self { a_m, a_f, beta: 0.25 * (gamma + 0.5).powi(2), gamma }
    }

    /// Newmark's constant average acceleration (beta 1/4, gamma 1/2) and its relatives.
    pub(crate) fn newmark(beta: f64, gamma: f64) -> Self {
        Self { a_m: 0.0, a_f: 0.0, beta, gamma }
    }

    /// The state at the end of a step, and the local error of its coordinates. The forces are those of the end.
    fn solve<M: Mechanism>(&self, step: &mut Step<'_, M>) -> Stepped<M> {
        let Self { a_m, a_f, beta, gamma } = *self;
        let Step { system, from, h, scale, forces, to, work, .. } = step;
        let (StepWork { error, newton, begun: b0, rest, .. }, h) = (&mut **work, *h);
        let time = from.time + h;
        // The averaged acceleration belongs to a place within the step: a new step moves it along a line, which says
        // nothing of one many times as long; there it is the acceleration itself.
        let stretch = if from.last_step > 0.0 { h / from.last_step } else { 1.0 };
        let stretch = if stretch <= REACH { stretch } else { 0.0 };
        b0.copy_from(&from.a);
        b0.zip_apply(&from.averaged, |a, averaged| *a += (averaged - *a) * stretch);
        to.copy_from(from);
        to.time = time;
        for i in 0..b0.len() {
            to.q[i] = from.q[i] + h * from.v[i] + 0.5 * h * h * b0[i];
        }
        let mass_share = (1.0 - a_m) / ((1.0 - a_f) * beta * h * h);
        newton.begin(forces);
        for iteration in 0..ITERATIONS {
            for i in 0..b0.len() {
                let b1 = (to.q[i] - from.q[i] - h * from.v[i]) / (beta * h * h) - (0.5 - beta) / beta * b0[i];
                to.averaged[i] = b1;
                to.v[i] = from.v[i] + h * ((1.0 - gamma) * b0[i] + gamma * b1);
                to.a[i] = ((1.0 - a_m) * b1 + a_m * b0[i] - a_f * from.a[i]) / (1.0 - a_f);
            }
            if newton.settled() {
                let share = (beta - 1.0 / 6.0).abs().max(1.0 / 12.0) * h * h;
                to.last_step = h;
                error.copy_from(&to.a);
                error.zip_apply(&from.a, |after, before| *after = share * (*after - before));
                return Ok(());
            }
            newton.prepare(forces);
            system.forces(time, &to.q, &to.v, forces).map_err(|source| MotionError::Mechanism { time, source })?;
            rest.gemv(1.0, system.mass(), &to.a, 0.0);
            for (i, rest) in rest.as_mut_slice().iter_mut().enumerate() {
                *rest = *rest - forces.conservative[i] - forces.other[i];
            }
            let matrix = |forces: &Forces, sum: &mut DMatrix<f64>| {
                let damping_share = gamma / (beta * h);
                let own = system.mass().as_slice().iter().zip(forces.damping.as_slice());
                let own = sum.as_mut_slice().iter_mut().zip(forces.stiffness.as_slice()).zip(own);
                own.for_each(|((sum, k), (m, c))| *sum = k + (mass_share * m + damping_share * c));
            };
            let no_step = |e: NoStep| e.error((from.time, h), time);
            to.q -= newton.step(forces, matrix, rest, iteration).map_err(no_step)?;
            newton.measure(&to.q, scale);
        }
        let change = newton.change();
        Err(MotionError::NotConverged { time: from.time, step: h, iterations: ITERATIONS, change })
    }
}

impl Stepper for Coefficients {
    fn error_order(&self) -> f64 {
        3.0
    }

    /// Newmark's methods have a_m = a_f = 0: their averaged acceleration is the true one.
    fn carries_acceleration(&self) -> bool {
        (self.a_m, self.a_f) != (0.0, 0.0)
    }

    /// Work of drives, loads and dampers is integrated by the trapezoidal rule.
    fn step<M: Mechanism>(&self, mut step: Step<'_, M>) -> Stepped<M> {
        self.solve(&mut step)?;
        let Step { system, from, h, forces, to, ledger, .. } = step;
        to.powers = forces.powers();
        let work = [0, 1].map(|i| 0.5 * h * (from.powers[i] + to.powers[i]));
        ledger.supplied += work[0];
        ledger.dissipated += work[1];
        let fail = |time: f64| move |source| MotionError::Mechanism { time, source };
        let mut off_path = |time: f64, q| system.potential_off_path(time, q).map_err(fail(time));
        let known = ledger.potential;
        // What V changes by with the coordinates held, at either end. The end of the step comes last: a system may keep
        // it.
        let [moved, still] = [off_path(from.time, &to.q)?, off_path(to.time, &from.q)?];
        ledger.potential = system.potential(to.time, &to.q).map_err(fail(to.time))?;
        let held = [still - known, ledger.potential - moved];
        ledger.parametric += 0.5 * (held[0] + held[1]);
        Ok(())
    }
}
