//! Whether a periodic motion stays where it is disturbed: Floquet multipliers.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, DVector};

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

/// Disturbances of a motion, a column each, carried along it.
///
/// ```text
/// M y'' + D(t) y' + K(t) y = 0
/// ```
/// The trapezoidal rule neither adds nor takes energy; its error falls with the square of the step.
#[derive(Debug, Clone, PartialEq)]
pub struct TangentFlow {
    /// y, n x m.
    pub places: DMatrix<f64>,
    /// y'.
    pub rates: DMatrix<f64>,
}

impl TangentFlow {
    /// A step of h from a state with K, D to another: v1 = v0 + h a_m, q1 = q0 + h (v0 + v1) / 2,
    /// M a_m = -(D0 v0 + D1 v1 + K0 q0 + K1 q1) / 2. `None` where that has no solution.
    pub fn step(
        &mut self,
        mass: &DMatrix<f64>,
        [k0, d0]: [&DMatrix<f64>; 2],
        [k1, d1]: [&DMatrix<f64>; 2],
        h: f64,
    ) -> Option<()> {
        let matrix = mass + d1 * (0.5 * h) + k1 * (0.25 * h * h);
        let right = -((d0 + d1) * &self.rates + (k0 + k1) * &self.places + k1 * &self.rates * h) * 0.5;
        let gain = matrix.lu().solve(&right)?;
        let next = &self.rates + &gain * h;
        self.places += (&self.rates + &next) * (0.5 * h);
        self.rates = next;
        Some(())
    }
}

/// A basis of all that moves across a direction: M-orthogonal to it, n x (n - 1). `None` unless M is positive definite
/// and the direction is one.
fn across(mass: &DMatrix<f64>, free: &DVector<f64>) -> Option<DMatrix<f64>> {
    let lower = mass.clone().cholesky()?.l();
    let along = lower.tr_mul(free);
    let (n, size) = (free.len(), along.norm());
    if size.is_nan() || size <= 0.0 {
        return None;
    }
    // A reflection that takes the first axis to the direction takes the others across it.
    let mut normal = &along / size;
    normal[0] += if normal[0] >= 0.0 { 1.0 } else { -1.0 };
    let reflection = DMatrix::identity(n, n) - &normal * normal.transpose() * (2.0 / normal.norm_squared());
    lower.tr_solve_lower_triangular(&reflection.columns(1, n - 1).into_owned())
}

/// Kind of loss of stability.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loss {
    /// A multiplier leaves at +1: the branch turns back (fold), or another one crosses it.
    Fold,
    /// One leaves at -1: a motion of twice the period begins.
    PeriodDoubling,
    /// A pair leaves: a second frequency begins, and the motion is no longer periodic.
    Torus,
}

/// Disturbances of n coordinates, a column each: of every coordinate, and of every velocity in units of the driving
/// frequency, so that both halves are of one size.
pub(crate) fn unit_disturbances(n: usize, period: f64) -> DMatrix<f64> {
    DMatrix::from_fn(2 * n, 2 * n, |i, j| if i == j { [1.0, TAU / period][i / n] } else { 0.0 })
}

/// Multipliers of what [`unit_disturbances`] have become after a period; `None` where they are no numbers.
pub(crate) fn multipliers(mut state: DMatrix<f64>, period: f64) -> Option<Floquet> {
    let n = state.nrows() / 2;
    state.rows_mut(n, n).scale_mut(period / TAU);
    let mut multipliers: Vec<Complex<f64>> = integrate::eigenvalues(state)?.iter().copied().collect();
    multipliers.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
    Some(Floquet { multipliers })
}

impl Floquet {
    /// Stability from -df/dq and -df/dv at equal phases of a period of T s. A direction `free` along which nothing
    /// resists, ever, is left out: a turn of the whole stays what it is, and says nothing of the motion.
    pub(crate) fn of(
        mass: &DMatrix<f64>,
        stiffness: &[DMatrix<f64>],
        damping: &[DMatrix<f64>],
        period: f64,
        free: Option<&DVector<f64>>,
    ) -> Option<Self> {
        let all = DMatrix::identity(mass.nrows(), mass.nrows());
        let across = free.map_or(Some(all), |free| across(mass, free))?;
        let of = |m: &DMatrix<f64>| across.tr_mul(m) * &across;
        let (mass, n, count) = (of(mass), across.ncols(), stiffness.len());
        let [stiffness, damping] = [stiffness, damping].map(|all| all.iter().map(of).collect::<Vec<_>>());
        let whole = unit_disturbances(n, period);
        let mut flow = TangentFlow { places: whole.rows(0, n).into_owned(), rates: whole.rows(n, n).into_owned() };
        let state = |i: usize| [&stiffness[i % count], &damping[i % count]];
        for i in 0..count {
            flow.step(&mass, state(i), state(i + 1), period / count as f64)?;
        }
        let mut state = whole;
        state.rows_mut(0, n).copy_from(&flow.places);
        state.rows_mut(n, n).copy_from(&flow.rates);
        multipliers(state, period)
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
