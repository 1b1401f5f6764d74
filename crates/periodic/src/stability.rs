//! Whether a periodic motion stays where it is disturbed: Floquet multipliers.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix};

/// What a disturbance of a periodic motion becomes in a period. Theory (71).
///
/// ```text
/// M y'' + D(t) y' + K(t) y = 0,   (y, y')(T) = Phi (y, y')(0)
/// ```
/// The multipliers are the eigenvalues of Phi: all within the unit circle, the motion is stable.
#[derive(Debug, Clone, PartialEq)]
pub struct Floquet {
    /// Eigenvalues of Phi, the largest first.
    pub multipliers: Vec<Complex<f64>>,
}

/// How a motion loses its stability.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loss {
    /// A multiplier leaves at +1: the branch turns back (fold), or another one crosses it.
    Fold,
    /// One leaves at -1: a motion of twice the period begins.
    PeriodDoubling,
    /// A pair leaves: a second frequency begins, and the motion is no longer periodic.
    Torus,
}

impl Floquet {
    /// From -df/dq and -df/dv at equal phases of a period of T s. The trapezoidal rule between them neither adds nor
    /// takes energy; its error falls with the square of their distance.
    pub(crate) fn of(
        mass: &DMatrix<f64>,
        stiffness: &[DMatrix<f64>],
        damping: &[DMatrix<f64>],
        period: f64,
    ) -> Option<Self> {
        let (n, count) = (mass.nrows(), stiffness.len());
        let h = period / count as f64;
        let mut places = DMatrix::identity(n, 2 * n);
        let mut rates = DMatrix::zeros(n, 2 * n);
        // Velocities are counted in units of the driving frequency, so that both halves are of one size.
        let unit = TAU / period;
        rates.view_mut((0, n), (n, n)).fill_diagonal(unit);
        let state = |i: usize| (&stiffness[i % count], &damping[i % count]);
        for i in 0..count {
            let ((k0, d0), (k1, d1)) = (state(i), state(i + 1));
            // v1 = v0 + h a_m, q1 = q0 + h (v0 + v1) / 2, M a_m = -(D0 v0 + D1 v1 + K0 q0 + K1 q1) / 2.
            let matrix = mass + d1 * (0.5 * h) + k1 * (0.25 * h * h);
            let right = -((d0 + d1) * &rates + (k0 + k1) * &places + k1 * &rates * h) * 0.5;
            let gain = matrix.lu().solve(&right)?;
            let next = &rates + &gain * h;
            places += (&rates + &next) * (0.5 * h);
            rates = next;
        }
        let mut monodromy = DMatrix::zeros(2 * n, 2 * n);
        monodromy.rows_mut(0, n).copy_from(&places);
        monodromy.rows_mut(n, n).copy_from(&(rates / unit));
        if monodromy.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let mut multipliers: Vec<Complex<f64>> = monodromy.complex_eigenvalues().iter().copied().collect();
        multipliers.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
        Some(Self { multipliers })
    }

    /// Largest size of a multiplier; below 1 the motion is stable.
    pub fn largest(&self) -> f64 {
        self.multipliers.first().map_or(0.0, |m| m.norm())
    }

    /// Whether disturbances fade.
    pub fn is_stable(&self) -> bool {
        self.largest() < 1.0
    }

    /// What the largest multiplier would do beyond the unit circle.
    pub fn loss(&self) -> Loss {
        match self.multipliers.first() {
            Some(m) if m.im.abs() > 1e-6 * m.norm() => Loss::Torus,
            Some(m) if m.re < 0.0 => Loss::PeriodDoubling,
            _ => Loss::Fold,
        }
    }
}
