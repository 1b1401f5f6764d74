//! Periodic motions at one value of the parameter, and Newton's method that finds them.

use nalgebra::{DMatrix, DVector};

use crate::{
    Floquet, FourierSeries, PeriodicError,
    dense::solved,
    equations::{Balance, PeriodicEquations},
    series::Basis,
};

/// Accuracy of a periodic motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BalanceOptions {
    /// Harmonics to begin with.
    pub harmonics: usize,
    /// Largest number of harmonics.
    pub most_harmonics: usize,
    /// Largest share of the vibration that harmonics left out may have.
    pub tail: f64,
    /// Phases at which forces are evaluated, for each harmonic; 4 at the least.
    pub samples_per_harmonic: usize,
    /// Phases of a period whatever the harmonics: multipliers are exact to the square of their distance, and where
    /// contact is lost between two of them the tangent is that of the nearer one.
    pub least_samples: usize,
    /// Largest residual, over the terms that balance.
    pub tolerance: f64,
}

impl Default for BalanceOptions {
    fn default() -> Self {
        Self {
            harmonics: 12,
            most_harmonics: 96,
            tail: 1e-5,
            samples_per_harmonic: 32,
            least_samples: 1024,
            tolerance: 1e-10,
        }
    }
}

/// A periodic motion.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicMotion {
    /// Value of the parameter.
    pub parameter: f64,
    /// The motion over a period.
    pub series: FourierSeries,
    /// Period, s.
    pub period: f64,
    /// Floquet multipliers: growth of disturbances over a period.
    pub floquet: Floquet,
    /// What is left of the equations, over the terms that balance.
    pub residual: f64,
    /// Motion that the harmonics leave out, over the vibration: by the inertia alone, which bounds it where no resonance lies
    /// beyond them, or of [`crate::Condensed`] by the machine itself.
    pub tail: f64,
    /// Newton steps.
    pub iterations: usize,
}

/// Newton steps before giving up.
const STEPS: usize = 30;
/// How well the condition must be kept, over the size of the unknowns.
const KEPT: f64 = 1e-9;
/// Longest step over the size of the unknowns; longer ones are made of round-off.
const FARTHEST: f64 = 1e10;
/// Times a step is halved.
const HALVINGS: usize = 6;

/// Unknowns, and the row that a solution must keep beside the balance.
pub(crate) struct Point {
    pub parameter: f64,
    pub series: FourierSeries,
}

/// Solved equations at a point.
pub(crate) struct Solved {
    pub point: Point,
    pub balance: Balance,
    pub iterations: usize,
}

/// The scaled unknowns in one list, harmonics outermost; the parameter over its scale last.
pub(crate) fn unknowns(point: &Point, scale: &DVector<f64>, unit: f64) -> DVector<f64> {
    let (n, columns) = (point.series.coordinates(), point.series.coefficients().ncols());
    DVector::from_fn(n * columns + 1, |at, _| match at / n {
        k if k < columns => point.series.coefficients()[(at % n, k)] / scale[at % n],
        _ => point.parameter / unit,
    })
}

/// The point of a list.
pub(crate) fn point_of(list: &DVector<f64>, scale: &DVector<f64>, unit: f64) -> Point {
    let n = scale.len();
    let columns = (list.len() - 1) / n;
    let series = FourierSeries::from_coefficients(DMatrix::from_fn(n, columns, |i, k| list[k * n + i] * scale[i]));
    Point { parameter: list[list.len() - 1] * unit, series }
}

/// A condition on unknowns and parameter: normal' (x - at) = 0, that of a fixed parameter or of a place along a branch.
pub(crate) struct Condition {
    pub normal: DVector<f64>,
    pub at: DVector<f64>,
}

/// The equations with their condition.
pub(crate) struct Equations<'a, S> {
    pub system: &'a mut S,
    pub basis: &'a Basis,
    /// Scale of the parameter.
    pub unit: f64,
    pub tolerance: f64,
}

/// Steps of the parameter for its derivative, over its scale.
const DIFFERENCE: f64 = 1e-6;

impl<S: PeriodicEquations> Equations<'_, S> {
    /// Balance at unknowns.
    pub fn at(&mut self, x: &DVector<f64>, tangents: bool) -> Result<(Point, Balance), PeriodicError<S::Error>> {
        let scale = self.system.scale();
        let point = point_of(x, &scale, self.unit);
        self.set(point.parameter)?;
        let balance = self.system.balance(point.parameter, &point.series, self.basis, tangents)?;
        Ok((point, balance))
    }

    fn set(&mut self, parameter: f64) -> Result<(), PeriodicError<S::Error>> {
        let at_start = |source| PeriodicError::Mechanism { parameter, phase: 0.0, source };
        self.system.set_parameter(parameter).map_err(at_start)
    }

    /// Matrix of the equations, the condition and the free direction: unknowns, parameter, and the force that the free
    /// direction would need.
    pub fn matrix(
        &mut self,
        (x, point): (&DVector<f64>, &Point),
        at: &Balance,
        normal: &DVector<f64>,
    ) -> Result<DMatrix<f64>, PeriodicError<S::Error>> {
        let inner = self.system.jacobian(self.basis, at);
        let m = inner.nrows();
        let free = self.free();
        let size = m + 1 + usize::from(free.is_some());
        let mut all = DMatrix::zeros(size, size);
        all.view_mut((0, 0), (m, m)).copy_from(&inner);
        let slope = match self.system.frequency_slope() {
            Some(slope) => {
                let derivative = self.system.frequency_derivative(point.parameter, &point.series, self.basis, at)?;
                derivative * (slope * self.unit)
            }
            None => {
                let mut beside = x.clone();
                beside[m] += DIFFERENCE;
                let after = self.at(&beside, false)?.1.residual;
                self.set(x[m] * self.unit)?;
                (after - &at.residual) / DIFFERENCE
            }
        };
        all.view_mut((0, m), (m, 1)).copy_from_slice(slope.as_slice());
        all.view_mut((m, 0), (1, m + 1)).copy_from(&normal.transpose());
        if let Some(free) = free {
            for (i, f) in free.iter().enumerate() {
                (all[(i, m + 1)], all[(m + 1, i)]) = (*f, *f);
            }
        }
        Ok(all)
    }

    /// The free direction in scaled unknowns.
    fn free(&self) -> Option<DVector<f64>> {
        let scale = self.system.scale();
        self.system.free_direction().map(|d| {
            let scaled = d.component_div(&scale);
            &scaled / scaled.norm()
        })
    }

    fn right(&self, x: &DVector<f64>, at: &Balance, condition: &Condition, size: usize) -> DVector<f64> {
        let m = at.residual.len();
        let mut right = DVector::zeros(size);
        right.rows_mut(0, m).copy_from_slice(at.residual.as_slice());
        right[m] = condition.normal.dot(&(x - &condition.at));
        right
    }

    fn relative(&self, at: &Balance) -> f64 {
        let mut residual = at.residual.clone();
        // What stands along a free direction is balanced by nothing that could move.
        if let Some(free) = self.free() {
            let mean = residual.column(0).dot(&free);
            residual.column_mut(0).axpy(-mean, &free, 1.0);
        }
        residual.norm() / at.size.max(f64::MIN_POSITIVE)
    }

    /// Newton's method from `x`, with steps that are halved where they lead away.
    pub fn solve(&mut self, x: &DVector<f64>, condition: &Condition) -> Result<Solved, PeriodicError<S::Error>> {
        let mut x = x.clone();
        let (mut point, mut now) = self.at(&x, true)?;
        let mut iterations = 0;
        loop {
            let residual = self.relative(&now);
            let off = condition.normal.dot(&(&x - &condition.at)).abs();
            if residual <= self.tolerance && off <= KEPT * x.norm().max(1.0) {
                return Ok(Solved { point, balance: now, iterations });
            }
            let parameter = point.parameter;
            if iterations == STEPS {
                let harmonics = self.basis.harmonics();
                return Err(PeriodicError::NotConverged { parameter, iterations, harmonics, residual });
            }
            iterations += 1;
            let matrix = self.matrix((&x, &point), &now, &condition.normal)?;
            let right = self.right(&x, &now, condition, matrix.nrows());
            let step = solved(matrix, right).map(|step| step.rows(0, x.len()).into_owned());
            let step = step.filter(|s| s.norm() < FARTHEST * x.norm().max(1.0));
            let step = step.ok_or(PeriodicError::Singular { parameter })?;
            let mut share = 1.0;
            for halving in 0..=HALVINGS {
                let next = &x - &step * share;
                let (there, found) = self.at(&next, true)?;
                if self.relative(&found) < residual || halving == HALVINGS || residual <= self.tolerance {
                    (x, point, now) = (next, there, found);
                    break;
                }
                share *= 0.5;
            }
        }
    }
}
