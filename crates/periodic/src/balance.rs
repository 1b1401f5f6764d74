//! The equations of a periodic motion: balance of its harmonics.

use std::f64::consts::TAU;

use integrate::Forces;
use nalgebra::{DMatrix, DVector};

use crate::{
    Floquet, FourierSeries, PeriodicError, PeriodicFamily,
    equations::{Balance, PeriodicEquations},
    product::{SeriesTransform, Wave},
    series::Basis,
};

impl<S: PeriodicFamily> PeriodicEquations for S {
    type Error = S::Error;

    fn set_parameter(&mut self, value: f64) -> Result<(), S::Error> {
        PeriodicFamily::set_parameter(self, value)
    }

    fn period(&self) -> f64 {
        PeriodicFamily::period(self)
    }

    fn scale(&self) -> DVector<f64> {
        PeriodicFamily::scale(self)
    }

    fn free_direction(&self) -> Option<DVector<f64>> {
        PeriodicFamily::free_direction(self)
    }

    fn balance(
        &mut self,
        parameter: f64,
        motion: &FourierSeries,
        basis: &Basis,
        tangents: bool,
    ) -> Result<Balance, PeriodicError<S::Error>> {
        balance(self, parameter, motion, basis, tangents)
    }

    fn jacobian(&self, basis: &Basis, at: &Balance) -> DMatrix<f64> {
        jacobian(self, basis, at)
    }

    fn frequency_slope(&self) -> Option<f64> {
        PeriodicFamily::frequency_slope(self)
    }

    fn frequency_derivative(
        &mut self,
        _: f64,
        motion: &FourierSeries,
        basis: &Basis,
        at: &Balance,
    ) -> Result<DMatrix<f64>, PeriodicError<S::Error>> {
        Ok(frequency_derivative(self, motion, basis, at))
    }

    fn floquet(&self, _: &Basis, at: &Balance) -> Option<Floquet> {
        let free = PeriodicFamily::free_direction(self);
        let period = PeriodicFamily::period(self);
        Floquet::of(self.mass(), &at.stiffness, &at.damping, period, free.as_ref())
    }
}

/// Evaluates the equations at a motion.
fn balance<S: PeriodicFamily>(
    system: &mut S,
    parameter: f64,
    motion: &FourierSeries,
    basis: &Basis,
    tangents: bool,
) -> Result<Balance, PeriodicError<S::Error>> {
    let (n, count) = (motion.coordinates(), basis.samples());
    let frequency = TAU / system.period();
    // Samples stand one under the other: so the products run down columns.
    let coefficients = motion.coefficients().transpose();
    let places = basis.values() * &coefficients;
    let rates = basis.rates() * (coefficients * frequency);
    let mut forces = DMatrix::zeros(count, n);
    let mut out = Forces::zeros(n);
    let (mut stiffness, mut damping) = (Vec::new(), Vec::new());
    for i in 0..count {
        let phase = i as f64 / count as f64;
        out.clear();
        out.tangents = tangents;
        let (q, v): (DVector<f64>, DVector<f64>) = (places.row(i).transpose(), rates.row(i).transpose());
        system.forces(phase * system.period(), &q, &v, &mut out).map_err(|source| PeriodicError::Mechanism {
            parameter,
            phase,
            source,
        })?;
        (0..n).for_each(|k| forces[(i, k)] = out.total(k));
        if tangents {
            stiffness.push(out.stiffness.clone());
            damping.push(out.damping.clone());
        }
    }
    let inertia = system.mass() * accelerations(motion.coefficients(), frequency);
    let projected = basis.projection().tr_mul(&forces).transpose();
    let mut residual = &inertia - &projected;
    let scale = system.scale();
    let per_sample = (count as f64).sqrt();
    // In time, what is left holds all harmonics that the samples show; those of the equations are taken away.
    let beyond = basis.values() * (&inertia - &residual).transpose() - &forces;
    let tail = system.mass().clone().cholesky().map_or(f64::INFINITY, |mass| {
        let added = mass.solve(&beyond.transpose()) / (frequency * (motion.harmonics() + 1) as f64).powi(2);
        let mut scaled = added;
        scale_rows(&mut scaled, &scale.map(|s| 1.0 / s));
        over_vibration(scaled.norm() / per_sample, motion, &scale)
    });
    scale_rows(&mut residual, &scale);
    let norm = |mut terms: DMatrix<f64>| {
        scale_rows(&mut terms, &scale);
        terms.norm()
    };
    let size = norm(inertia) + norm(forces.transpose()) / per_sample;
    Ok(Balance { residual, size, tail, forces: projected, stiffness, damping })
}

/// dR/dw at fixed harmonics, scaled, where forces know the frequency by the velocities alone:
///
/// ```text
/// dR/dw = 2 w M c'' + P D q'
/// ```
/// Gyroscopic forces, which grow with the speed as well, are left out: they are small beside these, and the derivative
/// only leads the steps.
fn frequency_derivative<S: PeriodicFamily>(
    system: &S,
    motion: &FourierSeries,
    basis: &Basis,
    at: &Balance,
) -> DMatrix<f64> {
    let frequency = TAU / system.period();
    let coefficients = motion.coefficients();
    let rates = basis.rates() * coefficients.transpose();
    let mut damped = DMatrix::zeros(rates.nrows(), rates.ncols());
    for (i, damping) in at.damping.iter().enumerate() {
        damped.set_row(i, &(damping * rates.row(i).transpose()).transpose());
    }
    let inertia = system.mass() * accelerations(coefficients, frequency) * (2.0 / frequency);
    let mut all = inertia + basis.projection().tr_mul(&damped).transpose();
    scale_rows(&mut all, &system.scale());
    all
}

/// Motion that is `added`, root mean square in time and in units of the scale, over that of the vibration.
pub(crate) fn over_vibration(added: f64, motion: &FourierSeries, scale: &DVector<f64>) -> f64 {
    let mut vibration = motion.coefficients().clone();
    vibration.column_mut(0).fill(0.0);
    scale_rows(&mut vibration, &scale.map(|s| 1.0 / s));
    let size = vibration.norm() / 2f64.sqrt();
    if size > 0.0 { added / size } else { 0.0 }
}

/// dR/dc, scaled: (harmonic, coordinate) by (harmonic, coordinate), harmonics outermost.
fn jacobian<S: PeriodicFamily>(system: &S, basis: &Basis, at: &Balance) -> DMatrix<f64> {
    let (n, scale) = (system.mass().nrows(), system.scale());
    let frequency = TAU / system.period();
    let mut all = force_slopes(basis, at, frequency, [&scale, &scale]);
    for i in 0..n {
        for j in 0..n {
            let scaled = scale[i] * scale[j];
            for k in 0..2 * basis.harmonics() + 1 {
                all[(k * n + i, k * n + j)] -= scaled * (frequency * order(k)).powi(2) * system.mass()[(i, j)];
            }
        }
    }
    all
}

/// -d(P f)/dc of the forces alone, rows and columns multiplied by `scales`.
pub(crate) fn force_slopes(basis: &Basis, at: &Balance, frequency: f64, scales: [&DVector<f64>; 2]) -> DMatrix<f64> {
    let n = scales[0].len();
    let columns = 2 * basis.harmonics() + 1;
    let mut all = DMatrix::zeros(n * columns, n * columns);
    let mut transform = SeriesTransform::new(basis.samples());
    for i in 0..n {
        for j in 0..n {
            let scaled = scales[0][i] * scales[1][j];
            if let Some(stiffness) = transform.of(&at.stiffness, (i, j), scaled) {
                for l in 0..columns {
                    for k in 0..columns {
                        all[(k * n + i, l * n + j)] += stiffness.projected(k, Wave::of(l));
                    }
                }
            }
            if let Some(damping) = transform.of(&at.damping, (i, j), frequency * scaled) {
                for l in 1..columns {
                    let (rate, wave) = Wave::of(l).rate();
                    for k in 0..columns {
                        all[(k * n + i, l * n + j)] += rate * damping.projected(k, wave);
                    }
                }
            }
        }
    }
    all
}

/// Harmonic of a column.
fn order(column: usize) -> f64 {
    column.div_ceil(2) as f64
}

fn accelerations(coefficients: &DMatrix<f64>, frequency: f64) -> DMatrix<f64> {
    let mut all = coefficients.clone();
    for k in 0..all.ncols() {
        all.column_mut(k).scale_mut(-(frequency * order(k)).powi(2));
    }
    all
}

pub(crate) fn scale_rows(matrix: &mut DMatrix<f64>, scale: &DVector<f64>) {
    matrix.row_iter_mut().zip(scale.iter()).for_each(|(mut row, s)| row *= *s);
}
