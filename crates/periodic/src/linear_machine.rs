//! A linear machine between few places at which other forces act, harmonic by harmonic.

use nalgebra::{Complex, DMatrix, DVector};

use crate::dense::Factors;

type ComplexMatrix = DMatrix<Complex<f64>>;

/// A machine of n coordinates that is linear but for forces on m combinations s of them. Theory (71a).
///
/// ```text
/// M z'' + (C + w G) z' + K z = p + B f(t, s, s'),   s = B' z
/// ```
/// w: angular frequency of the period, with which the machine turns.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearMachine {
    /// M: symmetric, positive definite.
    pub mass: DMatrix<f64>,
    /// K: symmetric; it may leave motions free that only the forces f hold.
    pub stiffness: DMatrix<f64>,
    /// C.
    pub damping: DMatrix<f64>,
    /// G: gyroscopic forces at w = 1 rad/s.
    pub gyroscopic: DMatrix<f64>,
    /// p.
    pub load: DVector<f64>,
    /// B, n x m.
    pub levers: DMatrix<f64>,
    /// k_0, m x m: what stands for -df/ds so that K + B k_0 B' is positive definite. It is added to the machine and taken
    /// off the forces: results do not depend on it.
    pub reference: DMatrix<f64>,
    /// Frequency (rad/s) up to which the machine is known. Modes beyond have no damping and gyroscopic forces among themselves,
    /// but for each its own Phi' (C + w G) Phi on the diagonal, and follow as if they had no inertia when a motion is disturbed ([`crate::Condensed::with_all_modes`]: what
    /// that leaves out). Infinite: all is exact.
    pub highest: f64,
}

/// The machine with k_0 in its undamped modes, M-orthonormal and ascending.
///
/// ```text
/// (K + B k_0 B') Phi = M Phi diag(omega^2),   Phi' M Phi = 1,   z = Phi y
/// ```
#[derive(Debug, Clone)]
pub(crate) struct ModalMachine {
    /// Phi, n x n.
    pub shapes: DMatrix<f64>,
    /// omega^2.
    pub squares: DVector<f64>,
    /// Phi' C Phi and Phi' G Phi.
    pub damping: DMatrix<f64>,
    pub gyroscopic: DMatrix<f64>,
    /// Phi' B and Phi' p.
    pub levers: DMatrix<f64>,
    pub load: DVector<f64>,
    /// s under p alone.
    pub rest: DVector<f64>,
    /// Number of modes up to [`LinearMachine::highest`].
    pub known: usize,
}

/// What forces on s do at one harmonic k of a frequency.
///
/// ```text
/// Z = diag(omega^2) - (k w)^2 + i k w (C + w G),   H = B' Z^-1 B,   dH/dw = -B' Z^-1 (dZ/dw) Z^-1 B
/// ```
#[derive(Debug, Clone)]
pub(crate) struct Receptance {
    /// H, m x m.
    pub value: ComplexMatrix,
    /// dH/dw.
    pub slope: ComplexMatrix,
    /// Z^-1 B: coordinates of the modes by forces on s, n x m.
    pub modes: ComplexMatrix,
}

impl ModalMachine {
    /// `None` where masses or stiffness with k_0 are not positive definite.
    pub fn new(machine: &LinearMachine) -> Option<Self> {
        let LinearMachine { mass, stiffness, damping, gyroscopic, load, levers, reference, highest } = machine;
        let held = stiffness + levers * reference * levers.transpose();
        let lower = mass.clone().cholesky()?.l();
        let half = lower.solve_lower_triangular(&held)?;
        let raw = lower.solve_lower_triangular(&half.transpose())?;
        let eigen = (0.5 * (&raw + raw.transpose())).symmetric_eigen();
        let mut order: Vec<usize> = (0..mass.nrows()).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        let squares = DVector::from_iterator(order.len(), order.iter().map(|&i| eigen.eigenvalues[i]));
        let vectors = DMatrix::from_fn(order.len(), order.len(), |i, j| eigen.eigenvectors[(i, order[j])]);
        let shapes = lower.tr_solve_lower_triangular(&vectors)?;
        if !squares.iter().all(|s| *s > 0.0 && s.is_finite()) {
            return None;
        }
        let of = |m: &DMatrix<f64>| shapes.tr_mul(m) * &shapes;
        let (levers, load) = (shapes.tr_mul(levers), shapes.tr_mul(load));
        let rest = levers.tr_mul(&load.component_div(&squares));
        let known = squares.iter().take_while(|s| **s <= highest * highest).count().max(1);
        Some(Self { known, squares, damping: of(damping), gyroscopic: of(gyroscopic), levers, load, rest, shapes })
    }

    /// What forces on s do at harmonic k of w. `None` at a resonance without damping.
    pub fn receptance(&self, k: usize, w: f64) -> Option<Receptance> {
        let (n, r, k) = (self.squares.len(), self.known, k as f64);
        // Z and dZ/dw = -2 k^2 w + i k (C + 2 w G).
        let z_of = |i: usize, j: usize| {
            let re = if i == j { self.squares[i] - (k * w).powi(2) } else { 0.0 };
            Complex::new(re, k * w * (self.damping[(i, j)] + w * self.gyroscopic[(i, j)]))
        };
        let rate_of = |i: usize, j: usize| {
            let re = if i == j { -2.0 * k * k * w } else { 0.0 };
            Complex::new(re, k * (self.damping[(i, j)] + 2.0 * w * self.gyroscopic[(i, j)]))
        };
        // Modes beyond are coupled to those that are known, and not among themselves.
        let across = [
            ComplexMatrix::from_fn(r, n - r, |i, j| z_of(i, r + j)),
            ComplexMatrix::from_fn(n - r, r, |i, j| z_of(r + i, j)),
        ];
        let over = |mut x: ComplexMatrix| {
            (r..n).for_each(|i| x.row_mut(i - r).iter_mut().for_each(|own| *own /= z_of(i, i)));
            x
        };
        let known = ComplexMatrix::from_fn(r, r, z_of) - &across[0] * over(across[1].clone());
        let factors = Factors::new(known)?;
        let solved = |x: &ComplexMatrix| {
            let beyond = over(x.rows(r, n - r).into_owned());
            let known = factors.solve(x.rows(0, r) - &across[0] * &beyond)?;
            let beyond = beyond - over(&across[1] * &known);
            let mut all = ComplexMatrix::zeros(n, x.ncols());
            all.rows_mut(0, r).copy_from(&known);
            all.rows_mut(r, n - r).copy_from(&beyond);
            Some(all)
        };
        let levers = self.levers.map(|x| Complex::new(x, 0.0));
        let modes = solved(&levers)?;
        let mut turned = ComplexMatrix::from_fn(r, n, rate_of) * &modes;
        turned = turned.resize_vertically(n, Complex::new(0.0, 0.0));
        for i in r..n {
            let own =
                modes.row(i) * rate_of(i, i) + ComplexMatrix::from_fn(1, r, |_, j| rate_of(i, j)) * modes.rows(0, r);
            turned.set_row(i, &own.row(0));
        }
        let slope = -levers.tr_mul(&solved(&turned)?);
        let value = levers.tr_mul(&modes);
        value.iter().chain(slope.iter()).all(|x| x.re.is_finite() && x.im.is_finite()).then_some(Receptance {
            value,
            slope,
            modes,
        })
    }

    /// H f at harmonic k of w, every mode by its own damping alone.
    pub fn uncoupled(&self, (k, w): (usize, f64), forces: &DVector<Complex<f64>>) -> DVector<Complex<f64>> {
        let turn = k as f64 * w;
        let mut sum = DVector::zeros(forces.len());
        for (i, lever) in self.levers.row_iter().enumerate() {
            let own: Complex<f64> = lever.iter().zip(forces.iter()).map(|(b, f)| f * *b).sum();
            let mode = own / Complex::new(self.squares[i] - turn * turn, turn * self.damping[(i, i)]);
            sum.iter_mut().zip(lever.iter()).for_each(|(s, b): (&mut Complex<f64>, _)| *s += mode * *b);
        }
        sum
    }

    /// Compliance of s by all modes but the lowest so many, as if they had no inertia, m x m.
    pub fn compliance_beyond(&self, modes: usize) -> DMatrix<f64> {
        let (n, m) = self.levers.shape();
        let mut sum = DMatrix::zeros(m, m);
        for i in modes..n {
            let own = self.levers.row(i).transpose();
            sum.ger(1.0 / self.squares[i], &own, &own, 1.0);
        }
        sum
    }
}
