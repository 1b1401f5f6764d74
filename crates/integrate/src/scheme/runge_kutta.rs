//! Explicit Runge-Kutta methods, for comparison and for systems without stiff parts.
//!
//! Work of the forces is integrated as further unknowns. The last stage of a tableau is at the end of the step and has
//! the weights of the method itself. It gives the accelerations there, and a value to compare with for the error
//! estimate.

use nalgebra::DVector;

use crate::{
    Mechanism, MotionError,
    stepper::{Step, Stepped, Stepper},
};

/// A method with `S` stages, the last of them at the end of the step.
#[derive(Debug)]
pub(crate) struct Table<const S: usize> {
    /// Order of the method.
    order: f64,
    nodes: [f64; S],
    stages: [[f64; S]; S],
    /// What the weights differ by from those of the method one order lower.
    difference: [f64; S],
}

/// Runge-Kutta's classical method of fourth order (W. Kutta, Z. Math. Phys. 46 (1901) 435).
///
/// The weight 1/6 of the fourth stage may be shared with the value at the end of the step in any proportion without
/// loss of the third order: with a tenth there, the difference is h (k_4 - k_5) / 10.
pub(crate) const CLASSICAL: Table<5> = Table {
    order: 4.0,
    nodes: [0.0, 0.5, 0.5, 1.0, 1.0],
    stages: [
        [0.0; 5],
        [0.5, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.5, 0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0],
        [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0, 0.0],
    ],
    difference: [0.0, 0.0, 0.0, 0.1, -0.1],
};

/// Dormand-Prince 5(4) (J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19).
pub(crate) const DORMAND_PRINCE: Table<7> = Table {
    order: 5.0,
    nodes: [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0],
    stages: [
        [0.0; 7],
        [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0, 0.0],
        [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0, 0.0],
        [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0, 0.0],
        [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0],
    ],
    difference: [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0],
};

impl<const S: usize> Stepper for &Table<S> {
    fn error_order(&self) -> f64 {
        self.order
    }

    /// R(z) = sum of c_k z^k, the growth of x' = lambda x in a step with z = h lambda.
    ///
    /// ```text
    /// R(z) = 1 + z b' (1 - z A)^-1 1,   c_0 = 1,  c_k = b' A^(k-1) 1
    /// ```
    /// b are the weights of the method, A its stages.
    fn stability_polynomial(&self) -> Option<Vec<f64>> {
        let mut powers = [1.0; S];
        let mut coefficients = vec![1.0];
        for _ in 1..S {
            coefficients.push(self.stages[S - 1].iter().zip(&powers).map(|(b, x)| b * x).sum());
            powers = self.stages.map(|stage| stage.iter().zip(&powers).map(|(a, x)| a * x).sum());
        }
        Some(coefficients)
    }

    fn step<M: Mechanism>(&self, step: Step<'_, M>) -> Stepped<M> {
        let Step { system, mass, from, h, forces, to, ledger, work, tangents, .. } = step;
        let mut rates: Vec<(DVector<f64>, DVector<f64>, [f64; 3])> = Vec::with_capacity(S);
        for (i, (stage, &node)) in self.stages.iter().zip(&self.nodes).enumerate() {
            // The last stage has no weight in the work.
            let last = i == S - 1;
            (forces.tangents, forces.rates) = (last && tangents, !last);
            let time = from.time + node * h;
            let (mut q, mut v) = (from.q.clone(), from.v.clone());
            for (rate, &weight) in rates.iter().zip(stage).filter(|(_, weight)| **weight != 0.0) {
                q.axpy(h * weight, &rate.0, 1.0);
                v.axpy(h * weight, &rate.1, 1.0);
            }
            forces.clear();
            system.forces(time, &q, &v, forces).map_err(|source| MotionError::Mechanism { time, source })?;
            let mut a = &forces.conservative + &forces.other;
            mass.solve_mut(&mut a);
            rates.push((v, a, [forces.supplied, forces.parametric, forces.dissipated]));
        }
        to.copy_from(from);
        to.time = from.time + h;
        let error = &mut work.error;
        error.fill(0.0);
        for (i, (v, a, powers)) in rates.iter().enumerate() {
            let weight = self.stages[S - 1][i];
            to.q.axpy(h * weight, v, 1.0);
            to.v.axpy(h * weight, a, 1.0);
            error.axpy(h * self.difference[i], v, 1.0);
            error.axpy(h * h * self.difference[i], a, 1.0);
            ledger.supplied += h * weight * powers[0];
            ledger.parametric += h * weight * powers[1];
            ledger.dissipated += h * weight * powers[2];
        }
        to.a.copy_from(&rates[S - 1].1);
        to.averaged.copy_from(&to.a);
        to.last_step = h;
        let time = to.time;
        ledger.potential = system.potential(time, &to.q).map_err(|source| MotionError::Mechanism { time, source })?;
        Ok(())
    }
}
