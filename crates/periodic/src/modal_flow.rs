//! What disturbances of a periodic motion of a linear machine with forces at few places become in a period.

use nalgebra::DMatrix;

use crate::{
    Floquet,
    equations::Balance,
    linear_machine::ModalMachine,
    stability::{multipliers, unit_disturbances},
};

/// Disturbances of the lowest modes of a machine; those above follow as if they had no inertia (g: their compliance).
///
/// ```text
/// y'' + (C + w G + B d* B') y' + (omega^2 + B x* B') y = 0
/// x* = x (1 + g x)^-1,   d* = (1 + x g)^-1 d (1 + g x)^-1,   x = -df/ds - k_0,   d = -df/ds'
/// ```
/// A step of the trapezoidal rule ([`crate::TangentFlow`]) solves with a matrix that is the same in all steps but for B, of
/// few columns (Sherman, Morrison and Woodbury).
pub(crate) struct ModalFlow {
    /// -(1 + h C/2 + h^2 omega^2/4)^-1 (omega^2, C + h omega^2/2), r x 2 r.
    gain: DMatrix<f64>,
    /// B, r x m, and the inverse times it.
    levers: DMatrix<f64>,
    moved: DMatrix<f64>,
    /// g.
    beyond: DMatrix<f64>,
    step: f64,
    period: f64,
}

impl ModalFlow {
    /// The lowest `modes` of a machine that turns with the frequency w, in so many steps of a period. `None` where a step has
    /// no solution.
    pub fn new(machine: &ModalMachine, modes: usize, w: f64, steps: usize) -> Option<Self> {
        let period = std::f64::consts::TAU / w;
        let h = period / steps as f64;
        let own = |all: &DMatrix<f64>| all.view((0, 0), (modes, modes)).into_owned();
        let damping = own(&machine.damping) + own(&machine.gyroscopic) * w;
        let squares = DMatrix::from_diagonal(&machine.squares.rows(0, modes));
        let held = DMatrix::identity(modes, modes) + &damping * (0.5 * h) + &squares * (0.25 * h * h);
        let inverse = held.try_inverse()?;
        let mut gain = DMatrix::zeros(modes, 2 * modes);
        gain.columns_mut(0, modes).copy_from(&(&inverse * -&squares));
        gain.columns_mut(modes, modes).copy_from(&(&inverse * -(damping + squares * (0.5 * h))));
        let levers = machine.levers.rows(0, modes).into_owned();
        Some(Self { moved: inverse * &levers, gain, levers, beyond: machine.compliance_beyond(modes), step: h, period })
    }

    /// Multipliers of a motion with forces' tangents at each step.
    pub fn floquet(&self, at: &Balance, reference: &DMatrix<f64>) -> Option<Floquet> {
        let (r, h, m) = (self.levers.nrows(), self.step, self.levers.ncols());
        let one = DMatrix::<f64>::identity(m, m);
        let seen = |i: usize| {
            let i = i % at.stiffness.len();
            let x = &at.stiffness[i] - reference;
            let inward = (&one + &self.beyond * &x).try_inverse()?;
            let outward = (&one + &x * &self.beyond).try_inverse()?;
            Some([&x * &inward, outward * &at.damping[i] * inward])
        };
        let mut state = unit_disturbances(r, self.period);
        let of_moved = self.levers.tr_mul(&self.moved);
        let mut accelerations = DMatrix::zeros(r, 2 * r);
        let mut before = seen(0)?;
        for i in 1..=at.stiffness.len() {
            let now = seen(i)?;
            let ([x0, d0], [x1, d1]) = (&before, &now);
            let [places, rates] = [0, r].map(|first| self.levers.tr_mul(&state.rows(first, r)));
            let pushed = ((d0 + d1 + x1 * h) * rates + (x0 + x1) * places) * -0.5;
            accelerations.gemm(1.0, &self.gain, &state, 0.0);
            accelerations.gemm(1.0, &self.moved, &pushed, 1.0);
            let e = d1 * (0.5 * h) + x1 * (0.25 * h * h);
            let back = (&one + &e * &of_moved).try_inverse()? * (e * self.levers.tr_mul(&accelerations));
            accelerations.gemm(-1.0, &self.moved, &back, 1.0);
            for (mut column, gained) in state.column_iter_mut().zip(accelerations.column_iter()) {
                for k in 0..r {
                    let rate = column[r + k] + h * gained[k];
                    column[k] += 0.5 * h * (column[r + k] + rate);
                    column[r + k] = rate;
                }
            }
            before = now;
        }
        multipliers(state, self.period)
    }
}
